"""Errors, each with what to do about it."""

from __future__ import annotations

from dataclasses import dataclass


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


class Error(Exception):
    """Any error of this package."""


class UsageError(Error):
    """Arguments that do not fit together, or results that are there already."""


class SolverError(Error):
    """A simulation that cannot be set up or go on."""


class OutputError(Error):
    """A file that cannot be read or written."""


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
