"""Patterns and exports are converted as by the command."""

import shutil
import subprocess

import pytest

import drape


@pytest.fixture
def skirt(root, tmp_path):
    shutil.copy(root / "crates/drape-pattern/patterns/skirt.json", tmp_path)
    return tmp_path / "skirt.json"


@pytest.fixture
def exports(root, tmp_path):
    folder = tmp_path / "exports"
    folder.mkdir()
    for name in ("tensile", "bending-loops"):
        shutil.copy(root / f"fabrics/tagawa-2003/{name}.csv", folder / f"{name}-warp.csv")
    return folder


def told(command, *arguments, cwd=None):
    ran = subprocess.run([command, "convert", *arguments], cwd=cwd, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def test_a_pattern_is_the_text_and_the_file_of_the_command(skirt, command, tmp_path):
    converted = drape.convert(skirt)
    assert (converted.kind, converted.files) == ("pattern", [])
    assert converted.text.rstrip() == told(command, skirt).rstrip() == str(converted).rstrip()
    written = drape.convert(skirt, tmp_path / "skirt.toml")
    assert written.files == [tmp_path / "skirt.toml"]
    assert (tmp_path / "skirt.toml").read_text() == written.text == converted.text
    with pytest.raises(drape.UsageError, match="replace=True"):
        drape.convert(skirt, tmp_path / "skirt.toml")
    drape.convert(skirt, tmp_path / "skirt.toml", replace=True)


def test_a_pattern_is_drawn_whole_and_on_pages(skirt, command, tmp_path):
    drawing = drape.convert(skirt, tmp_path / "skirt.svg", width=900)
    assert drawing.kind == "drawing" and drawing.text.startswith("<svg")
    told(command, skirt, "-o", "told.svg", "--width", "900", cwd=tmp_path)
    assert (tmp_path / "told.svg").read_bytes() == (tmp_path / "skirt.svg").read_bytes()
    pages = drape.convert(skirt, tmp_path / "page.svg", paper="a4").files
    assert pages[0].name == "page-A1.svg" and len(pages) > 8
    for wrong in ({"paper": "a9"}, {"width": 5}, {"paper": "a4", "width": 900}, {"unit": "ell"}):
        with pytest.raises(drape.UsageError, match=next(iter(wrong))):
            drape.convert(skirt, tmp_path / "wrong.svg", **wrong)
    with pytest.raises(drape.UsageError, match="svg"):
        drape.convert(skirt, paper="a4")
    with pytest.raises(drape.UsageError, match=r"\*.toml, \*.svg or \*.dxf"):
        drape.convert(skirt, tmp_path / "skirt.pdf")


def test_a_pattern_goes_to_dxf_as_by_the_command(skirt, command, tmp_path):
    written = drape.convert(skirt, tmp_path / "skirt.dxf")
    assert written.kind == "dxf" and any("seams" in note for note in written.notes)
    (tmp_path / "by_command").mkdir()
    told(command, skirt, "-o", "by_command/skirt.dxf", cwd=tmp_path)
    assert (tmp_path / "by_command/skirt.dxf").read_bytes() == (tmp_path / "skirt.dxf").read_bytes()


def test_a_folder_of_exports_becomes_a_sheet(exports, command, tmp_path):
    draft = drape.convert(exports)
    assert draft.kind == "sheet" and draft.text.rstrip() == told(command, exports).rstrip()
    written = drape.convert(exports, tmp_path / "sheet.toml")
    assert written.files == [tmp_path / "sheet.toml"]
    assert "exports/tensile-warp.csv" in written.text
    assert drape.convert(exports, exports).files == [exports / "sheet.toml"]
    with pytest.raises(drape.UsageError, match="unit is for patterns"):
        drape.convert(exports, unit="mm")


def test_what_is_no_pattern_is_named(root, tmp_path):
    with pytest.raises(drape.InputError, match="this is a sheet of measurements, not a drawing"):
        drape.convert(root / "fabrics/tagawa-2003/sheet.toml")
    with pytest.raises(drape.InputError) as caught:
        drape.convert(tmp_path / "nothing.json")
    assert "nothing.json" in str(caught.value)
