"""Whatever a call is given, what comes out is a `drape.Error` with a message, and no fault."""

import copy
import math
import os
import shutil
import threading
import warnings
from pathlib import Path

import numpy as np
import pytest

import drape
from conftest import ROOT, SCENE


class Unshown:
    def __repr__(self):
        raise RuntimeError("it has no text")


class OfBytes:
    def __fspath__(self):
        return b"bytes"


CYCLE: list = []
CYCLE.append(CYCLE)

# What no call takes, or hardly one.
WRONG = {
    "none": None,
    "five": 5,
    "below zero": -1,
    "zero": 0,
    "nan": math.nan,
    "infinity": math.inf,
    "huge": 1e300,
    "beyond floats": 10**400,
    "beyond texts": 10**5000,
    "65 bits": 2**64,
    "truth": True,
    "no text": "",
    "text": "x",
    "zero byte": "a\0b",
    "half a letter": "\ud800",
    "no letter": "\udcff",
    "long text": "x" * 5000,
    "bytes": b"x",
    "bytes of a path": OfBytes(),
    "list": [],
    "ragged list": [1, [2, 3]],
    "mixed list": [0, 0, "z"],
    "cycle": CYCLE,
    "infinite triple": [math.inf] * 3,
    "huge triple": [1e300] * 3,
    "dictionary": {},
    "odd dictionary": {1: object()},
    "object": object(),
    "unshown": Unshown(),
    "no numbers": np.array([]),
    "scalar": np.array(5.0),
    "other shape": np.zeros((2, 3, 4)),
    "not a number": np.full((4, 3), np.nan),
    "texts": np.array(["a"]),
    "complex": np.array([1j]),
    "objects": np.array([None]),
    "dates": np.array(["2020"], dtype="datetime64[D]"),
    "longest float": np.longdouble(1),
    "missing file": Path("/dev/null/x.toml"),
    "folder": Path("."),
    "slice": slice(None),
}

BOX = 0.05 * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) + 1
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


class Things:
    """What is right, beside what is wrong in a call."""

    def __init__(self, folder):
        self.folder = folder
        shutil.copytree(ROOT / "fabrics/cupro-weave", folder / "fabrics/cupro-weave")
        self.sheet = folder / "fabrics/cupro-weave"
        self.skirt = shutil.copy(ROOT / "crates/drape-pattern/patterns/skirt.json", folder)
        self.towel = folder / "towel.toml"
        self.towel.write_text(SCENE)
        self.scene = drape.Scene.read(self.towel)
        self.run = self.scene.run(folder / "run", until=0.02)
        self.fit = drape.fit(self.sheet)
        builder = drape.SceneBuilder(spacing=0.02, time={"step": 0.005, "end": 0.1}).fabric("own", self.fit)
        builder.panel("cloth", "own", rectangle=[0.2, 0.2]).mesh("tip", BOX, FACES)
        self._builder = builder.body("ball", "sphere", radius=0.05, center=[0, -1, 0])
        self.simulation = drape.Simulation(self._builder.scene())

    @property
    def builder(self):
        return copy.deepcopy(self._builder)

    def short(self, **settings):
        return self.scene.run(**({"until": 0.004} | settings))

    def curve(self, **wrong):
        line = np.linspace(0, 1, 20)
        keys = {"test": "bending", "direction": "warp", "deformation": line, "load": line} | wrong
        return drape.fit([drape.Curve(**keys)])


@pytest.fixture(scope="module")
def things(tmp_path_factory):
    return Things(tmp_path_factory.mktemp("things"))


