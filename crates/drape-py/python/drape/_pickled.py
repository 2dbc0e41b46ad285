"""What is pickled, made again: the pickles name these functions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _drape


def fabric(text: str) -> _drape.Fabric:
    """Returns the fabric of its text."""
    return _drape.Fabric.from_toml(text)


def scene(text: str, place: dict[str, Any]) -> _drape.Scene:
    """Returns the scene of a text in its place."""
    return _drape.Scene.from_toml(text, place)


def built_scene(keys: dict[str, Any]) -> _drape.Scene:
    """Returns the scene of its keys."""
    return _drape.Scene.from_keys(keys)


def mesh(vertices: npt.NDArray[np.float64], faces: npt.NDArray[np.uint32]) -> _drape.Mesh:
    """Returns the mesh of its arrays."""
    return _drape.Mesh(vertices, faces.astype(np.int64))


def mesh_frames(frames: npt.NDArray[np.float64], count: int) -> _drape.MeshFrames:
    """Returns the frames of a mesh with so many vertices."""
    return _drape.MeshFrames(frames, count)


@dataclass(frozen=True)
class StoredFit:
    """What a fit says, in place of the fit itself, which only a sheet gives."""

    fabric: _drape.Fabric
    told: dict[str, Any]

    @staticmethod
    def of(fit: _drape.Fit | StoredFit) -> StoredFit:
        """Returns what a fit says."""
        if isinstance(fit, StoredFit):
            return fit
        told = {"assumed": fit.assumed(), "warnings": fit.warnings(), "text": fit.text(), "html": fit.html()}
        return StoredFit(fit.fabric, told)

    def assumed(self) -> list[str]:
        """What the sheet lacks and was assumed."""
        return list(self.told["assumed"])

    def warnings(self) -> list[str]:
        """What deserves a second look."""
        return list(self.told["warnings"])

    def text(self) -> str:
        """The report as text."""
        return str(self.told["text"])

    def html(self) -> str:
        """The report as a page."""
        return str(self.told["html"])
