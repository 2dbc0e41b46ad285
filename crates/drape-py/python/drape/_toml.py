"""Values of Python as TOML."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from ._errors import UsageError
from ._given import is_writable, shown

# Deepest nesting of lists and dictionaries.
_DEEPEST = 100

# Whole numbers that TOML has: 64 bits.
_WHOLE = range(-(2**63), 2**63)


def dumps(table: Mapping[str, Any]) -> str:
    """Returns a table as text."""
    return tomli_w.dumps(plain(table, ""))


def plain(value: Any, place: str, depth: int = 0) -> Any:
    """Returns a value as TOML has it; `place` is its key. Raises `UsageError` for what TOML lacks."""
    if depth > _DEEPEST:
        raise UsageError(f"{place[:60]}…: lists and dictionaries are nested deeper than {_DEEPEST}")
    if isinstance(value, Mapping):
        entries = [(_key(key, place), entry) for key, entry in value.items() if entry is not None]
        return {key: plain(entry, f"{place}.{key}".lstrip("."), depth + 1) for key, entry in entries}
    if isinstance(value, np.floating):
        return float(value)
    if isinstance(value, np.ndarray | np.generic) and value.dtype.kind in "biufUO":
        return plain(value.tolist(), place, depth)
    if isinstance(value, list | tuple | range):
        return [plain(entry, f"{place}[{index}]", depth + 1) for index, entry in enumerate(value)]
    if isinstance(value, Path):
        value = value.as_posix()
    if isinstance(value, str) and not is_writable(value):
        raise UsageError(f"{place}: {value!a} has a letter that UTF-8 cannot write")
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int):
        return value if value in _WHOLE else _float(value, place)
    if isinstance(value, float):
        return float(value)
    kind = type(value).__name__
    raise UsageError(f"{place}: {shown(value)} is a {kind}; give a number, a text, a list or a dictionary")


def _key(key: object, place: str) -> str:
    text = str(key)
    if not is_writable(text):
        raise UsageError(f"{place}: the key {text!a} has a letter that UTF-8 cannot write")
    return text


def _float(value: int, place: str) -> float:
    try:
        return float(value)
    except OverflowError:
        raise UsageError(f"{place}: the number has {value.bit_length()} bits; give a smaller one") from None
