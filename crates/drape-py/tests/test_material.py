"""Materials for other programs are read back by other readers, and hold what a straight law has."""

import csv
import json
import math
import sys
import zipfile

import pytest

import drape

STRAIGHT = """
name = "straight \\"no. 2\\""
density = 0.15
thickness = 0.0004
surface_friction = 0.25
shear.stiffness = 40.0
[warp]
traction.primed = { stiffness = 3000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }
bending.rigidity = 1.5e-5
[weft]
traction.primed = { stiffness = 2000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }
bending.rigidity = 0.9e-5
"""


@pytest.fixture
def straight():
    return drape.Fabric.from_toml(STRAIGHT)


def test_the_script_for_blender_makes_settings_by_the_mesh(straight, tmp_path):
    straight.export(tmp_path / "cloth.py")
    script = {"__name__": "cloth"}
    exec((tmp_path / "cloth.py").read_text(encoding="utf-8"), script)
    assert script["NAME"] == straight.name
    assert (script["STRETCH"], script["BENDING"], script["DENSITY"]) == ((3000, 2000), (1.5e-5, 0.9e-5), 0.15)
    for spacing in (0.02, 0.005):
        own = script["settings"](spacing, spacing**2, 25.0)
        # A unit of Blender's time is sqrt(0.001) s; a spring stands for cloth of the width of a cell.
        assert math.isclose(own["mass"], 0.15 * spacing**2)
        assert math.isclose(own["tension_stiffness"], 2500 * spacing / 1000)
        assert math.isclose(own["shear_stiffness"], 2 * script["SHEAR"] * spacing / 1000)
        assert math.isclose(own["bending_stiffness"], 20 * 1.2e-5 / spacing**2 / 1000)
        assert math.isclose(own["time_scale"] * 25 * math.sqrt(0.001), 1)
        # The drag on a vertex at the speed of sinking, in its units, is its weight.
        speed = math.sqrt(0.15 * 9.81 / (0.5 * 1.2 * 1.17)) * math.sqrt(0.001)
        assert math.isclose(0.01 * own["air_damping"] * speed, own["mass"] * 9.81 * 0.001)
    # Springs of bending that are finer than the steps would blow up: finer meshes have more steps.
    coarse, fine = (script["settings"](h, h**2)["quality"] for h in (0.02, 0.005))
    assert fine > coarse >= 5


def test_the_archive_of_u3m_has_the_fabric_itself(straight, tmp_path):
    straight.export(tmp_path / "cloth.u3ma")
    with zipfile.ZipFile(tmp_path / "cloth.u3ma") as archive:
        assert archive.testzip() is None and archive.namelist() == ["material.u3m", "fabric.toml"]
        material = json.loads(archive.read("material.u3m"))
        laws = archive.read("fabric.toml").decode()
        assert all(entry.flag_bits == 0x800 for entry in archive.infolist())
    assert laws == straight.to_toml()
    physics = material["material"]["physics"]
    assert (physics["weight"], physics["thickness"]) == (150.0, 0.4)
    values = {(v["name"], v["direction"]): v for v in material["custom"]["drape"]["values"]}
    assert values["stretch", "warp"]["value"] == 3000 and values["stretch", "warp"]["unit"] == "N/m"
    assert any(text.startswith("Friction") for text in material["custom"]["drape"]["lost"])
    straight.export(tmp_path / "cloth.u3m")
    assert json.loads((tmp_path / "cloth.u3m").read_text("utf-8"))["material"]["id"] == material["material"]["id"]


def test_the_table_for_browzwear_has_its_units(straight, tmp_path):
    straight.export(tmp_path / "cloth.csv")
    with (tmp_path / "cloth.csv").open(newline="", encoding="utf-8") as file:
        rows = {(row["property"], row["direction"]): row for row in csv.DictReader(file)}
    value = lambda *key: (rows[key]["value"], rows[key]["unit"])
    assert value("Bend", "length") == ("150", "dyn·cm") and value("Bend", "width") == ("90", "dyn·cm")
    assert value("Stretch", "width") == ("2000", "N/m") and value("Mass", "") == ("150", "g/m²")
    assert value("Shear", "") == ("", "N/m")


@pytest.mark.skipif(sys.version_info < (3, 11), reason="tomllib")
def test_the_profile_for_ppf_contact_solver_gives_stretch_and_shear(straight, tmp_path):
    import tomllib

    straight.export(tmp_path / "cloth.toml")
    profile = tomllib.loads((tmp_path / "cloth.toml").read_text("utf-8"))[straight.name]
    young, poisson = profile["shell_young_modulus"], profile["shell_poisson_ratio"]
    # The Lamé parameters of the solver are stretch and shear over the density.
    mu = young / (2 * (1 + poisson))
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    assert math.isclose(mu, 2500 / 0.15, rel_tol=1e-5)
    assert math.isclose(lame, 40 / 0.15, rel_tol=2e-3)
    assert math.isclose(1.28e-5 * profile["bend"] * 0.15, 1.2e-5, rel_tol=1e-5)


def test_what_does_not_fit_is_refused(straight, tmp_path):
    losses = straight.export(tmp_path / "cloth.csv", load=5.0)
    assert any("from rest to 5 N/m" in loss for loss in losses)
    with pytest.raises(drape.UsageError, match="replace=True"):
        straight.export(tmp_path / "cloth.csv")
    with pytest.raises(drape.UsageError, match="program="):
        straight.export(tmp_path / "cloth.blend")
    with pytest.raises(drape.UsageError, match="blender, ppf"):
        straight.export(tmp_path / "cloth.py", program="clo")
    with pytest.raises(drape.UsageError, match="0.1 to 10000"):
        straight.export(tmp_path / "cloth.py", load=0.0)
    straight.export(tmp_path / "cloth.blend", program="blender")
    assert "bpy" in (tmp_path / "cloth.blend").read_text("utf-8")
