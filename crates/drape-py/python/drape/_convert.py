"""Files of others made into the project's own."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import _drape
from ._errors import UsageError
from ._given import StrPath, files, flag_of, number_of, path_of, text_of

# Name of a sheet in its folder.
_SHEET = "sheet.toml"

# Kinds of the files of patterns, by their endings.
_KINDS = {".toml": "pattern", ".svg": "drawing", ".dxf": "dxf"}


@dataclass(frozen=True)
class Converted:
    """What a conversion gave."""

    kind: str
    """`"pattern"`, `"drawing"`, `"dxf"` or `"sheet"`."""
    text: str
    """Text of the result: TOML, DXF, or SVG of a drawing, the first page where there are several."""
    files: list[Path] = field(default_factory=list)
    """Files that were written."""
    notes: list[str] = field(default_factory=list)
    """What was taken for what, and what is not in the result."""

    def __str__(self) -> str:
        return self.text


def convert(
    source: StrPath,
    to: StrPath | None = None,
    *,
    unit: str | None = None,
    size: str | None = None,
    paper: str | None = None,
    width: float | None = None,
    replace: bool = False,
) -> Converted:
    """Converts a pattern or a folder of exports, as `drape convert` does, to a text or to a file.

    `source` is a pattern, `*.json` of GarmentCode or FreeSewing, `*.svg`, `*.dxf` or `*.toml`, or a
    folder with the exports of a laboratory's instruments, which become a sheet. Without `to` nothing is
    written. `to` is a `*.toml`, for a sheet its folder too, or for a pattern a `*.svg`, at true scale, or
    a `*.dxf` (AAMA, ASTM D6673).

    `unit` is that of a drawing that states none, `size` one of a graded DXF; `paper`, such as `"a4"`,
    divides a drawing into pages, and `width`, in mm, is that of a plotter's roll. `replace` lets it
    replace files. Raises `InputError` with all mistakes, `UsageError`, and `OutputError` for files
    that cannot be written.
    """
    path = path_of("convert", source)
    target = None if to is None else path_of("convert", to)
    words = {"unit": unit, "size": size, "paper": paper}
    texts = {name: word if word is None else text_of(f"convert({name}=)", word) for name, word in words.items()}
    if width is not None:
        width = number_of("width", width, "a width in mm from 100 to 100000, such as 900", 100, 1e5)
    options = {**texts, "width": width}
    replace = flag_of("replace", replace)
    with files("convert"):
        return _converted(path, target, options, replace)


def _converted(path: Path, target: Path | None, options: dict[str, Any], replace: bool) -> Converted:
    if path.is_dir():
        return _sheet(path, target, [name for name, value in options.items() if value is not None], replace)
    ending = "" if target is None else target.suffix.lower()
    if target is not None and ending not in _KINDS:
        raise UsageError(f"{target}: patterns are written as *.toml, *.svg or *.dxf")
    kind = _KINDS.get(ending, "pattern")
    style = "" if target is None else target.stem
    results, notes = _drape.convert_pattern(path, kind, {**options, "style": style})
    written: list[Path] = []
    if target is not None:
        named = {target.with_stem(target.stem + part): text for part, text in results}
        written = _write(named, replace)
    return Converted(kind, results[0][1], written, notes)


def _sheet(folder: Path, to: Path | None, options: list[str], replace: bool) -> Converted:
    if options:
        raise UsageError(f"{options[0]} is for patterns, and {folder} is a folder")
    if to is not None and to.suffix.lower() != ".toml":
        if to.suffix and not to.is_dir():
            advice = "the sheet of a folder of exports is written as *.toml, or into a folder"
            raise UsageError(f"{to}: {advice}")
        to = to / _SHEET
    # Without a file the sheet is one for the folder of the exports.
    text, notes = _drape.draft_sheet(folder, folder if to is None else to.parent)
    return Converted("sheet", text, [] if to is None else _write({to: text}, replace), notes)


def _write(texts: dict[Path, str], replace: bool) -> list[Path]:
    there = [str(file) for file in texts if file.exists()]
    if there and not replace:
        raise UsageError(f"{', '.join(there)} exists; write elsewhere, or with replace=True")
    for file, text in texts.items():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8", newline="\n")
    return list(texts)
