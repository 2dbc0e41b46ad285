"""Simulated drapemeters, and the cases of the validation."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from . import _drape
from ._fit import Fabric
from ._given import expect, flag_of, items_of, number_of, text_of, whole_of


def drapemeter(
    fabric: Fabric,
    *,
    meter: str = "frl",
    starts: int = 5,
    spacing: float | None = None,
    shake: bool = False,
) -> dict[str, Any]:
    """Drapes specimens of a fabric on a simulated drapemeter, from some starts.

    `meter` is `"frl"`, `"cusick-24"`, `"cusick-30"` or `"cusick-36"`; `spacing` is that of the
    particles, in m. Returns `coefficient` and `deviation` (ratios), `coefficients` of the starts (an
    array), `nodes`, `spacing` and `spacing_bound` (in m). Ctrl-C returns at once; what is left
    of the work then ends by itself, or with the process. Raises `SolverError` and `UsageError`.
    """
    advice = ("read it first, drape.Fabric.read({})", "give a fabric, of a fit its .fabric")
    expect("drapemeter", Fabric, fabric, advice)
    settings = {"meter": text_of("drapemeter(meter=)", meter), "shake": flag_of("shake", shake)}
    settings["starts"] = whole_of("starts", starts, "a whole number from 2 to 10000", 0, 10_000)
    settings["spacing"] = None
    if spacing is not None:
        settings["spacing"] = number_of("spacing", spacing, "a length above 0, to 1 m", 0, 1, above=True)
    return _drape.drapemeter(fabric._inner, settings)


def cases() -> list[str]:
    """Returns the names of the cases of the validation, the short ones first."""
    return [name for name, _ in sorted(_drape.case_names(), key=lambda case: case[1])]


def validate(names: Iterable[str] | None = None) -> list[dict[str, Any]]:
    """Runs cases of the validation, all that take seconds unless they are named.

    Returns the outcome of each; `passes` is the verdict on it. Raises `UsageError` for a name that
    is none. Ctrl-C returns at once, as from `drapemeter`.
    """
    if isinstance(names, str):
        names = [names]
    chosen = [n for n, is_long in _drape.case_names() if not is_long] if names is None else names
    wanted = items_of("validate", "a list of names", chosen)
    return [json.loads(_drape.validate(text_of("validate", name))) for name in wanted]
