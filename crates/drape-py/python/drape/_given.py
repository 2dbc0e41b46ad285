"""Arguments of another kind than a call takes, answered with what to do."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from ._errors import UsageError

StrPath = str | os.PathLike[str]

# Letters of an argument that a message repeats.
_LETTERS = 60


def refuse(call: str, wanted: str, given: object, advice: str) -> UsageError:
    """Returns the error of a call that was given something else than it takes.

    `{}` in the advice stands for the argument.
    """
    shown = repr(os.fspath(given)) if isinstance(given, str | os.PathLike) else repr(given)
    short = shown if len(shown) <= _LETTERS else shown[: _LETTERS - 1] + "…"
    kind = type(given).__name__
    return UsageError(f"{call} takes {wanted}, not {short} ({kind}): {advice.replace('{}', short)}")


def expect(call: str, wanted: type[Any], given: object, advice: tuple[str, str]) -> None:
    """Raises `UsageError` for what is not of a type.

    The advice is for a path or a text, and for anything else; `{}` stands for the argument.
    """
    if isinstance(given, wanted):
        return
    of_path, otherwise = advice
    words = of_path if isinstance(given, str | os.PathLike) else otherwise
    name = wanted.__name__
    article = "an" if name[0] in "AEIOU" else "a"
    raise refuse(call, f"{article} {name}", given, words)


def path_of(call: str, given: StrPath) -> Path:
    """Returns a path; raises `UsageError` for what is none."""
    if not isinstance(given, str | os.PathLike):
        raise refuse(call, "a path", given, "give a text or a pathlib.Path")
    return Path(given)