CALLS = {
    "Scene.read(x)": lambda t, x: drape.Scene.read(x),
    "Scene.read(allow=x)": lambda t, x: drape.Scene.read(t.towel, allow=x),
    "Scene.from_toml(x)": lambda t, x: drape.Scene.from_toml(x),
    "Scene.from_toml(folder=x)": lambda t, x: drape.Scene.from_toml(SCENE, folder=x),
    "Scene.run(x)": lambda t, x: t.short(output=x),
    "Scene.run(progress=x)": lambda t, x: t.short(progress=x),
    "Scene.run(on_frame=x)": lambda t, x: t.short(on_frame=x),
    "Scene.run(until=x)": lambda t, x: t.scene.run(until=x, max_wall=0.05),
    "Scene.run(threads=x)": lambda t, x: t.short(threads=x),
    "Scene.run(replace=x)": lambda t, x: t.short(replace=x),
    "Scene.run(checkpoint_every=x)": lambda t, x: t.short(checkpoint_every=x),
    "Scene.run(state_hash=x)": lambda t, x: t.short(state_hash=x),
    "Scene.run(max_wall=x)": lambda t, x: t.short(max_wall=x),
    "resume(x)": lambda t, x: drape.resume(x),
    "resume(scene=x)": lambda t, x: drape.resume(t.run, scene=x),
    "resume(extend=x)": lambda t, x: drape.resume(t.run, extend=x, max_wall=0.01),
    "Simulation(x)": lambda t, x: drape.Simulation(x),
    "Simulation(threads=x)": lambda t, x: drape.Simulation(t.scene, threads=x),
    "step(x)": lambda t, x: t.simulation.step(x),
    "move_body(x)": lambda t, x: t.simulation.move_body(x, shift=[0, 0, 0]),
    "move_body(vertices=x)": lambda t, x: t.simulation.move_body("tip", x),
    "move_body(shift=x)": lambda t, x: t.simulation.move_body("ball", shift=x),
    "move_body(turn=x)": lambda t, x: t.simulation.move_body("ball", turn=x),
    "move_body(center=x)": lambda t, x: t.simulation.move_body("ball", shift=[0, 0, 0], center=x),
    "move_body(seconds=x)": lambda t, x: t.simulation.move_body("ball", shift=[0, 0, 0], seconds=x),
    "open(x)": lambda t, x: drape.open(x),
    "view(x)": lambda t, x: drape.view(x),
    "view(megabytes=x)": lambda t, x: drape.view(t.run, megabytes=x),
    "View(x)": lambda t, x: drape.View(x),
    "View.save(x)": lambda t, x: drape.View("<p>").save(x),
    "frames[x]": lambda t, x: t.run.frames[x],
    "frames[x:]": lambda t, x: t.run.frames[x:],
    "Run.bodies(x)": lambda t, x: t.run.bodies(x),
    "Run(x)": lambda t, x: drape.Run(x, None),
    "Run(folder=x)": lambda t, x: drape.Run({}, x),
    "params[x]": lambda t, x: t.fit.params[x],
    "Fits[x]": lambda t, x: drape.Fits({}, {})[x],
    "Fits(x)": lambda t, x: drape.Fits({}, x),
    "Fabric.read(x)": lambda t, x: drape.Fabric.read(x),
    "Fabric.from_toml(x)": lambda t, x: drape.Fabric.from_toml(x),
    "Fabric.from_values(x)": lambda t, x: drape.Fabric.from_values(x, {"W": 12.4}),
    "Fabric.from_values(values=x)": lambda t, x: drape.Fabric.from_values("own", x),
    "Fabric.from_values(W=x)": lambda t, x: drape.Fabric.from_values("own", {"W": x}),
    "export(x)": lambda t, x: t.fit.fabric.export(x, program="ppf"),
    "export(program=x)": lambda t, x: t.fit.fabric.export(t.folder / "e.toml", program=x, replace=True),
    "export(load=x)": lambda t, x: t.fit.fabric.export(t.folder / "e.toml", load=x, replace=True),
    "fit(x)": lambda t, x: drape.fit(x),
    "fit([x])": lambda t, x: drape.fit([x]),
    "fit(bending=x)": lambda t, x: drape.fit(t.sheet, bending=x),
    "fit(profile=x)": lambda t, x: drape.fit(t.sheet, profile=x),
    "fit(fabric=x)": lambda t, x: drape.fit(t.sheet, fabric=x),
    "fit_all(x)": lambda t, x: drape.fit_all(x),
    "fit_all([x])": lambda t, x: drape.fit_all([x]),
    "read_sheet(x)": lambda t, x: drape.read_sheet(x),
    "Curve(test=x)": lambda t, x: t.curve(test=x),
    "Curve(direction=x)": lambda t, x: t.curve(direction=x),
    "Curve(deformation=x)": lambda t, x: t.curve(deformation=x),
    "Curve(name=x)": lambda t, x: t.curve(name=x),
    "Curve(load_unit=x)": lambda t, x: t.curve(load_unit=x),
    "Curve(gauge=x)": lambda t, x: t.curve(gauge=x),
    "Curve(slack=x)": lambda t, x: t.curve(slack=x),
    "drapemeter(x)": lambda t, x: drape.drapemeter(x),
    "drapemeter(meter=x)": lambda t, x: drape.drapemeter(t.fit.fabric, meter=x, starts=1),
    "drapemeter(starts=x)": lambda t, x: drape.drapemeter(t.fit.fabric, starts=x, spacing=1e-9),
    "drapemeter(spacing=x)": lambda t, x: drape.drapemeter(t.fit.fabric, starts=1, spacing=x),
    "validate([x])": lambda t, x: drape.validate([x]),
    "convert(x)": lambda t, x: drape.convert(x),
    "convert(to=x)": lambda t, x: drape.convert(t.skirt, x),
    "convert(unit=x)": lambda t, x: drape.convert(t.skirt, unit=x),
    "convert(paper=x)": lambda t, x: drape.convert(t.skirt, t.folder / "a.svg", paper=x, replace=True),
    "convert(width=x)": lambda t, x: drape.convert(t.skirt, t.folder / "b.svg", width=x, replace=True),
    "SceneBuilder(x)": lambda t, x: drape.SceneBuilder(x),
    "SceneBuilder(folder=x)": lambda t, x: drape.SceneBuilder(folder=x).scene(),
    "SceneBuilder(allow=x)": lambda t, x: drape.SceneBuilder(allow=x).scene(),
    "set(spacing=x)": lambda t, x: t.builder.set(spacing=x).scene(),
    "set(time.end=x)": lambda t, x: t.builder.set(time={"step": 0.01, "end": x}).scene(),
    "set(fabric=x)": lambda t, x: t.builder.set(fabric=x).fabric("wool", t.fit).scene(),
    "set(panel=x)": lambda t, x: t.builder.set(panel=x).panel("a", "own", rectangle=[1, 1]).scene(),
    "set(collider=x)": lambda t, x: t.builder.set(collider=x).body("a", "sphere", radius=1).scene(),
    "set(collider.sphere=x)": lambda t, x: t.builder.set(collider={"sphere": x}).body("a", "sphere").scene(),
    "set(unknown=x)": lambda t, x: t.builder.set(unknown=x).to_toml(),
    "fabric(x)": lambda t, x: t.builder.fabric(x, t.fit).scene(),
    "fabric(source=x)": lambda t, x: t.builder.fabric("wool", x).scene(),
    "panel(x)": lambda t, x: t.builder.panel(x, "own", rectangle=[1, 1]).scene(),
    "panel(rectangle=x)": lambda t, x: t.builder.panel("a", "own", rectangle=x).scene(),
    "garment(x)": lambda t, x: t.builder.garment(x, "own").scene(),
    "garment(panel=x)": lambda t, x: t.builder.garment({"panel": x}, "own").scene(),
    "garment(name=x)": lambda t, x: t.builder.garment({"panel": []}, "own", name=x).scene(),
    "pin(x)": lambda t, x: t.builder.pin(x, edge="top").scene(),
    "pin(motion=x)": lambda t, x: t.builder.pin("cloth", edge="top", motion=x).scene(),
    "body(x)": lambda t, x: t.builder.body(x),
    "body(kind=x)": lambda t, x: t.builder.body("a", x),
    "body(radius=x)": lambda t, x: t.builder.body("a", "sphere", radius=x).scene(),
    "mesh(x)": lambda t, x: t.builder.mesh(x, BOX + 1, FACES).scene(),
    "mesh(vertices=x)": lambda t, x: t.builder.mesh("a", x, FACES).scene(),
    "mesh(faces=x)": lambda t, x: t.builder.mesh("a", BOX + 1, x).scene(),
    "mesh(frames=x)": lambda t, x: t.builder.mesh("a", BOX + 1, FACES, frames=x, rate=25).scene(),
    "mesh(file=x)": lambda t, x: t.builder.mesh("a", BOX + 1, FACES, file=x).scene(),
    "save(x)": lambda t, x: t.builder.save(x, replace=True),
    "save(replace=x)": lambda t, x: t.builder.save(t.folder / "s.toml", replace=x),
}


