"""Children of a fork use the package as their parent did, and never wait for its threads."""

import ast
import os
import signal
import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")

# Seconds after which a child counts as one that waits for ever.
PATIENCE = 60

# Uses the package before it forks; `child(work)` returns what the work in a child of a fork says.
BEGIN = """
import multiprocessing, os, shutil, sys, threading, warnings
from pathlib import Path
import numpy as np
import drape

warnings.simplefilter("ignore", DeprecationWarning)
towel, out = sys.argv[1:]
scene = drape.Scene.read(towel)
kept = scene.run(Path(out, "parent"))
simulation = drape.Simulation(scene)
simulation.step()
fabrics = Path(towel).parent / "fabrics"
fit = drape.fit(fabrics / "cupro-weave")

def mistake(work):
    try:
        work()
    except drape.Error as error:
        return error

def child(work):
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        try:
            said = work()
        except BaseException as error:
            said = f"{type(error).__name__}: {error}"
        os.write(writing, str(said).encode())
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        said = pipe.read()
    os.waitpid(process, 0)
    return said
"""


def told(code, *arguments):
    """Returns what a program prints; ends it with all its children if it takes too long."""
    process = subprocess.Popen(
        [sys.executable, "-c", BEGIN + code, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        out, err = process.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        pytest.fail(f"waits for ever after {out!r}: {err}")
    assert process.returncode == 0, err
    return out.splitlines()


# What a process does with the package; results go to folders with the name `own`.
USES = {
    "a scene is read": "drape.Scene.read(towel).particles",
    "a scene that was read is run": "scene.run().summary['state_hash']",
    "a scene is run into a folder": "scene.run(Path(out, own), threads=2).summary['state_hash']",
    "a stored run is checked": "[all(v['holds'] for v in kept.check()), drape.open(kept.folder).times]",
    "a stored run is read": "kept.frames[-1].sum()",
    "a run goes on": "drape.resume(shutil.copytree(kept.folder, Path(out, own)), extend=0.01).times",
    "runs are viewed": "len(drape.view(kept).html)",
    "a simulation that was begun is stepped": "[simulation.step().time, simulation.state_hash()]",
    "a simulation that was begun is read": "[simulation.energy(), simulation.pin_loads(), simulation.bodies]",
    "a simulation is made": "drape.Simulation(scene, threads=2).step().speed_max",
    "a sheet is fitted": "drape.fit(fabrics / 'cupro-weave').to_toml()",
    "sheets are fitted": "[one.to_toml() for one in drape.fit_all(fabrics).values()]",
    "a fit is reported": "fit.report()",
    "a case is validated": "drape.validate('catenary')[0]['passes']",
    "a fabric is draped": "drape.drapemeter(fit.fabric, starts=2, spacing=0.03)['coefficient']",
    "a mistake is told": "str(mistake(lambda: drape.Scene.from_toml('spacing = -1')))",
}


@pytest.mark.parametrize("use", USES)
def test_a_child_comes_to_the_results_of_its_parent(use, towel, tmp_path):
    code = f"def use(own):\n    return repr({USES[use]})\nprint([child(lambda: use('one')), use('other')])"
    [said] = told(code, towel, tmp_path)
    in_child, in_parent = ast.literal_eval(said)
    assert "Error" not in in_child or use == "a mistake is told"
    assert in_child == in_parent and len(in_child) > 2


def test_children_of_a_child_and_of_a_busy_thread_come_to_the_same(towel, tmp_path):
    code = """
def step():
    return drape.Simulation(scene).step().speed_max
print(step())
print(child(lambda: [step(), child(step)]))
busy = threading.Thread(target=lambda: drape.Scene.read(towel).run(until=0.05))
busy.start()
print(child(step))
busy.join()
# Another thread has a simulation in a step while the process is forked.
held = drape.Simulation(scene)
ended = threading.Event()
def steps():
    while not ended.is_set():
        held.step()
busy = threading.Thread(target=steps)
busy.start()
def stepped():
    try:
        return held.step().time > 0
    except drape.Error as error:
        return isinstance(error, drape.UsageError) and "in another call" in str(error)
print({child(stepped) for _ in range(10)})
ended.set()
busy.join()
"""
    speed, below, beside, stepped = told(code, towel, tmp_path)
    assert float(speed) > 0 and below == f"[{speed}, '{speed}']" and beside == speed
    assert stepped == "{'True'}"


def test_a_pool_of_processes_with_fork_runs_scenes(towel, tmp_path):
    code = """
def run(step):
    text = Path(towel).read_text().replace("step = 0.002", f"step = {step}")
    one = drape.Scene.from_toml(text, folder=Path(towel).parent)
    return one.run(until=0.02).summary["state_hash"]
steps = [0.001, 0.002, 0.004]
with multiprocessing.get_context("fork").Pool(2) as pool:
    hashes = pool.map(run, steps)
    scenes = pool.map(drape.Scene.read, [towel])
print(hashes == [run(step) for step in steps], len(set(hashes)), scenes[0].particles == scene.particles)
"""
    assert told(code, towel, tmp_path) == ["True 3 True"]


def test_a_fork_within_a_callback_is_ended_or_refused(towel, tmp_path):
    code = """
# Runs the scene, and forks at its first frame a child, which does `work` there.
def forked(work):
    reading, writing = os.pipe()
    made = []
    def fork(frame):
        if not made:
            made.append(os.fork())
            if made[0] == 0:
                work(writing)
    try:
        status = scene.run(on_frame=fork, until=0.02).status
    except drape.UsageError as error:
        os.write(writing, f"refused: {error}".encode())
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        said = pipe.read()
    os.waitpid(made[0], 0)
    return status, said

def ends(writing):
    os.write(writing, str(drape.Simulation(scene).step().time).encode())
    os._exit(0)

print(forked(ends))
print(forked(lambda writing: None))
"""
    ended, returned = map(ast.literal_eval, told(code, towel, tmp_path))
    assert ended == ("ok", "0.002")
    assert returned[0] == "ok" and returned[1].startswith("refused: ") and "os._exit" in returned[1]
