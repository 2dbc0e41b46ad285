"""Scenes, fabrics and fits go to other processes, and go on there with equal results."""

import copy
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
import trimesh

import drape

# Unpickles things in a folder without the files of the test, and says what becomes of them.
FRESH = """
import pickle, sys
from pathlib import Path
thing = pickle.loads(Path(sys.argv[1]).read_bytes())
import drape
if isinstance(thing, drape.Scene):
    simulation = drape.Simulation(thing)
    simulation.step()
    print([simulation.state_hash(), thing.run("own").summary["state_hash"], thing.name, thing.panels])
elif isinstance(thing, drape.Fit):
    print([thing.to_toml(), thing.report(), thing._repr_html_(), thing.assumed, thing.warnings,
           sorted((key, one.value, one.stderr) for key, one in thing.params.items()), len(thing.plot().axes)])
else:
    print([thing.to_toml(), thing.name])
"""


def in_fresh_process(thing, tmp_path):
    """Returns what a process says that has nothing but a pickle."""
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "thing.pickle").write_bytes(pickle.dumps(thing))
    ran = subprocess.run(
        [sys.executable, "-c", FRESH, "thing.pickle"], cwd=elsewhere, capture_output=True, text=True, timeout=120
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout.strip()


def hashes(scene):
    simulation = drape.Simulation(scene)
    simulation.step()
    return f"['{simulation.state_hash()}', '{scene.run().summary['state_hash']}', "


def test_a_scene_of_a_file_goes_on_elsewhere(towel, tmp_path, monkeypatch):
    # It is read by a relative path, and names files beside it and in the working folder.
    monkeypatch.chdir(tmp_path)
    scene = drape.Scene.read(towel.name)
    own = hashes(scene)
    (tmp_path / towel.name).write_text("changed = 1")
    assert in_fresh_process(scene, tmp_path).startswith(own)
    again = pickle.loads(pickle.dumps(scene))
    assert again.to_toml() == scene.to_toml() and again.notes == scene.notes and again.panels == scene.panels


def test_a_scene_of_a_text_goes_on_elsewhere(towel, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "below").mkdir()
    scene = drape.Scene.from_toml(towel.read_text().replace('"fabrics', '"../fabrics'), folder="below", allow=["fabrics"])
    assert in_fresh_process(scene, tmp_path).startswith(hashes(scene))


def test_a_scene_that_was_built_goes_on_elsewhere(root, tmp_path):
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=0.05)
    moved = np.stack([mesh.vertices, mesh.vertices + [0, 0.01, 0]])
    builder = drape.SceneBuilder(spacing=0.02, time={"step": 0.002, "end": 0.04}, folder=root)
    builder.fabric("held", drape.fit(root / "fabrics/cupro-weave")).fabric("read", "fabrics/tagawa-2003")
    builder.panel("towel", "held", rectangle=[0.2, 0.3], center=[0, 0.07, 0], turn=[-90, 0, 0])
    builder.panel("other", "read", rectangle=[0.1, 0.1], center=[1, 0.07, 0], turn=[-90, 0, 0])
    builder.mesh("ball", mesh, frames=moved, rate=25).mesh("far", mesh, center=[3, 0, 0])
    scene = builder.scene()
    # What happens to the builder does not matter to the scene.
    copied = copy.deepcopy(builder)
    builder.set(spacing=-1)
    told = in_fresh_process(scene, tmp_path)
    assert told.startswith(hashes(scene)) and told.startswith(hashes(copied.scene()))


def test_a_run_of_a_pickled_scene_goes_on_with_it(towel, tmp_path):
    scene = pickle.loads(pickle.dumps(drape.Scene.from_toml(towel.read_text(), folder=tmp_path)))
    run = pickle.loads(pickle.dumps(scene.run(tmp_path / "own", until=0.02)))
    assert drape.resume(run, scene=pickle.loads(pickle.dumps(scene)), extend=0.02).times[-1] == pytest.approx(0.04)
    frames = run.frames
    assert pickle.loads(pickle.dumps(run)).status == run.status == "ok" and len(frames) > 0


def test_a_fabric_and_a_fit_go_elsewhere_without_a_loss(root, tmp_path):
    fit = drape.fit(root / "fabrics/cupro-weave")
    own = [fit.to_toml(), fit.report(), fit._repr_html_(), fit.assumed, fit.warnings]
    own += [sorted((key, one.value, one.stderr) for key, one in fit.params.items()), len(fit.curves)]
    assert in_fresh_process(fit, tmp_path) == repr(own)
    for again in (pickle.loads(pickle.dumps(fit)), copy.deepcopy(fit), pickle.loads(pickle.dumps(copy.deepcopy(fit)))):
        assert again.report() == fit.report() and again.fabric.to_toml() == fit.to_toml()
        assert [np.array_equal(a["fitted"], b["fitted"]) for a, b in zip(again.curves, fit.curves)]
    fabric = pickle.loads(pickle.dumps(fit.fabric))
    assert fabric.to_toml() == copy.deepcopy(fit.fabric).to_toml() == fit.to_toml()

    def scene(source):
        builder = drape.SceneBuilder(spacing=0.02, time={"step": 0.002, "end": 0.02}).fabric("own", source)
        return builder.panel("towel", "own", rectangle=[0.2, 0.3]).scene()

    assert hashes(scene(fabric)) == hashes(scene(fit)) == hashes(scene(pickle.loads(pickle.dumps(fit))))
    fits = pickle.loads(pickle.dumps(drape.fit_all([root / "fabrics/cupro-weave", tmp_path / "none.toml"])))
    assert fits["cupro-weave"].to_toml() == fit.to_toml() and isinstance(fits.failures["none"], drape.InputError)


def test_a_fabric_goes_elsewhere_alone(root, tmp_path):
    fabric = drape.fit(root / "fabrics/tagawa-2003").fabric
    assert in_fresh_process(fabric, tmp_path) == repr([fabric.to_toml(), fabric.name])


def test_what_cannot_be_pickled_says_what_can(towel, root):
    simulation = drape.Simulation(drape.Scene.read(towel))
    for thing, words in ((simulation, "pickle its scene"), (drape.read_sheet(root / "fabrics/cupro-weave"), "its fit")):
        for work in (pickle.dumps, copy.copy, copy.deepcopy):
            with pytest.raises(drape.UsageError, match=words):
                work(thing)


def test_a_pickle_needs_the_files_that_its_scene_names(towel, tmp_path):
    pickled = pickle.dumps(drape.Scene.read(towel))
    os.rename(tmp_path / "fabrics", tmp_path / "gone")
    with pytest.raises(drape.InputError, match="sheet.toml"):
        pickle.loads(pickled)
