"""Scenes built in Python, key by key."""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _drape
from ._errors import UsageError
from ._fit import Fabric, Fit
from ._given import StrPath, path_of, refuse
from ._scene import Scene
from ._toml import dumps, plain

# Kinds of bodies.
_KINDS = ("sphere", "box", "cylinder", "plane", "mesh")


class SceneBuilder:
    """Scene that is built key by key. No text is written before `save`.

    Keywords are keys of the reference of scenes, whatever they are, and their values are numbers,
    texts, lists, dictionaries and NumPy arrays; a key with the value None is left out. Nothing is
    checked until `scene()`, which checks it as `Scene.read` does.
    """

    def __init__(
        self, *others: object, folder: StrPath = ".", allow: Iterable[StrPath] = (), **keys: Any
    ) -> None:
        """Begins a scene with its own keys, such as `spacing=0.01, time={"step": 0.002, "end": 1}`.

        Files that it names are seen from `folder`; `allow` are files or folders elsewhere that it
        may name. Raises `UsageError` for arguments without a keyword.
        """
        if others:
            advice = "name={} names the scene; drape.Scene.read(path) reads a file"
            raise refuse("SceneBuilder", "keys of a scene", others[0], advice)
        self._folder = path_of("SceneBuilder(folder=)", folder)
        self._allow = [Path(path) for path in allow]
        self._table: dict[str, Any] = plain(keys, "")
        self._held: dict[str, Any] = {}

    def set(self, **keys: Any) -> SceneBuilder:
        """Sets keys of the scene itself, in place of those that it has."""
        self._table |= plain(keys, "")
        return self

    def fabric(self, name: str, source: Fabric | Fit | StrPath) -> SceneBuilder:
        """Adds a fabric: one that was made, a fit, or a `fabric.toml`, a sheet or its folder."""
        if isinstance(source, Fit):
            source = source.fabric
        if isinstance(source, Fabric):
            file = self._hold("fabrics", name, ".toml", source._inner)
        elif isinstance(source, str | os.PathLike):
            file = Path(source).as_posix()
        else:
            advice = "drape.fit(sheet) fits a sheet, drape.Fabric.read(path) reads a fabric"
            raise refuse("SceneBuilder.fabric", "a Fabric, a Fit or a path", source, advice)
        self._table.setdefault("fabric", {})[name] = {"file": file}
        return self

    def panel(self, name: str, fabric: str, **keys: Any) -> SceneBuilder:
        """Adds a panel by its name and its fabric, such as `rectangle=[0.2, 0.3], center=[0, 1, 0]`."""
        return self._add("panel", {"name": name, "fabric": fabric} | keys)

    def garment(
        self, pattern: StrPath | Mapping[str, Any], fabric: str, **keys: Any
    ) -> SceneBuilder:
        """Adds a garment: the file of a pattern, or the keys of one, and the fabric of its panels."""
        if isinstance(pattern, Mapping):
            held = plain(pattern, "")
            file = self._hold("patterns", str(keys.get("name", "pattern")), ".toml", held)
        else:
            file = Path(pattern).as_posix()
        return self._add("garment", {"pattern": file, "fabric": fabric} | keys)

    def pin(self, panel: str, **keys: Any) -> SceneBuilder:
        """Adds a pin by the name of its panel, such as `edge="top"`, with a `motion` if it moves."""
        return self._add("pin", {"panel": panel} | keys)

    def body(self, name: str | None = None, /, kind: str | None = None, **keys: Any) -> SceneBuilder:
        """Adds a body by its name and its kind, such as `"ball", "sphere", radius=0.1`.

        The kind is `"sphere"`, `"box"`, `"cylinder"`, `"plane"`, or `"mesh"` of a file. As in `panel`
        and `pin` the name comes first. The order of before, `"sphere", name="ball"`, works with a
        warning. Raises `UsageError` for a body without a kind.
        """
        if kind is None and name in _KINDS:
            shown = repr(keys.get("name", "floor" if name == "plane" else "ball"))
            note = f"the name of a body comes first now: body({shown}, {name!r}, ...)"
            warnings.warn(note, FutureWarning, stacklevel=2)
            name, kind = keys.pop("name", None), name
        if kind is None or (name in _KINDS and kind not in _KINDS):
            shown = "'ball'" if name is None or name in _KINDS else repr(name)
            kinds = ", ".join(repr(known) for known in _KINDS)
            raise UsageError(f"a body has a name and a kind: body({shown}, 'sphere', ...); kinds are {kinds}")
        if name is not None:
            keys = {"name": name} | keys
        colliders = self._table.setdefault("collider", {})
        place = f"collider.{kind}[{len(colliders.get(kind, []))}]"
        colliders.setdefault(kind, []).append(plain(keys, place))
        return self

    def mesh(
        self,
        name: str,
        vertices: Any,
        faces: npt.ArrayLike | None = None,
        *,
        frames: npt.ArrayLike | None = None,
        **keys: Any,
    ) -> SceneBuilder:
        """Adds a body with a closed surface: `vertices`, (k, 3), in m, and `faces`, (m, 3).

        In place of both, a mesh of trimesh or anything else with `vertices` and `faces`. The numbers
        of vertices begin at 0. `frames`, (f, k, 3), in m, are its vertices from frame to frame, of
        which `rate=` says how many a second has. Raises `UsageError` for other shapes.
        """
        if faces is None:
            if not (hasattr(vertices, "vertices") and hasattr(vertices, "faces")):
                raise UsageError(f"the body {name!r} has no faces; give (m, 3), or a mesh of trimesh")
            vertices, faces = vertices.vertices, vertices.faces
        places = np.asarray(vertices, dtype=np.float64)
        corners = np.asarray(faces)
        if places.ndim != 2 or places.shape[1] != 3:
            raise UsageError(f"{name!r} has vertices of shape {places.shape}; give (k, 3), in m")
        if corners.ndim != 2 or corners.shape[1] != 3 or not np.issubdtype(corners.dtype, np.integer):
            shape = f"of shape {corners.shape} and type {corners.dtype}"
            raise UsageError(f"{name!r} has faces {shape}; give (m, 3) numbers of vertices, from 0")
        mesh = _drape.Mesh(_rows(places, np.float64), _rows(corners, np.int64))
        own: dict[str, Any] = {"file": self._hold("bodies", name, ".obj", mesh)}
        if frames is not None:
            moving = np.asarray(frames, dtype=np.float64)
            if moving.ndim != 3 or moving.shape[1:] != places.shape:
                wanted = f"(f, {len(places)}, 3)"
                raise UsageError(f"{name!r} has frames of shape {moving.shape}; give {wanted}, in m")
            stem = own["file"].removesuffix(".obj")
            own["frames"] = f"{stem}_*.obj"
            held = _drape.MeshFrames(_rows(moving, np.float64), len(places))
            self._held[own["frames"]] = (mesh, held)
        if self._table.get("length", "m") != "m":
            own["scale"] = 1
        return self.body(name, "mesh", **(own | keys))

    def to_toml(self) -> str:
        """Returns the text of the scene."""
        return dumps(self._table)

    def scene(self) -> Scene:
        """Checks the scene. Raises `InputError` with all mistakes, each with its key."""
        held = {
            file: value[1] if isinstance(value, tuple) else value
            for file, value in self._held.items()
        }
        keys = {"table": self._table, "held": held, "folder": self._folder, "allow": self._allow}
        return Scene(_drape.Scene.from_keys(keys))

    def save(self, path: StrPath, *, replace: bool = False) -> None:
        """Writes the scene for the command, and its fabrics, patterns and bodies beside it.

        Files that it names besides stay where they are: they are seen from the folder of `path`.
        Raises `UsageError` where files are there already, unless it may `replace` them.
        """
        path = Path(path)
        texts = {path: self.to_toml()}
        for name, value in self._held.items():
            texts |= {path.parent / file: text for file, text in _texts(name, value)}
        there = [str(file) for file in texts if file.exists()]
        if there and not replace:
            raise UsageError(f"{', '.join(there)} exists; save elsewhere, or with replace=True")
        for file, text in texts.items():
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8", newline="\n")

    def _add(self, kind: str, keys: Mapping[str, Any]) -> SceneBuilder:
        entries = self._table.setdefault(kind, [])
        entries.append(plain(keys, f"{kind}[{len(entries)}]"))
        return self

    def _hold(self, folder: str, name: str, ending: str, value: object) -> str:
        stem = re.sub(r"[^\w-]+", "-", name) or "unnamed"
        file, number = f"{folder}/{stem}{ending}", 2
        while file in self._held:
            file, number = f"{folder}/{stem}-{number}{ending}", number + 1
        self._held[file] = value
        return file

    def __repr__(self) -> str:
        return f"<drape.SceneBuilder {self._table.get('name', 'unnamed')!r}>"


def _rows(array: npt.NDArray[Any], dtype: type[Any]) -> npt.NDArray[Any]:
    """Returns an array whose rows lie one after the other in memory; the same one if they do."""
    return np.ascontiguousarray(array, dtype=dtype)


def _texts(file: str, value: Any) -> Iterator[tuple[str, str]]:
    """Returns the names and the texts of the files of a value that a scene holds."""
    if isinstance(value, tuple):
        mesh, frames = value
        for number in range(len(frames)):
            yield file.replace("*", str(number)), mesh.frame_to_obj(frames, number)
    elif isinstance(value, _drape.Mesh):
        yield file, value.to_obj()
    elif isinstance(value, Mapping):
        yield file, dumps(value)
    else:
        yield file, value.to_toml()
