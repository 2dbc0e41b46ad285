"""Drapemeters and validation."""

import pytest

import drape


def test_cases_of_the_validation_run_by_name():
    assert "catenary" in drape.cases()
    [outcome] = drape.validate(["catenary"])
    assert outcome["name"] == "catenary" and outcome["passes"] and outcome["checks"]
    with pytest.raises(drape.UsageError, match="give one of"):
        drape.validate("chain")


def test_settings_of_a_drapemeter_are_checked(root):
    fabric = drape.fit(root / "fabrics/cupro-weave").fabric
    with pytest.raises(drape.UsageError, match="frl, cusick-24"):
        drape.drapemeter(fabric, meter="round")
    with pytest.raises(drape.UsageError, match="above 0"):
        drape.drapemeter(fabric, spacing=-0.01)
    with pytest.raises(drape.SolverError):
        drape.drapemeter(fabric, starts=1)


def test_a_fabric_drapes(root):
    fabric = drape.fit(root / "fabrics/cupro-weave").fabric
    found = drape.drapemeter(fabric, starts=2, spacing=0.02)
    assert 0 < found["coefficient"] < 1 and found["coefficients"].shape == (2,)
