"""Runs are those of the command, and end when they are asked to."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import drape

# What differs from run to run.
TIMES = ("wall_seconds", "cpu_seconds", "threads")


def without_times(summary):
    return {key: value for key, value in summary.items() if key not in TIMES}


def frames(folder):
    kept = {p.name: p.read_bytes() for p in folder.iterdir() if p.suffix in (".npy", ".csv", ".obj")}
    kept["surfaces.json"] = (folder / "surfaces.json").read_bytes()
    return kept


def same_results(one, other):
    assert frames(one) == frames(other)
    first, second = (json.loads((f / "summary.json").read_text()) for f in (one, other))
    assert without_times(first) == without_times(second)


def test_a_run_writes_the_bytes_of_the_command(towel, command, tmp_path):
    told = tmp_path / "told"
    ran = subprocess.run([command, "run", towel, "-o", told, "--no-picture"], capture_output=True)
    assert ran.returncode == 0, ran.stderr
    run = drape.Scene.read(towel).run(tmp_path / "own", threads=2)
    assert run.status == "ok"
    assert len(frames(told)) > 6
    same_results(told, tmp_path / "own")


def test_a_run_without_a_folder_ends_as_one_with(towel, tmp_path):
    scene = drape.Scene.read(towel)
    kept = scene.run(tmp_path / "own")
    loose = scene.run(threads=1)
    assert without_times(loose.summary) == without_times(kept.summary)
    with pytest.raises(drape.UsageError, match="output="):
        loose.frames


def test_callbacks_hear_of_steps_and_frames(towel):
    steps, seen = [], []
    run = drape.Scene.read(towel).run(progress=steps.append, on_frame=seen.append, until=0.05)
    assert len(steps) == run.summary["steps"] and steps[-1].done == 1.0
    assert steps[-1].time == pytest.approx(0.05)
    assert [frame.number for frame in seen] == list(range(len(seen)))
    assert seen[0].positions.shape == (21 * 31, 3) and not seen[0].positions.flags.writeable


def test_a_limit_of_time_ends_a_run_with_and_without_a_folder(towel, tmp_path):
    scene = drape.Scene.read(towel)
    for output in (None, tmp_path / "own"):
        run = scene.run(output, until=1000, max_wall=0.3)
        assert run.status == "interrupted" and "limit of time" in run.summary["reason"]
        assert 0.3 <= run.summary["wall_seconds"] < 20


def test_a_callback_that_fails_ends_the_run(towel):
    def fail(step):
        raise ValueError("enough")

    began = time.monotonic()
    with pytest.raises(ValueError, match="enough"):
        drape.Scene.read(towel).run(progress=fail, until=1000)
    assert time.monotonic() - began < 20


def test_other_threads_run_meanwhile(towel):
    counted, ended = [0], threading.Event()

    def count():
        while not ended.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    run = drape.Scene.read(towel).run(threads=1)
    ended.set()
    thread.join()
    assert counted[0] > 100 * min(1.0, run.summary["wall_seconds"])


def test_results_are_replaced_only_where_that_is_allowed(towel, tmp_path):
    scene = drape.Scene.read(towel)
    scene.run(tmp_path / "own", until=0.01)
    with pytest.raises(drape.UsageError, match="replace=True"):
        scene.run(tmp_path / "own", until=0.01)
    scene.run(tmp_path / "own", until=0.01, replace=True)
    with pytest.raises(drape.UsageError, match="extend=SECONDS"):
        drape.resume(tmp_path / "own")
    longer = drape.resume(tmp_path / "own", extend=0.02)
    assert longer.times[-1] == pytest.approx(0.03)
    with pytest.raises(drape.UsageError, match="until=0.001: a step takes"):
        scene.run(until=0.001)
    with pytest.raises(drape.UsageError, match="threads=0"):
        scene.run(threads=0)


# A shell starts what runs in its background with SIGINT ignored, which Python leaves so.
INTERRUPTED = """
import signal, sys, drape
signal.signal(signal.SIGINT, signal.default_int_handler)
scene = drape.Scene.read(sys.argv[1])
def told(step):
    if step.time > 0.02:
        print("running", flush=True)
