"""Sheets, fabrics and fits."""

from __future__ import annotations

import html
import math
import os
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy.typing as npt

from . import _drape
from ._errors import InputError, NoEntryError, UsageError
from ._given import (
    StrPath,
    array_of,
    expect,
    files,
    flag_of,
    items_of,
    number_of,
    path_of,
    refuse,
    shown,
    text_of,
)
from ._pickled import StoredFit
from ._toml import dumps

# Programs of materials by the endings of their files.
_PROGRAMS = {".py": "blender", ".toml": "ppf", ".csv": "browzwear", ".u3m": "u3m", ".u3ma": "u3ma"}

# Units of the numbers of a test in SI: of deformation and load.
_SI = {
    "tensile": ("1", "N/m"),
    "shear": ("rad", "N/m"),
    "bending": ("1/m", "N"),
    "loop-bending": ("m", "N/m"),
}


@dataclass(frozen=True, eq=False)
class Curve:
    """Curve of a test as arrays, in SI unless units are given."""

    test: str
    """`"tensile"`, `"shear"`, `"bending"` or `"loop-bending"`."""
    direction: str
    """`"warp"` or `"weft"`."""
    deformation: npt.ArrayLike
    """Deformations, (n,): strains, angles in rad, curvatures in 1/m; distances of clamps in m."""
    load: npt.ArrayLike
    """Loads per width, (n,), in N/m; moments in N."""
    name: str | None = None
    deformation_unit: str | None = None
    """Unit of the deformations, such as `"%"` or `"1/cm"`; a length needs a `gauge`."""
    load_unit: str | None = None
    """Unit of the loads, such as `"gf/cm"`; a force or a moment needs a `width`."""
    gauge: float | str | None = None
    """Length of the strip between the clamps, in m or with a unit."""
    width: float | str | None = None
    """Width of the strip, in m or with a unit."""
    zero: str | None = None
    """What a length is: `"extension"`, `"distance"` of clamps or `"position"` of one."""
    slack: bool = False
    """Whether the strip hangs slack at the start."""

    def _write(self, folder: Path, number: int) -> dict[str, Any]:
        test = text_of("Curve(test=)", self.test)
        points = [array_of(f"curve {number}", numbers) for numbers in (self.deformation, self.load)]
        if points[0].ndim != 1 or points[0].shape != points[1].shape:
            shapes = f"{points[0].shape} and {points[1].shape}"
            raise UsageError(f"curve {number} has deformation and load of shapes {shapes}; give (n,)")
        rows = zip(*(array.tolist() for array in points))
        file = f"curve-{number}.csv"
        lines = ["deformation,load\n", *(f"{x!r},{y!r}\n" for x, y in rows)]
        (folder / file).write_text("".join(lines), encoding="utf-8")
        units = _SI.get(test, ("1", "N/m"))

        def axis(column: str, unit: str, size: str, length: float | str | None) -> dict[str, Any]:
            own = {"column": column, "unit": text_of("Curve, a unit,", unit)}
            if length is None:
                return own
            if not isinstance(length, str):
                number = number_of(size, length, "a length above 0, to 1000 m", 0, 1000, above=True)
                length = f"{number} m"
            return {**own, size: length}

        of_length = self.deformation_unit
        if of_length is None:
            of_length = "m" if self.gauge is not None else units[0]
        of_load = units[1] if self.load_unit is None else self.load_unit
        entry: dict[str, Any] = {"test": test, "direction": self.direction, "file": file}
        entry["deformation"] = axis("deformation", of_length, "gauge", self.gauge)
        entry["load"] = axis("load", of_load, "width", self.width)
        if self.zero is not None:
            entry["deformation"]["zero"] = self.zero
        if flag_of("slack", self.slack):
            entry["slack"] = True
        return entry if self.name is None else {"name": self.name, **entry}


