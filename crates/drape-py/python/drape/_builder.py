"""Scenes built in Python, key by key."""

from __future__ import annotations

import copy
import os
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _drape
from ._errors import UsageError
from ._fit import Fabric, Fit
from ._given import StrPath, array_of, files, flag_of, path_of, paths_of, refuse, shown, text_of
from ._scene import Scene
from ._toml import dumps, plain

# Kinds of bodies.
_KINDS = ("sphere", "box", "cylinder", "plane", "mesh")

# Keys whose values are names of files.
_FILES = ("file", "pattern", "frames", "motion")


class HeldName(str):
    """Name of a file that the scene holds; a name of a file of the disk is a `str`."""


class Held(NamedTuple):
    """What a scene holds in place of a file, or of files from frame to frame."""

    owner: str
    """What it belongs to, as `"the body 'ball'"`."""
    value: Any
    mesh: _drape.Mesh | None = None
    """Mesh whose frames it is."""


class SceneBuilder:
    """Scene that is built key by key. No text is written before `save`.

    Keywords are keys of the reference of scenes, whatever they are, and their values are numbers,
    texts, lists, dictionaries and NumPy arrays; a key with the value None is left out. Nothing is
    checked until `scene()`, which checks it as `Scene.read` does. Raises `UsageError` for values
    that TOML lacks, and for two parts whose files would have one name.
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
        self._allow = paths_of("SceneBuilder(allow=)", allow)
        self._table: dict[str, Any] = plain(keys, "")
        self._held: dict[str, Held] = {}

    def set(self, **keys: Any) -> SceneBuilder:
        """Sets keys of the scene itself, in place of those that it has."""
        self._table |= plain(keys, "")
        return self

    def fabric(self, name: str, source: Fabric | Fit | StrPath) -> SceneBuilder:
        """Adds a fabric: one that was made, a fit, or a `fabric.toml`, a sheet or its folder.

        Raises `UsageError` for a second fabric of one name.
        """
        name = text_of("SceneBuilder.fabric", name)
        fabrics = self._part("fabric", dict)
        if name in fabrics:
            raise UsageError(f"there is a fabric {name!r} already, {shown(fabrics[name])}; give another name")
        if isinstance(source, Fit):
            source = source.fabric
        if isinstance(source, Fabric):
            file: str = self._hold("fabrics", name, ".toml", Held(f"the fabric {name!r}", source._inner))
        elif isinstance(source, str | os.PathLike):
            file = path_of("SceneBuilder.fabric", source).as_posix()
        else:
            advice = "drape.fit(sheet) fits a sheet, drape.Fabric.read(path) reads a fabric"
            raise refuse("SceneBuilder.fabric", "a Fabric, a Fit or a path", source, advice)
        fabrics[name] = plain({"file": file}, f"fabric.{name}")
        return self

    def panel(self, name: str, fabric: str, **keys: Any) -> SceneBuilder:
        """Adds a panel by its name and its fabric, such as `rectangle=[0.2, 0.3], center=[0, 1, 0]`."""
        return self._add("panel", {"name": name, "fabric": fabric} | keys)

    def garment(
        self, pattern: StrPath | Mapping[str, Any], fabric: str, **keys: Any
    ) -> SceneBuilder:
        """Adds a garment: the file of a pattern, or the keys of one, and the fabric of its panels."""
        if isinstance(pattern, Mapping):
            name = keys.get("name")
            name = name if isinstance(name, str) else "pattern"
            held = Held(f"the garment {name!r}", plain(pattern, ""))
            file: str = self._hold("patterns", name, ".toml", held)
        else:
            file = path_of("SceneBuilder.garment", pattern).as_posix()
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
        for given in (name, kind):
            if given is not None:
                text_of("SceneBuilder.body", given)
        if kind is None and name in _KINDS:
            own = repr(keys.get("name", "floor" if name == "plane" else "ball"))
            note = f"the name of a body comes first now: body({own}, {name!r}, ...)"
            warnings.warn(note, FutureWarning, stacklevel=2)
            name, kind = keys.pop("name", None), name
        if kind is None or (name in _KINDS and kind not in _KINDS):
            own = "'ball'" if name is None or name in _KINDS else repr(name)
            kinds = ", ".join(repr(known) for known in _KINDS)
            raise UsageError(f"a body has a name and a kind: body({own}, 'sphere', ...); kinds are {kinds}")
        if name is not None:
            keys = {"name": name} | keys
        colliders = self._part("collider", dict)
        bodies = colliders.get(kind, [])
        if not isinstance(bodies, list):
            raise UsageError(f"collider.{kind} is {shown(bodies)}; set it to a list, or leave it out")
        colliders[kind] = [*bodies, plain(keys, f"collider.{kind}[{len(bodies)}]")]
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
        which `rate=` says how many a second has. Raises `UsageError` for other shapes, and for a
        name whose files are those of another body's frames, such as `"arm_0"` beside the frames of
        `"arm"`.
        """
        name = text_of("SceneBuilder.mesh", name)
        if faces is None:
            if not (hasattr(vertices, "vertices") and hasattr(vertices, "faces")):
                raise UsageError(f"the body {name!r} has no faces; give (m, 3), or a mesh of trimesh")
            vertices, faces = vertices.vertices, vertices.faces
        places = array_of(f"the vertices of {name!r}", vertices)
        try:
            corners = np.asarray(faces)
        except ValueError:
            raise UsageError(f"{name!r} has faces of no shape; give (m, 3) numbers of vertices") from None
        if places.ndim != 2 or places.shape[1] != 3:
            raise UsageError(f"{name!r} has vertices of shape {places.shape}; give (k, 3), in m")
        if corners.ndim != 2 or corners.shape[1] != 3 or not np.issubdtype(corners.dtype, np.integer):
            shape = f"of shape {corners.shape} and type {corners.dtype}"
            raise UsageError(f"{name!r} has faces {shape}; give (m, 3) numbers of vertices, from 0")
        mesh = _drape.Mesh(places, np.require(corners, np.int64, ["C", "A"]))
        held = [Held(f"the body {name!r}", mesh)]
        if frames is not None:
            moving = array_of(f"the frames of {name!r}", frames)
            if moving.ndim != 3 or moving.shape[1:] != places.shape:
                wanted = f"(f, {len(places)}, 3)"
                raise UsageError(f"{name!r} has frames of shape {moving.shape}; give {wanted}, in m")
            poses = _drape.MeshFrames(moving, len(places))
            held.append(Held(f"the frames of the body {name!r}", poses, mesh))
        own: dict[str, Any] = {"file": self._hold("bodies", name, ".obj", *held)}
        if frames is not None:
            own["frames"] = HeldName(own["file"].removesuffix(".obj") + "_*.obj")
        if self._table.get("length", "m") != "m":
            own["scale"] = 1
        return self.body(name, "mesh", **(own | keys))

    def to_toml(self) -> str:
        """Returns the text of the scene."""
        return dumps(self._table)

    def scene(self) -> Scene:
        """Checks the scene. Raises `InputError` with all mistakes, each with its key."""
        self._check_names(self._table, "")
        # The builder may change; the scene stays as it is.
        table = copy.deepcopy(self._table)
        held = {file: one.value for file, one in self._held.items()}
        keys = {"table": table, "held": held, "folder": self._folder, "allow": self._allow}
        return Scene(_drape.Scene.from_keys(keys))

    def save(self, path: StrPath, *, replace: bool = False) -> None:
        """Writes the scene for the command, and its fabrics, patterns and bodies beside it.

        Files that it names besides stay where they are: they are seen from the folder of `path`.
        Raises `UsageError` where files are there already, unless it may `replace` them, or where files
        would be read as further frames of a body, and `OutputError` for files that cannot be written.
        """
        path, replace = path_of("SceneBuilder.save", path), flag_of("replace", replace)
        self._check_names(self._table, "")
        texts = {path: self.to_toml()}
        for name, held in self._held.items():
            texts |= {path.parent / file: text for file, text in _texts(name, held)}
        with files("SceneBuilder.save"):
            there = [str(file) for file in texts if file.exists()]
            if there and not replace:
                raise UsageError(f"{', '.join(there)} exists; save elsewhere, or with replace=True")
            for name in self._held:
                self._check_frames(path.parent, name, texts)
            for file, text in texts.items():
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8", newline="\n")

    def _part(self, kind: str, of_type: type[Any]) -> Any:
        """Returns the table or the list of a kind of part, which is there from then on."""
        part = self._table.setdefault(kind, of_type())
        if not isinstance(part, of_type):
            wanted = "dictionary" if of_type is dict else "list"
            raise UsageError(f"{kind} is {shown(part)}; set it to a {wanted}, or leave it out")
        return part

    def _add(self, kind: str, keys: Mapping[str, Any]) -> SceneBuilder:
        entries = self._part(kind, list)
        entries.append(plain(keys, f"{kind}[{len(entries)}]"))
        return self

    def _hold(self, folder: str, name: str, ending: str, held: Held, frames: Held | None = None) -> HeldName:
        """Holds a value, and frames of it, as files; returns the name of the first file."""
        stem = re.sub(r"[^\w-]+", "-", name) or "unnamed"
        taken = {_plain_name(file) for file in self._held}
        file, number = f"{folder}/{stem}{ending}", 2
        while _plain_name(file) in taken:
            file, number = f"{folder}/{stem}-{number}{ending}", number + 1
        new: dict[str, Held] = {HeldName(file): held}
        if frames is not None:
            new[HeldName(f"{file.removesuffix(ending)}_*{ending}")] = frames
        for own, one in new.items():
            for other, there in self._held.items():
                if _overlap(own, other) or _overlap(other, own):
                    raise UsageError(
                        f"the file {own} of {one.owner} would be one with {other} of {there.owner}; "
                        "give one of them another name"
                    )
        self._held |= new
        return HeldName(file)

    def _check_names(self, value: Any, place: str) -> None:
        """Refuses names of files of the disk that are those of what the scene holds."""
        if isinstance(value, dict):
            for key, entry in value.items():
                self._check_names(entry, f"{place}.{key}".lstrip("."))
        elif isinstance(value, list):
            for index, entry in enumerate(value):
                self._check_names(entry, f"{place}[{index}]")
        elif isinstance(value, str) and not isinstance(value, HeldName):
            if place.rpartition(".")[2] not in _FILES:
                return
            for name, held in self._held.items():
                if _plain_name(value) == _plain_name(name) or _overlap(name, value):
                    raise UsageError(
                        f"{place} names the file {value}, and so would be called {held.owner}, which the "
                        "builder holds; move the file, or give the other another name"
                    )

    def _check_frames(self, folder: Path, name: str, texts: Mapping[Path, str]) -> None:
        """Refuses to save frames beside files that would be read as further ones of them."""
        parent = (folder / name).parent
        if "*" not in name or not parent.is_dir():
            return
        within = Path(name).parent
        others = sorted(
            str(file)
            for file in parent.iterdir()
            if file not in texts and _overlap(name, (within / file.name).as_posix())
        )
        if others:
            owner = self._held[name].owner
            raise UsageError(f"{', '.join(others)} would be read as {owner}; remove it, or save elsewhere")

    def __repr__(self) -> str:
        return f"<drape.SceneBuilder {self._table.get('name', 'unnamed')!r}>"


def _plain_name(file: str) -> str:
    """Returns the name that a file has on disks that do not tell capital letters apart."""
    return os.path.normpath(file).replace(os.sep, "/").casefold()


def _overlap(pattern: str, file: str) -> bool:
    """Returns whether a file is one of those of a pattern, whose * stands for a number."""
    before, star, after = _plain_name(pattern).partition("*")
    inner = _plain_name(file).removeprefix(before).removesuffix(after)
    whole = _plain_name(file) == before + inner + after
    return bool(star) and whole and bool(re.fullmatch("[0-9]+", inner))


def _texts(file: str, held: Held) -> Iterator[tuple[str, str]]:
    """Returns the names and the texts of the files of a value that a scene holds."""
    value = held.value
    if held.mesh is not None:
        for number in range(len(value)):
            yield file.replace("*", str(number)), held.mesh.frame_to_obj(value, number)
    elif isinstance(value, _drape.Mesh):
        yield file, value.to_obj()
    elif isinstance(value, Mapping):
        yield file, dumps(value)
    else:
        yield file, value.to_toml()
