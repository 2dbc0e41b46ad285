"""Runs: their summaries, and their frames where they were stored."""

from __future__ import annotations

import json
import operator
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from . import _drape
from ._errors import NoFrameError, OutputError, UsageError
from ._fit import frame
from ._given import StrPath, expect, files, number_of, path_of, refuse, shown, text_of

Array = npt.NDArray[np.float64]


class Frames(Sequence[Array]):
    """Frames of a run, each read when it is asked for: positions, (n, 3), in m; read-only.

    Raises `NoFrameError`, an `IndexError` too, for a frame that there is not, and `OutputError` for
    one that cannot be read.
    """

    def __init__(self, recording: _drape.Recording) -> None:
        advice = ("drape.open({}).frames are those of a folder", "drape.open(folder).frames has them")
        expect("Frames", _drape.Recording, recording, advice)
        self._recording = recording

    def __len__(self) -> int:
        return self._recording.frames

    @overload
    def __getitem__(self, index: int) -> Array: ...

    @overload
    def __getitem__(self, index: slice) -> list[Array]: ...

    def __getitem__(self, index: int | slice) -> Array | list[Array]:
        if isinstance(index, slice):
            try:
                numbers = range(*index.indices(len(self)))
            except (TypeError, ValueError) as error:
                raise refuse("Frames", "a part", index, str(error)) from None
            return [self._recording.frame(number) for number in numbers]
        return self._recording.frame(_number(index, len(self)))

    def __iter__(self) -> Iterator[Array]:
        return (self[index] for index in range(len(self)))


def _number(index: int, count: int) -> int:
    """Returns the number of a frame, from 0, of so many; those below 0 count from the last."""
    try:
        number = operator.index(index)
    except TypeError:
        raise refuse("a run", "the number of a frame", index, "give a whole number") from None
    if not -count <= number < count:
        raise NoFrameError(f"frame {shown(number)} of {count}")
    return number % count


class Run:
    """Run of a scene: its summary, and its frames where it has a folder.

    All that it reads raises `OutputError` where the files of the folder cannot be read, and
    `UsageError` where it has none.
    """

    def __init__(self, summary: dict[str, Any], folder: Path | None) -> None:
        advice = ("drape.open({}) opens a stored run", "Scene.run makes one, drape.open(folder) opens one")
        expect("Run", dict, summary, advice)
        self.summary = summary
        """Summary, as in `summary.json`; empty while another process runs the scene."""
        self.folder = None if folder is None else path_of("Run", folder)
        """Folder of the results, if they were stored."""

    @cached_property
    def _recording(self) -> _drape.Recording:
        if self.folder is None:
            raise UsageError("the run stored no frames; give it a folder: scene.run(output=...)")
        return _drape.Recording(self.folder)

    @property
    def status(self) -> str:
        """How the run ended: `"ok"`, `"interrupted"`, `"did not settle"` and others."""
        return str(self.summary.get("status", "running"))

    @property
    def frames(self) -> Frames:
        """Frames, read one by one."""
        return Frames(self._recording)

    @property
    def times(self) -> Array:
        """Times of the frames, (frames,), in s."""
        return self._recording.times()

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """Corners of the triangles of the cloth, (m, 3)."""
        return self._recording.triangles()

    @property
    def coordinates(self) -> Array:
        """Material coordinates of the particles, weft and warp, (n, 2), in m."""
        return self._recording.coordinates()

    @property
    def panels(self) -> dict[str, range]:
        """Particles of each panel, by its name."""
        return {name: range(start, end) for name, start, end in self._recording.panels()}

    def bodies(self, index: int) -> Array:
        """Returns the vertices of all bodies in a frame, (k, 3), in m. Raises `NoFrameError`."""
        return self._recording.bodies(_number(index, len(self.frames)))

    def check(self) -> list[dict[str, Any]]:
        """Verifies every frame with code of its own: intersections, distances, bodies.

        Returns a verdict for each frame; `holds` says whether it keeps all that is promised.
        """
        verdicts: list[dict[str, Any]] = json.loads(self._recording.check())
        return verdicts

    def __reduce__(self) -> Any:
        """Pickles the summary and the folder, without what was read of it."""
        return Run, (self.summary, self.folder)

    def __repr__(self) -> str:
        return f"<drape.Run {str(self.folder) if self.folder else 'without a folder'}: {self.status}>"


class View:
    """Runs as a page that turns, plays and measures them; a notebook shows it."""

    def __init__(self, html: str) -> None:
        if not isinstance(html, str) or "<" not in html:
            raise refuse("View", "a page", html, "drape.view(run) makes one of runs or their folders")
        self.html = text_of("View", html)
        """The page, which needs nothing else."""

    def save(self, path: StrPath) -> None:
        """Writes the page. Raises `OutputError`."""
        path = path_of("View.save", path)
        with files("View.save"):
            path.write_text(self.html, encoding="utf-8")

    def _repr_html_(self) -> str:
        return frame(self.html, 640)


def open(folder: StrPath) -> Run:
    """Opens a stored run, of this package or of `drape run`. Raises `OutputError`."""
    folder = path_of("open", folder)
    path = folder / "summary.json"
    try:
        with files("open"):
            summary = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    except (ValueError, RecursionError) as error:
        raise OutputError(f"{path} is no JSON: {error}") from None
    if not isinstance(summary, dict):
        raise OutputError(f"{path} is no summary; run the scene anew with replace=True")
    run = Run(summary, folder)
    run._recording  # noqa: B018 - opens the folder, and fails where it holds no run
    return run


def view(*runs: Run | StrPath, megabytes: float | None = None) -> View:
    """Returns runs side by side as a page, of at most so many megabytes (20).

    Raises `UsageError`, and `OutputError` for runs that cannot be read.
    """
    if megabytes is not None:
        megabytes = number_of("megabytes", megabytes, "a number above 0, to 1e4", 0, 1e4, above=True)
    folders = [run.folder if isinstance(run, Run) else path_of("view", run) for run in runs]
    if not folders or None in folders:
        raise UsageError("view() shows stored runs; give them a folder: scene.run(output=...)")
    return View(_drape.view_html([f for f in folders if f is not None], megabytes))
