"""Processor time of stepping from Python over that of the command.

    python crates/drape-py/overhead.py SCENE [REPEATS]

Each repeat runs the command and a loop of `Simulation.step()` that reads the positions after each step,
one after the other, each first in every other repeat, on one thread. Both times are `cpu_seconds` of the
summary, which count from the checked scene to the end.

Where other load of the machine hides the difference, the cost of one step from Python tells it: that of a
sheet of few particles, stepped and run as a whole in turn, over the time of a step of the scene.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import drape

FABRIC = "fabrics/matsudaira-b"


def command(scene: Path) -> dict[str, float]:
    target = Path(os.environ.get("CARGO_TARGET_DIR", "target"))
    with tempfile.TemporaryDirectory() as folder:
        run = [str(target / "release/drape"), "run", str(scene), "-o", folder]
        subprocess.run([*run, "--force", "--no-picture", "--threads", "1"], check=True, capture_output=True)
        summary: dict[str, float] = json.loads((Path(folder) / "summary.json").read_text())
        return summary


def steps(scene: Path) -> dict[str, float]:
    simulation = drape.Simulation(drape.Scene.read(scene), threads=1)
    walk(simulation)
    return simulation.summary()


def walk(simulation: drape.Simulation) -> None:
    while not simulation.step().finished:
        simulation.positions


def seconds(work: Callable[[], object]) -> float:
    before = time.process_time()
    work()
    return time.process_time() - before


def cost_of_a_step(repeats: int) -> float:
    """Returns the processor time by which a step from Python is longer, in s."""
    builder = drape.SceneBuilder(spacing=0.05, time={"step": 0.001, "end": 1})
    builder.fabric("own", FABRIC).panel("sheet", "own", rectangle=[0.1, 0.1])
    builder.pin("sheet", edge="top")
    costs = []
    for _ in range(repeats):
        whole, scene = builder.scene(), builder.scene()
        run = seconds(lambda: whole.run(threads=1))
        simulation = drape.Simulation(scene, threads=1)
        costs.append((seconds(lambda: walk(simulation)) - run) / 1000)
    return statistics.median(costs)


def main() -> None:
    scene, repeats = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5
    ratios, times = [], []
    for repeat in range(repeats):
        order = [command, steps] if repeat % 2 == 0 else [steps, command]
        found = {measure: measure(scene) for measure in order}
        told, own = (found[measure]["cpu_seconds"] for measure in (command, steps))
        ratios.append(own / told - 1)
        times.append(told / found[command]["steps"])
        print(f"command {told:.2f} s, stepping {own:.2f} s: {ratios[-1]:+.1%}")
    middle = statistics.median(ratios)
    print(f"median {middle:+.1%}, from {min(ratios):+.1%} to {max(ratios):+.1%}")
    cost, step = cost_of_a_step(11), statistics.median(times)
    print(f"a step of {1e3 * step:.2f} ms costs {1e6 * cost:.0f} µs more: {cost / step:+.2%}")


if __name__ == "__main__":
    main()