class Sheet:
    """Sheet of a laboratory: KES values and curves of one fabric."""

    def __init__(self, inner: _drape.Sheet) -> None:
        advice = ("drape.read_sheet({}) reads a file", "drape.Sheet.from_curves(name, curves) makes one")
        expect("Sheet", _drape.Sheet, inner, advice)
        self._inner = inner

    @staticmethod
    def from_curves(
        name: str, curves: Iterable[Curve], values: Mapping[str, Any] | None = None
    ) -> Sheet:
        """Makes a sheet of curves that are arrays, and of KES values as for `Fabric.from_values`.

        They are read as from the files of a sheet, with the same checks. Raises `InputError`,
        `UsageError` for what is no curve or no array of numbers, and `OutputError` where no
        temporary file can be written.
        """
        own = items_of("Sheet.from_curves", "a list of curves", curves)
        advice = "drape.Curve(test, direction, deformation, load)"
        for curve in own:
            expect("a list of curves", Curve, curve, (advice, advice))
        if values is not None and not isinstance(values, Mapping):
            raise refuse("Sheet.from_curves(values=)", "a dictionary", values, 'such as {"W": 12.4}')
        with files("Sheet.from_curves"), tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            entries = [curve._write(folder, number) for number, curve in enumerate(own, 1)]
            text = dumps({"name": name, **(values or {}), "curve": entries})
            try:
                return Sheet(_drape.Sheet.from_toml(text, folder))
            except InputError as error:
                shown = [replace(m, file=m.file.replace(temporary, "<arrays>")) for m in error.mistakes]
                raise InputError(str(error).replace(temporary, "<arrays>"), shown) from None

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

    @property
    def readings(self) -> list[str]:
        """What each curve, and each value of tables, was taken for; what was assumed or left out."""
        return self._inner.readings()

    def __reduce__(self) -> Any:
        raise UsageError("a sheet cannot be pickled or copied; pickle its fit, or read it again there")

    def __repr__(self) -> str:
        return f"<drape.Sheet {self.name!r}>"


