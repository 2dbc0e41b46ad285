"""Arguments of another kind than a call takes, answered with what to do."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import OutputError, UsageError

StrPath = str | os.PathLike[str]

# Letters of an argument that a message repeats.
_LETTERS = 60

# Latest end of a scene, in s.
LATEST = 1e5


def refuse(call: str, wanted: str, given: object, advice: str) -> UsageError:
    """Returns the error of a call that was given something else than it takes.

    `{}` in the advice stands for the argument.
    """
    short, kind = shown(given), type(given).__name__
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
    advice = "give a text or a pathlib.Path"
    if not isinstance(given, str | os.PathLike):
        raise refuse(call, "a path", given, advice)
    text = os.fspath(given)
    if not isinstance(text, str):
        raise refuse(call, "a path", given, advice)
    try:
        has_zero = b"\0" in os.fsencode(text)
    except UnicodeEncodeError:
        has_zero = True
    if has_zero:
        raise refuse(call, "a path", given, "it has a letter that no path has")
    return Path(text)


def paths_of(call: str, given: Iterable[StrPath]) -> list[Path]:
    """Returns paths; raises `UsageError` for what is no list of them."""
    if isinstance(given, str | os.PathLike):
        raise refuse(call, "a list of paths", given, "give [{}]")
    return [path_of(call, path) for path in items_of(call, "a list of paths", given)]


def items_of(call: str, wanted: str, given: Iterable[Any]) -> list[Any]:
    """Returns the items of a list or of what gives them one by one; raises `UsageError` for others."""
    try:
        items = iter(given)
    except TypeError:
        raise refuse(call, wanted, given, "give a list") from None
    return list(items)


def text_of(call: str, given: str) -> str:
    """Returns a text; raises `UsageError` for what is none."""
    if not isinstance(given, str):
        raise refuse(call, "a text", given, "give a str")
    if not is_writable(given):
        raise refuse(call, "a text", given, "it has a letter that UTF-8 cannot write")
    return given


def is_writable(text: str) -> bool:
    """Returns whether UTF-8 can write a text, which it cannot if a surrogate stands alone."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def number_of(name: str, given: float, wanted: str, low: float, high: float, *, above: bool = False) -> float:
    """Returns a number from `low`, or `above` it, to `high`; raises `UsageError` for others."""
    number = math.nan
    if not isinstance(given, bool | np.bool_ | str | bytes):
        try:
            number = float(given)
        except (TypeError, ValueError, OverflowError):
            pass
    if not low <= number <= high or (above and number == low):
        raise UsageError(f"{name}={shown(given)}: give {wanted}")
    return number


def whole_of(name: str, given: int, wanted: str, low: int, high: int) -> int:
    """Returns a whole number from `low` to `high`; raises `UsageError` for others."""
    number = None
    if not isinstance(given, bool | np.bool_):
        try:
            number = operator.index(given)
        except TypeError:
            pass
    if number is None or not low <= number <= high:
        raise UsageError(f"{name}={shown(given)}: give {wanted}")
    return number


def threads_of(given: int | None) -> int | None:
    """Returns a number of threads; raises `UsageError` for what is none."""
    return None if given is None else whole_of("threads", given, "1 to 1024, or None for all", 1, 1024)


def flag_of(name: str, given: bool) -> bool:
    """Returns a truth value; raises `UsageError` for what is none."""
    if not isinstance(given, bool | np.bool_):
        raise UsageError(f"{name}={shown(given)}: give True or False")
    return bool(given)


def array_of(what: str, given: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Returns numbers as an array whose rows lie one after the other in memory; the same one if it
    is such an array. Raises `UsageError` for what is no array of real numbers."""
    try:
        array = np.asarray(given)
        if array.dtype.kind in "biufO" and not any(isinstance(x, str | bytes) for x in _objects(array)):
            # Memory that is not aligned is copied too.
            return np.require(array, np.float64, ["C", "A"])
    except (TypeError, ValueError, OverflowError):
        pass
    raise refuse(what, "an array of real numbers", given, "give a list or a NumPy array of them")


def _objects(array: npt.NDArray[Any]) -> Iterable[Any]:
    return array.flat if array.dtype.kind == "O" else ()


@contextmanager
def files(call: str) -> Iterator[None]:
    """Turns an error of files that are read or written within it into an `OutputError`."""
    try:
        yield
    except (OSError, UnicodeError) as error:
        raise OutputError(f"{call}: {error}") from error


def shown(given: object) -> str:
    """Returns an argument as a message shows it, cut where it is long."""
    try:
        whole = repr(os.fspath(given)) if isinstance(given, str | os.PathLike) else repr(given)
    except Exception:  # noqa: BLE001 - a message is worth more than the argument
        return f"<{type(given).__name__}>"
    short = whole if len(whole) <= _LETTERS else whole[: _LETTERS - 1] + "…"
    return short if is_writable(short) else ascii(short)
