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
from ._fit import StrPath
from ._run import Run

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Progress:
    """Progress of a run after a step."""

    time: float
    """Time reached, in s."""
    done: float
    """Part of the phase that is done, 0 to 1."""
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


class Scene:
    """Scene that was read and checked."""

    def __init__(self, inner: _drape.Scene) -> None:
        self._inner = inner

    @staticmethod
    def read(path: StrPath, *, allow: Iterable[StrPath] = ()) -> Scene:
        """Reads a scene and all that it names; sheets are fitted.

        `allow` are files or folders that the scene may name beside those in its own folder and in
        the working folder. Raises `InputError` with all mistakes.
        """
        return Scene(_drape.Scene.read(Path(path), [Path(p) for p in allow]))

    @staticmethod
    def from_toml(text: str, folder: StrPath = ".", *, allow: Iterable[StrPath] = ()) -> Scene:
        """Makes a scene of a text; its relative paths are seen from a folder. Raises `InputError`."""
        return Scene(_drape.Scene.from_toml(text, Path(folder), [Path(p) for p in allow]))

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

        A run that ends badly has a summary that says so. Raises `UsageError`, `SolverError` and
        `OutputError`.
        """
        settings = _settings(output, until, threads, replace)
        settings |= {"checkpoint_every": checkpoint_every, "state_hash": state_hash}
        settings |= {"max_wall": max_wall} | _callbacks(progress, on_frame)
        summary = json.loads(self._inner.run(settings))
        return Run(summary, None if output is None else Path(output))

    def __repr__(self) -> str:
        return f"<drape.Scene {self.name!r}: {self.particles} particles>"


def resume(
    run: StrPath,
    *,
    scene: Scene | None = None,
    extend: float | None = None,
    progress: Callable[[Progress], object] | None = None,
    on_frame: Callable[[Frame], object] | None = None,
    threads: int | None = None,
    max_wall: float | None = None,
) -> Run:
    """Goes on with a run that was interrupted, from its last checkpoint, to the results that it would
    have had; or with one that has ended, for `extend` seconds beyond its end.

    A run goes on where it was begun: the command cannot go on with a run of this package, nor this
    package with one of the command. `scene` is needed for one that was a text. Raises as
    `Scene.run`, and `InputError` for a scene that has changed.
    """
    settings = _settings(None, None, threads, True)
    settings |= {"extend": extend, "max_wall": max_wall} | _callbacks(progress, on_frame)
    inner = None if scene is None else scene._inner
    return Run(json.loads(_drape.resume(Path(run), inner, settings)), Path(run))


def _settings(
    output: StrPath | None, until: float | None, threads: int | None, replace: bool
) -> dict[str, Any]:
    return {
        "output": None if output is None else Path(output),
        "until": until,
        "threads": threads,
        "replace": replace,
        "checkpoint_every": 60.0,
        "state_hash": False,
        "max_wall": None,
        "extend": None,
        "program": Path(_drape.__file__),
        "progress": None,
        "on_frame": None,
    }


def _callbacks(
    progress: Callable[[Progress], object] | None, on_frame: Callable[[Frame], object] | None
) -> dict[str, Any]:
    return {
        "progress": progress and (lambda *fields: progress(Progress(*fields))),
        "on_frame": on_frame and (lambda *fields: on_frame(Frame(*fields))),
    }


class Simulation:
    """Simulation of a scene, step by step.

    Positions and velocities are copies, made once after each step when they are asked for: a step
    writes to its own memory without the lock of the interpreter, and a view of that could be read
    while it changes. An array that was given out never changes.
    """

    def __init__(self, scene: Scene, *, threads: int | None = None) -> None:
        """Prepares a scene at its start, for so many threads (all of the machine)."""
        self._inner = _drape.Simulation(scene._inner, threads)
        self.panels: dict[str, range] = scene.panels
        """Particles of each panel, by its name."""
        self.triangles: npt.NDArray[np.uint32] = self._inner.triangles()
        """Corners of the triangles of the cloth, (m, 3)."""
        self.coordinates: Array = self._inner.coordinates()
        """Material coordinates of the particles, weft and warp, (n, 2), in m."""
        self._positions: Array | None = None
        self._velocities: Array | None = None

    def step(self) -> Step:
        """Advances by one step, during which other threads of Python run.

        Ctrl-C ends it: the simulation is then at the end of the step, or at its start. Raises
        `SolverError` for a step that cannot be solved; the state is then the last good one.
        """
        self._positions = self._velocities = None
        return Step(*self._inner.step())

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