class Fabric:
    """Fabric: its laws, in SI. It can be pickled, with all bits of its numbers."""

    def __init__(self, inner: _drape.Fabric) -> None:
        advice = (
            "drape.Fabric.read({}) reads a file, drape.fit({}).fabric fits a sheet",
            "drape.Fabric.from_values(name, values) makes one",
        )
        expect("Fabric", _drape.Fabric, inner, advice)
        self._inner = inner

    @staticmethod
    def read(path: StrPath) -> Fabric:
        """Reads a `fabric.toml`. Raises `InputError` with all its mistakes."""
        return Fabric(_drape.Fabric.read(path_of("Fabric.read", path)))

    @staticmethod
    def from_toml(text: str) -> Fabric:
        """Makes a fabric of the text of a `fabric.toml`. Raises `InputError`."""
        return Fabric(_drape.Fabric.from_toml(text_of("Fabric.from_toml", text)))

    @staticmethod
    def from_values(name: str, values: Mapping[str, Any]) -> Fabric:
        """Makes a fabric of KES values, in the units of the laboratory.

        The keys are those of a sheet: `{"W": 12.4, "warp": {"B": 0.11}, "weft": {"B": 0.08}}`.
        What they lack is assumed. Raises as `Sheet.from_curves`.
        """
        return fit(Sheet.from_curves(name, [], values)).fabric

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

    def export(
        self,
        path: StrPath,
        *,
        program: str | None = None,
        load: float = 20.0,
        replace: bool = False,
    ) -> list[str]:
        """Writes the fabric as the material of another program, as `drape fabric export` does.

        `program` is `"blender"`, `"ppf"`, `"browzwear"`, `"u3m"` or `"u3ma"`, by default that of the
        ending: `*.py`, `*.toml`, `*.csv`, `*.u3m`, `*.u3ma`. The stretch is read at a `load`, in N/m.
        Returns what the numbers lose, which stands in the file too. Raises `UsageError` for a program
        that is not known, a load that the fabric never carries, and a file that is there already,
        unless it may `replace` it, and `OutputError` for a file that cannot be written.
        """
        path = path_of("Fabric.export", path)
        if program is not None:
            program = text_of("Fabric.export(program=)", program)
        load = number_of("load", load, "a load from 0.1 to 10000 N/m", 0.1, 1e4)
        replace = flag_of("replace", replace)
        chosen = program or _PROGRAMS.get(path.suffix.lower())
        if chosen is None:
            known = ", ".join(_PROGRAMS.values())
            raise UsageError(f"{path}: the ending names no program; give program=, one of {known}")
        with files("Fabric.export"):
            if path.exists() and not replace:
                raise UsageError(f"{path} exists; write elsewhere, or with replace=True")
            content, losses = self._inner.material(chosen, load, time.time())
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return losses

    def __deepcopy__(self, memo: dict[int, Any]) -> Fabric:
        """Returns the fabric itself, which nothing changes."""
        return self

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
    as in `params["warp.B"]`, the parameter of that direction. Raises `NoEntryError`, a `KeyError`
    too, for a parameter that there is not.
    """

    def __init__(self, own: dict[str, Parameter]) -> None:
        self._own = own

    def __getitem__(self, key: str) -> Parameter:
        if not isinstance(key, str):
            raise NoEntryError(f"{shown(key)} is no parameter; give one of {', '.join(self._own)}")
        *direction, symbol = key.rsplit(".", 1)
        whole = ".".join([*direction, _SYMBOLS.get(symbol, symbol)])
        if whole in self._own:
            return self._own[whole]
        found = [self._own[k] for d in ("warp", "weft") if (k := f"{d}.{whole}") in self._own]
        if not found:
            raise NoEntryError(f"{shown(key)} is no parameter; give one of {', '.join(self._own)}")
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
    """Fit of a fabric to a sheet. It can be pickled, with its curves and its report."""

    def __init__(self, inner: _drape.Fit) -> None:
        advice = ("drape.fit({}) fits the sheet of a file", "drape.fit(sheet) makes a fit")
        expect("Fit", _drape.Fit, inner, advice)
        self._inner: _drape.Fit | StoredFit = inner
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

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_inner": StoredFit.of(self._inner)}

    def __repr__(self) -> str:
        return f"<drape.Fit of {self.fabric.name!r}: {len(self.curves)} curves>"


def read_sheet(path: StrPath, *, fabric: str | None = None) -> Sheet:
    """Reads a sheet, a TOML file or a folder with `sheet.toml`; or the tables of a laboratory.

    Tables are a workbook (`.xlsx`, `.xls`, `.xlsm`, `.ods`), a `.csv` or another table of text, a `.zip`, or
    a folder of exports. `fabric` is the name of one fabric where they hold several. Raises `InputError`.
    """
    named = None if fabric is None else text_of("read_sheet(fabric=)", fabric)
    return Sheet(_drape.Sheet.read(path_of("read_sheet", path), named))


class Fits(Mapping[str, Fit]):
    """Fits of many sheets by their names, those of their folders, as `drape fit` calls them.

    Raises the exception of a sheet that has no fit, and `NoEntryError`, a `KeyError` too, for a
    name that there is not.
    """

    def __init__(self, fits: dict[str, Fit], failures: dict[str, Exception]) -> None:
        advice = ("drape.fit_all({}) fits the sheets of a folder", "drape.fit_all(sheets) makes fits")
        expect("Fits", dict, fits, advice)
        expect("Fits", dict, failures, advice)
        self._fits = fits
        self.failures = failures
        """Sheets that have no fit, each with its exception."""

    def __getitem__(self, name: str) -> Fit:
        if isinstance(name, str) and name in self.failures:
            raise self.failures[name]
        if name not in self:
            raise NoEntryError(f"{shown(name)} has no fit; give one of {', '.join(self._fits)}")
        return self._fits[name]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self._fits

    def __iter__(self) -> Iterator[str]:
        return iter(self._fits)

    def __len__(self) -> int:
        return len(self._fits)

    def __repr__(self) -> str:
        return f"<drape.Fits: {len(self)} fits, {len(self.failures)} failures>"


def fit(
    sheet: Sheet | StrPath | Iterable[Curve],
    *,
    traction: str | None = None,
    bending: str | None = None,
    shear: str | None = None,
    profile: bool = False,
    fabric: str | None = None,
) -> Fit:
    """Fits a fabric to a sheet, to the sheet of a file or folder, or to curves as arrays.

    A file may be a workbook or another table too, and a folder one of exports, as for `read_sheet`;
    `fabric` names one of several in them.

    The laws are those that the curves support best unless they are named: `traction` is
    `"exponential"`, `"primed"` or `"polynomial"`; `bending` and `shear` are `"first-order"`,
    `"two-elements"`, `"second-order"`, `"varying"` or `"piecewise"`. A former name of a law is
    accepted with a `FutureWarning`. `profile` takes intervals from the profile of the residuals.
    Ctrl-C returns at once; the work then ends by itself. Raises `InputError`, `UsageError` for a
    law that is not known and a folder of many sheets, which are for `fit_all`, and `OutputError` for
    a folder that cannot be read.
    """
    laws = _laws(traction, bending, shear, profile)
    if isinstance(sheet, str | os.PathLike):
        path = path_of("fit", sheet)
        with files("fit"):
            below = _sheets_below(path) if path.is_dir() and not (path / _SHEET).exists() else []
        if below:
            advice = f"fit them with drape.fit_all({str(path)!r})"
            raise UsageError(f"{path} holds {len(below)} sheets in its folders; {advice}")
        sheet = read_sheet(path, fabric=fabric)
    if isinstance(sheet, Sheet):
        own = sheet
    elif isinstance(sheet, Iterable):
        own = Sheet.from_curves("fabric", sheet)
    else:
        advice = "drape.read_sheet(path) reads a sheet, drape.Curve(...) holds arrays"
        raise refuse("fit", "a Sheet, a path or a list of Curves", sheet, advice)
    return Fit(own._inner.fit(laws))


def fit_all(
    sheets: StrPath | Iterable[StrPath],
    *,
    traction: str | None = None,
    bending: str | None = None,
    shear: str | None = None,
    profile: bool = False,
) -> Fits:
    """Fits the sheets of files and folders on all threads: all that are in the folders below, too.

    A file may be a workbook or another table of one fabric.

    The keywords are those of `fit`. A sheet that has no fit does not stop the others: it is in
    `failures`. Raises `UsageError` for a folder without sheets, and `OutputError` for one that cannot
    be read.
    """
    paths: list[Path] = []
    if not isinstance(sheets, str | os.PathLike | Iterable):
        raise refuse("fit_all", "paths", sheets, "give a folder of sheets, or a list of sheets")
    given = [sheets] if isinstance(sheets, str | os.PathLike) else items_of("fit_all", "paths", sheets)
    laws = _laws(traction, bending, shear, profile)
    for path in [path_of("fit_all", one) for one in given]:
        with files("fit_all"):
            is_sheet = not path.is_dir() or (path / _SHEET).exists()
            below = [path] if is_sheet else _sheets_below(path)
        if not below:
            raise UsageError(f"{path} holds no {_SHEET}; name a folder of sheets, or a sheet")
        paths += below
    found = _drape.fit_all(paths, laws)
    fits: dict[str, Fit] = {}
    failures: dict[str, Exception] = {}
    for path, result in zip(paths, found):
        own = path.resolve().parent if path.name == _SHEET else path.resolve()
        stem = own.name if own.is_dir() else own.stem
        name, number = stem, 2
        while name in fits or name in failures:
            name, number = f"{stem}-{number}", number + 1
        if isinstance(result, Exception):
            failures[name] = result
        else:
            fits[name] = Fit(result)
    return Fits(fits, failures)


# Name of the file of a sheet in its folder, and the deepest folder that is searched.
_SHEET = "sheet.toml"
_DEEPEST = 8


def _sheets_below(folder: Path, depth: int = _DEEPEST) -> list[Path]:
    found: list[Path] = []
    for path in sorted(path for path in folder.iterdir() if path.is_dir()):
        if (path / _SHEET).exists():
            found.append(path)
        elif depth > 0:
            found += _sheets_below(path, depth - 1)
    return found


def _laws(
    traction: str | None = None,
    bending: str | None = None,
    shear: str | None = None,
    profile: bool = False,
) -> dict[str, Any]:
    names = {"traction": traction, "bending": bending, "shear": shear}
    laws = {test: law if law is None else text_of(f"{test}=", law) for test, law in names.items()}
    return {**laws, "profile": flag_of("profile", profile)}


def frame(page: str, height: int) -> str:
    """Returns a page as a frame in a notebook, so many pixels high."""
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe srcdoc="{html.escape(page)}" style="{style}"></iframe>'