@pytest.mark.parametrize("call", CALLS)
def test_what_comes_out_is_an_error_of_the_package(call, things, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused = 0
    for name, wrong in WRONG.items():
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                CALLS[call](things, wrong)
        except drape.InternalError as error:
            pytest.fail(f"{call} with {name}: {error}")
        except drape.Error as error:
            assert str(error), name
            refused += 1
        # A panic derives from no Exception.
        except BaseException as error:
            pytest.fail(f"{call} with {name}: {type(error).__name__}: {error}")
    assert refused > 2, "the values are wrong"


@pytest.mark.parametrize("extend", [math.nan, math.inf, -math.inf, -1, 0, 1e300, "1", "", [1], True, b"1"], ids=repr)
def test_a_run_is_extended_by_a_time_alone(extend, things):
    before = things.run.times
    with pytest.raises(drape.UsageError, match="extend=.*: give a time above 0 s, to 100000 s"):
        drape.resume(things.run, extend=extend)
    assert np.array_equal(things.run.times, before)


def test_files_that_cannot_be_read_or_written_are_errors_of_output(things, tmp_path):
    (tmp_path / "file").write_text("")
    below = tmp_path / "file" / "below.toml"
    for call in (
        lambda: things.fit.fabric.export(below),
        lambda: things.builder.save(below),
        lambda: drape.View("<p>").save(below),
        lambda: drape.convert(things.skirt, below),
        lambda: things.scene.run(below),
        lambda: drape.fit_all("x" * 3000),
    ):
        with pytest.raises((drape.OutputError, drape.InputError)) as caught:
            call()
        assert isinstance(caught.value, drape.OutputError), caught.value
    own = tmp_path / "own"
    things.scene.run(own, until=0.004)
    for text in (b"{", b"[1]", b"\xff", b"[" * 100_000):
        (own / "summary.json").write_bytes(text)
        with pytest.raises(drape.OutputError, match="summary|open"):
            drape.open(own)
    (own / "summary.json").unlink()
    run = drape.open(own)
    for path in own.glob("frame-*"):
        path.write_bytes(b"")
    with pytest.raises(drape.OutputError):
        run.frames[0]


def test_what_is_not_there_is_an_error_of_python_too(things):
    for index in (10**6, -(10**6)):
        for call in (run_frames := things.run.frames).__getitem__, things.run.bodies:
            with pytest.raises(drape.NoFrameError) as caught:
                call(index)
            assert isinstance(caught.value, IndexError) and "frame" in str(caught.value)
    assert list(run_frames)[-1].shape == run_frames[-1].shape
    fits = drape.fit_all([things.sheet, things.folder / "none.toml"])
    for mapping in (things.fit.params, fits):
        with pytest.raises(drape.NoEntryError, match="give one of") as caught:
            mapping["nothing"]
        assert isinstance(caught.value, KeyError) and mapping.get("nothing") is None
    # A sheet that has no fit is no entry, and says why.
    assert "none" not in fits and "cupro-weave" in fits
    with pytest.raises(drape.InputError):
        fits["none"]


def test_arrays_of_any_memory_are_read(things):
    simulation = drape.Simulation(things.builder.scene())
    n = len(simulation.positions)
    push = np.zeros((n, 3))
    push.flags.writeable = False
    unaligned = np.frombuffer(b"\0" * (24 * n + 1), dtype=np.uint8)[1:].view(np.float64).reshape(n, 3)
    assert not unaligned.flags.aligned
    others = (np.asfortranarray(push), push[::-1], push.astype(">f8"), push.astype(np.float16), unaligned, push.tolist())
    for forces in (push, *others):
        simulation.step(forces)
    still = drape.Simulation(things.builder.scene())
    for _ in range(len(others) + 1):
        still.step(push)
    assert still.state_hash() == simulation.state_hash()


def test_a_simulation_in_two_threads_is_refused_in_one(things):
    simulation = drape.Simulation(things.scene)
    said, ended = [], threading.Event()

    def steps():
        while not ended.is_set():
            try:
                simulation.step()
            except drape.UsageError as error:
                said.append(str(error))

    thread = threading.Thread(target=steps)
    thread.start()
    while not said:
        try:
            assert np.isfinite(simulation.time) and simulation.summary() and len(simulation.bodies) == 0
            simulation.step()
        except drape.UsageError as error:
            said.append(str(error))
    ended.set()
    thread.join()
    assert all("one thread uses it at a time" in text for text in said)
    assert simulation.step().time > 0


def test_what_a_callback_raises_comes_out_as_it_is(things):
    class Own(BaseException):
        pass

    for callback in ("progress", "on_frame"):
        for kind in (Own, ValueError, OSError):

            def fail(told, kind=kind):
                raise kind("enough")

            with pytest.raises(kind, match="enough"):
                things.short(**{callback: fail})


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() == 0, reason="root may read all files")
def test_a_folder_that_may_not_be_read_is_named(things, tmp_path):
    (tmp_path / "closed").mkdir(mode=0)
    with pytest.raises(drape.OutputError, match="closed"):
        drape.fit_all(tmp_path / "closed")
