"""Errors, each with what to do about it."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Edit:
    """Change of one value of a TOML file."""

    file: str
    key: str
    """Key path of the value, such as `seam.side.sides[1][0]`."""
    old: str | None
    """Value that stands there, in TOML; none if the key is to be added, or is a table."""
    new: str | None
    """Value that is to stand there, in TOML; none if the key is to be removed."""


@dataclass(frozen=True)
class Mistake:
    """One mistake of an input."""

    file: str
    line: int | None
    """Line, from 1, where the mistake has a place in the text."""
    column: int | None
    """Column, from 1, in characters."""
    message: str
    """What is wrong, with the value."""
    remedy: str | None
    """What to do about it."""
    subject: dict[str, str] = field(default_factory=dict)
    """Names of what it speaks of by their kinds: `{"panel": "front", "edge": "hem"}`."""
    edits: list[Edit] = field(default_factory=list)
    """Changes that make the remedy, all of them together; none where it is no such change."""
    key: str | None = None
    """Key path of the wrong value, as `--set` takes it: `panel[2].center`."""


class Error(Exception):
    """Any error of this package.

    What else may come out of a call is of Python or of the caller: a `TypeError` for a wrong number
    or name of arguments, what a callback or a warning filter raises, `KeyboardInterrupt`, and
    `MemoryError`. NumPy raises a `ValueError` where its read-only arrays are written to.
    """


class UsageError(Error):
    """Arguments of the wrong kind, that do not fit together, or results that are there already."""


class NoFrameError(UsageError, IndexError):
    """A frame that a run does not have."""


class NoEntryError(UsageError, KeyError):
    """A parameter of a fit, or a fit of many, that there is not."""

    def __str__(self) -> str:
        return str(self.args[0])


class SolverError(Error):
    """A simulation that cannot be set up or go on."""


class OutputError(Error):
    """A file that cannot be read or written."""


class InternalError(Error):
    """A fault of this package, which should be reported."""


class RunWarning(UserWarning):
    """What deserves a second look in a run that goes on, such as a damaged checkpoint."""


class InputError(Error):
    """Input with mistakes: all that were found are in `mistakes`, in the order of the text.

    `file`, `line`, `message` and `remedy` are those of the first one.
    """

    mistakes: list[Mistake]

    def __init__(self, text: str, mistakes: list[Mistake]) -> None:
        super().__init__(text, mistakes)
        self.mistakes = mistakes

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def file(self) -> str:
        """File of the first mistake."""
        return self.mistakes[0].file

    @property
    def line(self) -> int | None:
        """Line of the first mistake, from 1."""
        return self.mistakes[0].line

    @property
    def message(self) -> str:
        """What is wrong, of the first mistake."""
        return self.mistakes[0].message

    @property
    def remedy(self) -> str | None:
        """What to do about the first mistake."""
        return self.mistakes[0].remedy
