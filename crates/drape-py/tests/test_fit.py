"""Fits are those of the command, and say how certain they are."""

import subprocess
import sys

import numpy as np
import pytest

import drape


def test_a_fit_gives_the_bytes_that_the_command_writes(root, command, tmp_path):
    told = tmp_path / "cupro.toml"
    sheet = root / "fabrics/cupro-weave"
    subprocess.run([command, "fit", sheet, "-o", told], check=True, capture_output=True)
    assert drape.fit(sheet).to_toml().encode() == told.read_bytes()
    assert drape.fit(drape.read_sheet(sheet)).to_toml().encode() == told.read_bytes()


def test_parameters_have_errors_and_correlations(root):
    fit = drape.fit(root / "fabrics/cupro-weave")
    assert fit.curves and len(fit.params) > 4
    warp, weft = fit.params["warp.B"], fit.params["weft.bending.rigidity"]
    assert warp.value > 0 and 0 < warp.stderr < warp.value
    assert warp.interval[0] < warp.value < warp.interval[1]
    assert warp.name == "warp.bending.rigidity" and warp.unit == "N·m"
    assert "warp.bending.zero" in warp.correl and all(-1 <= c <= 1 for c in warp.correl.values())
    mean = fit.params["B"]
    assert mean.value == pytest.approx((warp.value + weft.value) / 2)
    assert mean.stderr == pytest.approx(np.hypot(warp.stderr, weft.stderr) / 2)
    with pytest.raises(KeyError, match="warp.bending.rigidity"):
        fit.params["none"]
    curve = fit.curves[0]
    assert curve["measured"].shape == curve["deformation"].shape == curve["fitted"].shape
    residuals = curve["measured"] - curve["fitted"]
    spread = np.ptp(curve["measured"])
    assert np.sqrt(np.mean(residuals**2)) / spread == pytest.approx(curve["misfit"], rel=0.2)


def test_parameters_from_values_have_no_errors(root):
    fit = drape.fit(root / "fabrics/matsudaira-b")
    rigidity = fit.params["B"]
    keys = ("warp.bending.rigidity", "weft.bending.rigidity")
    assert rigidity.value == pytest.approx(sum(fit.params[key].value for key in keys) / 2)
    assert rigidity.stderr is None and "value of the sheet" in rigidity.reason
    assert fit.params["G"].value > 0


def test_a_fit_is_reported(root):
    fit = drape.fit(root / "fabrics/cupro-weave")
    assert "cupro weave" in fit.report()
    assert fit._repr_html_().startswith("<iframe")
    assert len(fit.plot().axes) == len(fit.curves)