try:
    scene.run(sys.argv[2], progress=told)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_ctrl_c_leaves_a_checkpoint_from_which_a_run_goes_on(towel, tmp_path):
    towel.write_text(towel.read_text().replace("end = 0.1", "end = 0.6"))
    own = tmp_path / "own"
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, towel, own], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "running\n"
    began = time.monotonic()
    os.kill(process.pid, signal.SIGINT)
    rest, _ = process.communicate(timeout=20)
    assert rest.endswith("interrupted\n") and time.monotonic() - began < 1
    assert json.loads((own / "summary.json").read_text())["status"] == "interrupted"
    with pytest.raises(drape.UsageError, match="drape.resume"):
        drape.Scene.read(towel).run(own)
    assert drape.resume(own).status == "ok"
    drape.Scene.read(towel).run(tmp_path / "whole")
    same_results(own, tmp_path / "whole")


@pytest.mark.slow
def test_the_shirt_is_that_of_the_command_and_is_interrupted(root, command, tmp_path):
    scene, own = root / "scenes/tshirt.toml", tmp_path / "own"
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, scene, own], stdout=subprocess.PIPE, text=True, cwd=root
    )
    assert process.stdout.readline() == "running\n"
    time.sleep(3)
    began = time.monotonic()
    os.kill(process.pid, signal.SIGINT)
    rest, _ = process.communicate(timeout=20)
    seconds = time.monotonic() - began
    print(f"Ctrl-C returned after {seconds:.2f} s")
    assert rest.endswith("interrupted\n") and seconds < 1
    assert drape.resume(own).status == "ok"
    told = [command, "run", scene, "-o", tmp_path / "told", "--no-picture"]
    subprocess.run(told, check=True, capture_output=True, cwd=root)
    same_results(tmp_path / "told", own)
    drape.Scene.read(scene).run(tmp_path / "whole")
    same_results(tmp_path / "told", tmp_path / "whole")


def test_a_damaged_checkpoint_is_warned_of(towel, tmp_path):
    drape.Scene.read(towel).run(tmp_path / "own", until=0.05, checkpoint_every=0)
    kept = sorted(tmp_path.glob("own/**/*checkpoint*"))
    assert len(kept) > 1, list(tmp_path.glob("own/**/*"))
    newest = max(kept, key=lambda path: path.stat().st_mtime_ns)
    newest.write_bytes(newest.read_bytes()[:-40])
    with pytest.warns(drape.RunWarning, match="is damaged"):
        drape.resume(tmp_path / "own", extend=0.02)


def test_stored_runs_are_opened(towel, tmp_path):
    scene = drape.Scene.read(towel)
    scene.run(tmp_path / "own")
    run = drape.open(tmp_path / "own")
    assert run.status == "ok" and run.summary["particles"] == scene.particles
    assert run.times[0] == 0 and run.times[-1] == pytest.approx(0.1)
    assert len(run.frames) == len(run.times) == run.summary["frames"]
    first, last = run.frames[0], run.frames[-1]
    assert first.shape == last.shape == (scene.particles, 3)
    assert last[:, 1].min() < first[:, 1].min()
    assert np.array_equal(run.frames[len(run.frames) - 1], last)
    assert run.triangles.max() == scene.particles - 1 and run.panels == scene.panels
    assert run.coordinates.shape == (scene.particles, 2)
    assert all(verdict["holds"] for verdict in run.check())
    with pytest.raises(IndexError):
        run.frames[len(run.frames)]
    with pytest.raises(drape.OutputError):
        drape.open(tmp_path)


def test_a_run_is_viewed(towel, tmp_path):
    run = drape.Scene.read(towel).run(tmp_path / "own", until=0.02)
    view = drape.view(run)
    assert view._repr_html_().startswith("<iframe") and "<html" in view.html
    view.save(tmp_path / "view.html")
    with pytest.raises(drape.UsageError, match="output="):
        drape.view()


def test_the_package_has_the_version_of_the_command(command):
    said = subprocess.run([command, "--version"], check=True, capture_output=True, text=True).stdout
    assert said.split()[-1] == drape.__version__
