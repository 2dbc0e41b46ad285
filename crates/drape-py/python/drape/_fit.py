"""Sheets, fabrics and fits."""

from __future__ import annotations

import html
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import _drape
from ._errors import UsageError

StrPath = str | os.PathLike[str]


class Sheet:
    """Sheet of a laboratory: KES values and curves of one fabric."""

    def __init__(self, inner: _drape.Sheet) -> None:
        self._inner = inner

    @property
    def name(self) -> str:
        """Name of the fabric."""
        return self._inner.name

    @property
    def source(self) -> str:
        """Who measured it, when, and under which licence."""
        return self._inner.source

    @property
    def warnings(self) -> list[str]:
        """What in the sheet deserves a second look."""
        return self._inner.warnings()

    def __repr__(self) -> str:
        return f"<drape.Sheet {self.name!r}>"


class Fabric:
    """Fabric: its laws, in SI."""

    def __init__(self, inner: _drape.Fabric) -> None:
        self._inner = inner

    @staticmethod
    def read(path: StrPath) -> Fabric:
        """Reads a `fabric.toml`. Raises `InputError` with all its mistakes."""
        return Fabric(_drape.Fabric.read(Path(path)))

    @staticmethod
    def from_toml(text: str) -> Fabric:
        """Makes a fabric of the text of a `fabric.toml`. Raises `InputError`."""
        return Fabric(_drape.Fabric.from_toml(text))

    @staticmethod
    def from_values(name: str, values: Mapping[str, Any]) -> Fabric:
        """Makes a fabric of KES values, in the units of the laboratory.

        The keys are those of a sheet: `{"W": 12.4, "warp": {"B": 0.11}, "weft": {"B": 0.08}}`.
        What they lack is assumed. Raises `InputError`.
        """
        text = _toml({"name": name, **values})
        sheet = _drape.Sheet.from_toml(text, Path())
        return Fabric(sheet.fit(_laws()).fabric)

    @property
    def name(self) -> str:
        """Name."""
        return self._inner.name

    @property
    def density(self) -> float:
        """Mass per area, in kg/m²."""
        return self._inner.density

    @property
    def thickness(self) -> float:
        """Thickness, in m."""
        return self._inner.thickness

    def to_toml(self) -> str:
        """Returns the text of its `fabric.toml`, as `drape fit` writes it."""
        return self._inner.to_toml()

    def __repr__(self) -> str:
        return f"<drape.Fabric {self.name!r}>"


@dataclass(frozen=True)
class Parameter:
    """Fitted parameter, in SI."""

    name: str
    """Key in `fabric.toml`, as in `"warp.bending.rigidity"`; of what belongs to the test and not
    to the fabric: direction, test and name, as in `"warp.bending.zero"`."""
    value: float
    stderr: float | None
    """Standard error; None where the curve does not determine the parameter."""
    interval: tuple[float, float] | None = None
    """95 % interval, where there is one."""
    unit: str = ""
    """SI unit; empty for a ratio."""
    reason: str | None = None
    """Why there is no standard error."""
    correl: dict[str, float] = field(default_factory=dict)
    """Correlations with the other parameters of the same curve, by their keys."""
    symbol: str = ""
    """Symbol in the report of the fit."""


# Symbols of KES for parameters of the laws.
_SYMBOLS = {"B": "bending.rigidity", "G": "shear.stiffness"}


class Parameters(Mapping[str, Parameter]):
    """Parameters of a fit by their keys in `fabric.toml`.

    `B` and `G` stand for the bending rigidity and the shear stiffness. A key without its direction,
    as in `params["B"]`, gives the mean over both directions, with the error of that mean; with it,
    as in `params["warp.B"]`, the parameter of that direction.
    """

    def __init__(self, own: dict[str, Parameter]) -> None:
        self._own = own

    def __getitem__(self, key: str) -> Parameter:
        *direction, symbol = key.rsplit(".", 1)
        whole = ".".join([*direction, _SYMBOLS.get(symbol, symbol)])
        if whole in self._own:
            return self._own[whole]
        found = [self._own[k] for d in ("warp", "weft") if (k := f"{d}.{whole}") in self._own]
        if not found:
            raise KeyError(f"{key!r} is no parameter; give one of {', '.join(self._own)}")
        errors = [p.stderr for p in found]
        squares = [e * e for e in errors if e is not None]
        has_error = len(squares) == len(errors)
        return Parameter(
            name=key,
            value=sum(p.value for p in found) / len(found),
            stderr=math.sqrt(sum(squares)) / len(found) if has_error else None,
            unit=found[0].unit,
            reason=None if has_error else next(p.reason for p in found if p.stderr is None),
            symbol=found[0].symbol,
        )

    def __iter__(self) -> Iterator[str]:
        return iter(self._own)

    def __len__(self) -> int:
        return len(self._own)


