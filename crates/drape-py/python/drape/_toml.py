"""Values of Python as TOML."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from ._errors import UsageError


def dumps(table: Mapping[str, Any]) -> str:
    """Returns a table as text."""
    return tomli_w.dumps(plain(table, ""))


def plain(value: Any, place: str) -> Any:
    """Returns a value as TOML has it; `place` is its key."""
    if isinstance(value, Mapping):
        entries = ((str(key), entry) for key, entry in value.items() if entry is not None)
        return {key: plain(entry, f"{place}.{key}".lstrip(".")) for key, entry in entries}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist(), place)
    if isinstance(value, list | tuple | range):
        return [plain(entry, f"{place}[{index}]") for index, entry in enumerate(value)]
    if isinstance(value, Path):
        return value.as_posix()
    # An np.float64 is a float too.
    if isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return float(value)
    kind = type(value).__name__
    raise UsageError(f"{place}: {value!r} is a {kind}; give a number, a text, a list or a dictionary")
