"""Scenes, their runs, and simulations step by step."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _drape
from ._errors import UsageError
from ._given import (
    LATEST,
    StrPath,
    array_of,
    expect,
    flag_of,
    number_of,
    path_of,
    paths_of,
    refuse,
    text_of,
    threads_of,
)
from ._run import Run

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Progress:
    """Progress of a run after a step."""

    time: float
    """Time reached, in s."""
    done: float
    """Part of the run that is done: it never falls, and is 1 after the last step."""
    phase: str
    """`"sew"`, `"relax"` or `"simulate"`."""
    speed_max: float
    """Largest speed of a particle, in m/s."""
    iterations: int
    """Iterations of the solver in the step."""


@dataclass(frozen=True)
class Frame:
    """Frame of a run."""

    number: int
    time: float
    """Time, in s."""
    positions: Array
    """Positions of the particles, (n, 3), in m; read-only."""


@dataclass(frozen=True)
class Step:
    """Step of a simulation."""

    time: float
    """Time reached, in s."""
    dt: float
    """Length of the step, in s."""
    speed_max: float
    """Largest speed of a particle, in m/s."""
    imbalance: float
    """Root-mean-square acceleration of the free particles, over g."""
    iterations: int
    """Iterations of the solver."""
    finished: bool
    """Whether the simulation is over."""
    phase: str
    """`"sew"`, `"relax"` or `"simulate"`."""
    events: list[str]
    """Warnings about what happened in the step."""


# Words of numbers that are refused.
_DURATION = f"a time above 0 s, to {LATEST:g} s"


class Scene:
    """Scene that was read and checked; `SceneBuilder` makes one without a file.

    It can be pickled: with its text or its keys and with what a builder gave it, but without the
    files that it names, which are read again from where they were.
    """

    def __init__(self, inner: _drape.Scene) -> None:
        advice = (
            "drape.Scene.read({}) reads a file, drape.Scene.from_toml(text) a text",
            "drape.Scene.read(path) reads one, drape.SceneBuilder(...).scene() makes one",
        )
        expect("Scene", _drape.Scene, inner, advice)
        self._inner = inner

    @staticmethod
    def read(path: StrPath, *, allow: Iterable[StrPath] = ()) -> Scene:
        """Reads a scene and all that it names; sheets are fitted.

        `allow` are files or folders that the scene may name beside those in its own folder and in
        the working folder. Raises `InputError` with all mistakes.
        """
        allowed = paths_of("Scene.read(allow=)", allow)
        return Scene(_drape.Scene.read(path_of("Scene.read", path), allowed))

    @staticmethod
    def from_toml(text: str, folder: StrPath = ".", *, allow: Iterable[StrPath] = ()) -> Scene:
        """Makes a scene of a text; its relative paths are seen from a folder. Raises `InputError`."""
        if not isinstance(text, str):
            raise refuse("Scene.from_toml", "a text", text, "drape.Scene.read(path) reads a file")
        text = text_of("Scene.from_toml", text)
        allowed = paths_of("Scene.from_toml(allow=)", allow)
        path = path_of("Scene.from_toml(folder=)", folder) / "<text>"
        place = {"path": path, "allow": allowed, "has_file": False}
        return Scene(_drape.Scene.from_toml(text, place))

    @property
    def name(self) -> str:
        """Name."""
        return self._inner.name

    @property
    def particles(self) -> int:
        """Number of particles of the cloth."""
        return self._inner.particles

    @property
    def panels(self) -> dict[str, range]:
        """Particles of each panel, by its name."""
        return {name: range(start, end) for name, start, end in self._inner.panels()}

    @property
    def notes(self) -> list[str]:
        """Notes on patterns, bodies, layers and costs."""
        return self._inner.notes()

    def to_toml(self) -> str:
        """Returns the text of the scene."""
        return self._inner.to_toml()

    def run(
        self,
        output: StrPath | None = None,
        progress: Callable[[Progress], object] | None = None,
        on_frame: Callable[[Frame], object] | None = None,
        until: float | None = None,
        threads: int | None = None,
        *,
        replace: bool = False,
        checkpoint_every: float = 60.0,
        state_hash: bool = False,
        max_wall: float | None = None,
    ) -> Run:
        """Runs the scene to its end, to rest, or `until` a time in s.

        With a folder as `output` it writes frames, summary and checkpoints as `drape run` does,
        and Ctrl-C leaves a checkpoint, from which `drape.resume` goes on. Other threads of Python run
        meanwhile; `progress` is called after each step and `on_frame` with each frame, on the thread
        that called this. `replace` lets it replace earlier results; `checkpoint_every` is in s;
        `state_hash` hashes the state after each step; `max_wall` ends the run after so many seconds.

        A run that ends badly has a summary that says so. Raises `UsageError`, `SolverError`,
        `OutputError`, `InputError` where files that the scene names have changed, and what a
        callback raises.
        """
        folder = None if output is None else path_of("Scene.run(output=)", output)
        settings = _settings(threads, max_wall, progress, on_frame)
        settings |= {"output": folder, "replace": flag_of("replace", replace)}
        settings["state_hash"] = flag_of("state_hash", state_hash)
        seconds = "a time from 0 to 1e9 s"
        settings["checkpoint_every"] = number_of("checkpoint_every", checkpoint_every, seconds, 0, 1e9)
        if until is not None:
            settings["until"] = number_of("until", until, _DURATION, 0, LATEST, above=True)
        return Run(json.loads(self._inner.run(settings)), folder)

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        """Returns the scene itself, which nothing changes."""
        return self

    def __repr__(self) -> str:
        return f"<drape.Scene {self.name!r}: {self.particles} particles>"


def resume(
    run: Run | StrPath,
    *,
    scene: Scene | None = None,
    extend: float | None = None,
    progress: Callable[[Progress], object] | None = None,
    on_frame: Callable[[Frame], object] | None = None,
    threads: int | None = None,
    max_wall: float | None = None,
) -> Run:
    """Goes on with a run that was interrupted, from its last checkpoint, to the results that it would
    have had; or with one that has ended, for `extend` seconds beyond its end. `run` is its folder.

    A run goes on where it was begun: the command cannot go on with a run of this package, nor this
    package with one of the command. `scene` is needed for a run of `Scene.from_toml`. Raises as
    `Scene.run`, `UsageError` for an `extend` that is no time above 0, to 1e5 s, and `InputError` for
    a scene that has changed.
    """
    if isinstance(run, Run):
        if run.folder is None:
            raise UsageError("the run stored nothing; give it a folder: scene.run(output=...)")
        run = run.folder
    folder = path_of("resume", run)
    settings = _settings(threads, max_wall, progress, on_frame)
    if extend is not None:
        settings["extend"] = number_of("extend", extend, _DURATION, 0, LATEST, above=True)
    if scene is not None:
        advice = ("read it first, drape.Scene.read({})", "drape.Scene.read(path) reads one")
        expect("resume(scene=)", Scene, scene, advice)
    inner = None if scene is None else scene._inner
    return Run(json.loads(_drape.resume(folder, inner, settings)), folder)


def _triple(key: str, value: npt.ArrayLike | None) -> list[float]:
    numbers = np.zeros(3) if value is None else array_of(f"move_body({key}=)", value)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise UsageError(f"{key} of shape {numbers.shape}: give 3 finite numbers")
    return [float(number) for number in numbers]


def _settings(
    threads: int | None,
    max_wall: float | None,
    progress: Callable[[Progress], object] | None,
    on_frame: Callable[[Frame], object] | None,
) -> dict[str, Any]:
    for name, callback in (("progress", progress), ("on_frame", on_frame)):
        if callback is not None and not callable(callback):
            raise refuse(f"{name}=", "a function", callback, "give one of one argument")
    if max_wall is not None:
        max_wall = number_of("max_wall", max_wall, "a time above 0 s, to 1e9 s", 0, 1e9, above=True)
    return {
        "output": None,
        "until": None,
        "threads": threads_of(threads),
        "replace": True,
        "checkpoint_every": 60.0,
        "state_hash": False,
        "max_wall": max_wall,
        "extend": None,
        "program": Path(_drape.__file__),
        "progress": None if progress is None else lambda *fields: progress(Progress(*fields)),
        "on_frame": None if on_frame is None else lambda *fields: on_frame(Frame(*fields)),
    }


class Simulation:
    """Simulation of a scene, step by step.

    Positions and velocities are copies, made once after each step when they are asked for: a step
    writes to its own memory without the lock of the interpreter, and a view of that could be read
    while it changes. An array that was given out never changes, and is read-only.

    One thread uses a simulation at a time; another one gets a `UsageError`. In a child of a fork it
    goes on from where it was, apart from the parent's. A simulation cannot be pickled: its scene can.
    """

    def __init__(self, scene: Scene, *, threads: int | None = None) -> None:
        """Prepares a scene at its start, for so many threads (all of the machine)."""
        advice = (
            "read it first, drape.Simulation(drape.Scene.read({}))",
            "drape.Scene.read(path) reads one, drape.SceneBuilder(...).scene() makes one",
        )
        expect("Simulation", Scene, scene, advice)
        self._inner = _drape.Simulation(scene._inner, threads_of(threads))
        self.panels: dict[str, range] = scene.panels
        """Particles of each panel, by its name."""
        self.triangles: npt.NDArray[np.uint32] = self._inner.triangles()
        """Corners of the triangles of the cloth, (m, 3)."""
        self.coordinates: Array = self._inner.coordinates()
        """Material coordinates of the particles, weft and warp, (n, 2), in m."""
        self._positions: Array | None = None
        self._velocities: Array | None = None
        self._pushed = False

    def step(self, forces: npt.ArrayLike | None = None) -> Step:
        """Advances by one step, during which other threads of Python run.

        `forces`, (n, 3), in N, act on the particles during this step, constant and beside those of
        the scene; their work is part of `work_in` in `energy()`. Ctrl-C ends the step: the
        simulation is then at its end, or at its start. Raises `SolverError` for a step that cannot
        be solved, the state is then the last good one, and `UsageError` for forces of another
        shape or without an end.
        """
        if forces is not None or self._pushed:
            pushed = np.zeros((0, 3)) if forces is None else array_of("step(forces=)", forces)
            n = len(self.coordinates)
            if forces is not None and pushed.shape != (n, 3):
                raise UsageError(f"forces of shape {pushed.shape}: give ({n}, 3), in N")
            self._inner.apply_forces(pushed.ravel())
            self._pushed = forces is not None
        self._positions = self._velocities = None
        return Step(**self._inner.step())

    @property
    def next_step(self) -> float:
        """Length of the next step, in s, unless `time.error` makes it shorter."""
        return float(self._inner.next_step())

    @property
    def bodies(self) -> dict[str, tuple[Array, npt.NDArray[np.uint32]]]:
        """Vertices, (k, 3), in m, and triangles, (m, 3), of the bodies now, by their names."""
        return {name: (vertices, triangles) for name, vertices, triangles in self._inner.bodies()}

    def move_body(
        self,
        name: str,
        vertices: npt.ArrayLike | None = None,
        *,
        shift: npt.ArrayLike | None = None,
        turn: npt.ArrayLike | None = None,
        center: npt.ArrayLike | None = None,
        seconds: float | None = None,
    ) -> None:
        """Moves a body from where it is, at a steady rate, within `seconds` or the next step.

        Either to `vertices`, (k, 3), in m, as many as it has in `bodies` and in their order, or by a
        `shift`, (3,), in m, with a `turn`, (3,), in degrees about x, then y, then z, about `center`
        (the middle of its extent). It takes the place of the motion that the scene gives the body.
        Surfaces stay apart and the energy is accounted for as with a motion of the scene. Raises
        `UsageError` for a body that there is not, another shape, and a speed at which contact does
        not keep the fabrics apart.
        """
        name = text_of("move_body", name)
        if (vertices is None) == (shift is None and turn is None):
            raise UsageError("move_body: give either vertices, or shift and turn")
        target = None
        if vertices is not None:
            target = array_of("move_body(vertices=)", vertices)
            if target.ndim != 2 or target.shape[1] != 3:
                raise UsageError(f"vertices of shape {target.shape}: give (k, 3), in m")
            if not np.isfinite(target).all():
                raise UsageError("vertices that are not finite: give (k, 3), in m")
        within = self.next_step
        if seconds is not None:
            within = number_of("seconds", seconds, _DURATION, 0, LATEST, above=True)
        motion = {
            "shift": _triple("shift", shift),
            "turn": _triple("turn", turn),
            "center": None if center is None else _triple("center", center),
            "seconds": within,
        }
        self._inner.lead_body(name, None if target is None else target.ravel(), motion)

    @property
    def time(self) -> float:
        """Time so far, in s."""
        return self._inner.time

    @property
    def positions(self) -> Array:
        """Positions of the particles, (n, 3), in m; read-only."""
        if self._positions is None:
            self._positions = self._inner.positions()
        return self._positions

    @property
    def velocities(self) -> Array:
        """Velocities of the particles, (n, 3), in m/s; read-only."""
        if self._velocities is None:
            self._velocities = self._inner.velocities()
        return self._velocities

    def summary(self) -> dict[str, Any]:
        """Returns the summary so far, as in `summary.json`: status, energy, strain, contact."""
        summary: dict[str, Any] = json.loads(self._inner.summary())
        return summary

    def energy(self) -> dict[str, float] | None:
        """Returns the balance of the energy since the start, in J, unless the scene does without."""
        energy: dict[str, float] | None = self.summary().get("energy")
        return energy

    def pin_loads(self) -> tuple[Array, Array]:
        """Returns forces in N and moments in N·m of the cloth on the pins, (pins, 3) each."""
        loads = self._inner.pin_loads()
        forces = np.array([force for force, _ in loads], dtype=np.float64).reshape(-1, 3)
        moments = np.array([moment for _, moment in loads], dtype=np.float64).reshape(-1, 3)
        return forces, moments

    def state_hash(self) -> str:
        """Returns the hash of positions, velocities and memories to the last bit."""
        return self._inner.state_hash()

    def __reduce__(self) -> Any:
        raise UsageError("a simulation cannot be pickled or copied; pickle its scene, and simulate it there")