class Fit:
    """Fit of a fabric to a sheet."""

    def __init__(self, inner: _drape.Fit) -> None:
        self._inner = inner
        self.curves: list[dict[str, Any]] = inner.curves()
        """Curves with their laws: `name`, `test`, `direction`, `model`, `misfit` (a ratio),
        `r_squared`, and `deformation`, `measured`, `fitted`, `band`: arrays (n,), in SI."""

    @property
    def fabric(self) -> Fabric:
        """The fabric."""
        return Fabric(self._inner.fabric)

    @property
    def params(self) -> Parameters:
        """Parameters of the laws and of the tests, in SI, with errors and correlations."""
        reason = "from a value of the sheet, or assumed"
        numbers = self._inner.fabric.numbers()
        own = {key: Parameter(key, value, None, reason=reason) for key, value in numbers}
        for curve in self.curves:
            where = f"{curve['direction']}.{curve['test'].removeprefix('loop')}"
            keys = [p["key"] or f"{where}.{p['name']}" for p in curve["parameters"]]
            for index, (key, p) in enumerate(zip(keys, curve["parameters"])):
                row = p["correl"] or []
                pairs = [(k, c) for j, (k, c) in enumerate(zip(keys, row)) if j != index]
                interval = p["interval"]
                own[key] = Parameter(
                    name=key,
                    value=p["value"],
                    stderr=p["stderr"],
                    interval=(interval[0], interval[1]) if interval else None,
                    unit=p["unit"],
                    reason=p["reason"],
                    correl={k: c for k, c in pairs if c is not None},
                    symbol=p["symbol"],
                )
        return Parameters(own)

    @property
    def assumed(self) -> list[str]:
        """What the sheet lacks and was assumed."""
        return self._inner.assumed()

    @property
    def warnings(self) -> list[str]:
        """What deserves a second look."""
        return self._inner.warnings()

    def to_toml(self) -> str:
        """Returns the text of `fabric.toml`, the same bytes as `drape fit` writes."""
        return self.fabric.to_toml()

    def report(self) -> str:
        """Returns the report of the fit as text, as `drape fit` prints it."""
        return self._inner.text()

    def _repr_html_(self) -> str:
        return frame(self._inner.html(), 700)

    def plot(self) -> Any:
        """Draws every curve with its law; returns a Figure of matplotlib, which must be installed."""
        try:
            from matplotlib.figure import Figure
        except ImportError:
            raise UsageError("plot() draws with matplotlib: pip install matplotlib") from None
        count = max(1, len(self.curves))
        figure = Figure(figsize=(6, 3.5 * count), layout="constrained")
        for axes, curve in zip(figure.subplots(count, 1, squeeze=False)[:, 0], self.curves):
            axes.plot(curve["deformation"], curve["measured"], ".", markersize=3, label="measured")
            axes.plot(curve["deformation"], curve["fitted"], label=curve["model"] or "fitted")
            axes.set_title(curve["name"])
            axes.set_xlabel("deformation, in SI")
            axes.set_ylabel("load, in SI")
            axes.legend()
        return figure

    def __repr__(self) -> str:
        return f"<drape.Fit of {self.fabric.name!r}: {len(self.curves)} curves>"


def read_sheet(path: StrPath) -> Sheet:
    """Reads a sheet, a TOML file or a folder with `sheet.toml`. Raises `InputError`."""
    return Sheet(_drape.Sheet.read(Path(path)))


def fit(
    sheet: Sheet | StrPath,
    *,
    traction: str | None = None,
    bending: str | None = None,
    shear: str | None = None,
    profile: bool = False,
) -> Fit:
    """Fits a fabric to a sheet, or to the sheet of a file or folder.

    The laws are those that the curves support best unless they are named: `traction` is
    `"primed"` or `"polynomial"`; `bending` and `shear` are `"first-order"`, `"parallel"`,
    `"second-order"` or `"breen-1994"`. `profile` takes intervals from the profile of the residuals.
    Raises `InputError`, and `UsageError` for a law that is not known.
    """
    own = sheet if isinstance(sheet, Sheet) else read_sheet(sheet)
    return Fit(own._inner.fit(_laws(traction, bending, shear, profile)))


def _laws(
    traction: str | None = None,
    bending: str | None = None,
    shear: str | None = None,
    profile: bool = False,
) -> dict[str, Any]:
    return {"traction": traction, "bending": bending, "shear": shear, "profile": profile}


def frame(page: str, height: int) -> str:
    """Returns a page as a frame in a notebook, so many pixels high."""
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe srcdoc="{html.escape(page)}" style="{style}"></iframe>'


def _toml(values: Mapping[str, Any]) -> str:
    lines, tables = [], []
    for key, value in values.items():
        if isinstance(value, Mapping):
            tables.append(f"\n[{key}]\n{_toml(value)}")
        elif isinstance(value, str):
            escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
            lines.append(f'{key} = "{escaped}"\n')
        else:
            lines.append(f"{key} = {float(value)!r}\n")
    return "".join(lines + tables)