def test_a_plot_without_matplotlib_says_what_to_install(root, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(drape.UsageError, match="pip install matplotlib"):
        drape.fit(root / "fabrics/cupro-weave").plot()


def test_laws_are_chosen_by_name(root):
    sheet = drape.read_sheet(root / "fabrics/cupro-weave")
    assert drape.fit(sheet, bending="first-order").to_toml() != ""
    with pytest.raises(drape.UsageError, match="give one of first-order"):
        drape.fit(sheet, bending="third-order")


@pytest.mark.parametrize("former, law", [("parallel", "two-elements"), ("breen-1994", "piecewise")])
def test_a_former_name_of_a_law_is_accepted_with_a_warning(root, former, law):
    sheet = drape.read_sheet(root / "fabrics/cupro-weave")
    with pytest.warns(FutureWarning, match=f"`{former}` is now called `{law}`") as warned:
        fit = drape.fit(sheet, bending=former)
    assert [warning.filename for warning in warned] == [__file__]
    assert fit.to_toml() == drape.fit(sheet, bending=law).to_toml()
    with pytest.warns(FutureWarning, match=f"shear: `{former}`"):
        fits = drape.fit_all([root / "fabrics/cupro-weave"], shear=former)
    assert fits["cupro-weave"].to_toml() == drape.fit(sheet, shear=law).to_toml()


def test_a_fabric_comes_back_from_its_text(root, tmp_path):
    fabric = drape.fit(root / "fabrics/cupro-weave").fabric
    path = tmp_path / "fabric.toml"
    path.write_text(fabric.to_toml())
    assert drape.Fabric.read(path).to_toml() == fabric.to_toml()
    assert fabric.density == pytest.approx(0.1056) and fabric.thickness > 0


def test_a_fabric_is_made_of_values():
    yarns = {"B": 0.1, "2HB": 0.03, "LT": 0.7, "WT": 10.0, "RT": 50.0, "G": 0.6, "2HG": 0.5}
    fabric = drape.Fabric.from_values("poplin", {"W": 12.4, "T": 0.4, "warp": yarns, "weft": yarns})
    assert fabric.name == "poplin" and fabric.density == pytest.approx(0.124)
    with pytest.raises(drape.InputError, match="W"):
        drape.Fabric.from_values("poplin", {"W": -1.0})


def test_arrays_are_fitted_as_files(root):
    sheet = drape.read_sheet(root / "fabrics/cupro-weave")
    told = drape.fit(sheet)
    curves = []
    files = ["stretch-8cm-warp", "stretch-8cm-weft"]
    files += [f"loop-bend-{up}-{way}" for way in ("warp", "weft") for up in ("up", "down-1")]
    for file in files:
        path = root / f"fabrics/cupro-weave/{file}.csv"
        table = np.genfromtxt(path, delimiter=",", names=True)
        test = "tensile" if "stretch" in file else "loop-bending"
        curve = drape.Curve(
            test,
            file[-4:],
            table["clamp_distance_m"],
            table["force_N"],
            deformation_unit="m",
            gauge=float(table["specimen_length_m"][0]),
            load_unit="N",
            width=float(table["clamp_width_m"][0]),
            zero="distance",
            slack=test == "tensile",
        )
        curves.append(curve)
    values = {"W": "105.6 g/m2", "T": "0.1046 mm"}
    own = drape.fit(drape.Sheet.from_curves(sheet.name, curves, values))
    assert own.to_toml().split("[warp", 1)[1] == told.to_toml().split("[warp", 1)[1]
    assert drape.fit(curves).params["warp.B"].value == told.params["warp.B"].value
    strain = np.linspace(0, 0.05, 40)
    bent = drape.fit([drape.Curve("tensile", "warp", strain, 2000 * strain)])
    assert bent.curves[0]["measured"].max() == pytest.approx(100)
    with pytest.raises(drape.UsageError, match=r"shapes \(40,\) and \(39,\); give \(n,\)"):
        drape.fit([drape.Curve("tensile", "warp", strain, strain[1:])])
    with pytest.raises(drape.InputError) as caught:
        drape.fit([drape.Curve("tensile", "warp", strain, np.full(40, np.nan))])
    assert caught.value.file == "<arrays>/curve-1.csv" and caught.value.remedy


def test_a_folder_of_sheets_is_fitted_as_by_the_command(root, command, tmp_path):
    fits = drape.fit_all(root / "fabrics")
    told = tmp_path / "told"
    subprocess.run([command, "fit", root / "fabrics", "-o", told], capture_output=True, check=True)
    assert {f"{name}.toml" for name in fits} == {path.name for path in told.iterdir()}
    for name, fit in fits.items():
        assert fit.to_toml().encode() == (told / f"{name}.toml").read_bytes()
    assert not fits.failures
    with pytest.raises(drape.UsageError, match="drape.fit_all"):
        drape.fit(root / "fabrics")
    (tmp_path / "wrong/one").mkdir(parents=True)
    with pytest.raises(drape.UsageError, match="holds no sheet.toml"):
        drape.fit_all(tmp_path / "wrong")
    (tmp_path / "wrong/one/sheet.toml").write_text("W = -1\n")
    some = drape.fit_all([tmp_path / "wrong", root / "fabrics/matsudaira-b"])
    assert list(some) == ["matsudaira-b"] and list(some.failures) == ["one"]
    assert isinstance(some.failures["one"], drape.InputError)
    with pytest.raises(drape.InputError):
        some["one"]


TABLE = "Parameter,Unit,Warp 1,Warp 2,Weft\nB,gf.cm2/cm,0.110,0.114,0.061\nW,g/m2,213,,\n"


def test_a_table_is_fitted_as_by_the_command(command, tmp_path):
    table = tmp_path / "weft-values.csv"
    table.write_text(TABLE, encoding="utf-8")
    fit = drape.fit(table)
    subprocess.run([command, "fit", table], check=True, capture_output=True)
    assert fit.to_toml() == (tmp_path / "weft-values.toml").read_text(encoding="utf-8")
    sheet = drape.read_sheet(table)
    assert any(r.startswith("B warp = 0.112 ± 0.002828 gf.cm2/cm") for r in sheet.readings), sheet.readings
    assert fit.params["warp.B"].value == pytest.approx(0.112 * 9.80665e-5)


def test_one_of_several_fabrics_is_named(tmp_path):
    table = tmp_path / "fabrics.csv"
    table.write_text("Fabric,B warp,B weft,W\npoplin,0.1,0.08,12\nserge,0.3,0.2,25\n", encoding="utf-8")
    with pytest.raises(drape.InputError, match='"poplin", "serge"'):
        drape.fit(table)
    assert drape.fit(table, fabric="serge").fabric.density == pytest.approx(0.25)
