"""Processor time of stepping from Python over that of the command.

    python crates/drape-py/overhead.py SCENE [REPEATS]

Each repeat runs the command and a loop of `Simulation.step()` that reads the positions after each step,
one after the other, each first in every other repeat, on one thread. Both times are `cpu_seconds` of the
summary, which count from the checked scene to the end.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import drape


def command(scene: Path) -> float:
    target = Path(os.environ.get("CARGO_TARGET_DIR", "target"))
    with tempfile.TemporaryDirectory() as folder:
        run = [target / "release/drape", "run", scene, "-o", folder, "--force", "--no-picture"]
        subprocess.run([*run, "--threads", "1"], check=True, capture_output=True)
        return float(json.loads((Path(folder) / "summary.json").read_text())["cpu_seconds"])


def steps(scene: Path) -> float:
    simulation = drape.Simulation(drape.Scene.read(scene), threads=1)
    while not simulation.step().finished:
        simulation.positions
    return float(simulation.summary()["cpu_seconds"])


def main() -> None:
    scene, repeats = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5
    ratios = []
    for repeat in range(repeats):
        order = [command, steps] if repeat % 2 == 0 else [steps, command]
        found = {measure: measure(scene) for measure in order}
        ratios.append(found[steps] / found[command] - 1)
        print(f"command {found[command]:.2f} s, stepping {found[steps]:.2f} s: {ratios[-1]:+.1%}")
    middle = statistics.median(ratios)
    print(f"median {middle:+.1%}, from {min(ratios):+.1%} to {max(ratios):+.1%}")


if __name__ == "__main__":
    main()
