"""Drapemeters and validation."""

import os
import signal
import subprocess
import sys
import time

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


# A shell starts what runs in its background with SIGINT ignored, which Python leaves so.
INTERRUPTED = """
import signal, sys, drape
signal.signal(signal.SIGINT, signal.default_int_handler)
fabric = drape.fit(sys.argv[1]).fabric
print("running", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize(
    "call",
    [
        "drape.drapemeter(fabric, starts=8, spacing=0.005)",
        "drape.validate()",
        "[drape.fit(sys.argv[1], profile=True) for _ in range(10000)]",
    ],
)
def test_ctrl_c_ends_what_takes_long(call, root):
    code = INTERRUPTED.format(call=call)
    process = subprocess.Popen(
        [sys.executable, "-c", code, root / "fabrics/cupro-weave"], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "running\n"
    time.sleep(0.5)
    began = time.monotonic()
    os.kill(process.pid, signal.SIGINT)
    rest, _ = process.communicate(timeout=20)
    assert rest == "interrupted\n" and time.monotonic() - began < 1
