"""Builds a scene from arrays, without a file or a text, and runs it for a tenth of a second."""

import numpy as np

import drape

# A dome of rings round the y axis, closed by a point above and one below.
rings, around, radius = 12, 48, 0.1
polar = np.linspace(0, np.pi, rings + 2)[1:-1, None]
turn = np.arange(around) * 2 * np.pi / around
ring = np.stack(np.broadcast_arrays(np.sin(polar) * np.cos(turn), np.cos(polar), np.sin(polar) * np.sin(turn)), -1)
vertices = radius * np.concatenate([ring.reshape(-1, 3), [[0, 1, 0], [0, -1, 0]]])

here = np.arange(rings * around).reshape(rings, around)
after = np.roll(here, -1, axis=1)
sides = np.stack([here[:-1], after[:-1], after[1:], here[:-1], after[1:], here[1:]], -1).reshape(-1, 3)
top, bottom = np.full(around, rings * around), np.full(around, rings * around + 1)
caps = [np.stack([top, after[0], here[0]], -1), np.stack([bottom, here[-1], after[-1]], -1)]
faces = np.concatenate([sides, *caps])

# KES values of a poplin, as a laboratory writes them.
yarns = {"LT": 0.7, "WT": 8.0, "RT": 55.0, "B": 0.08, "2HB": 0.05}
poplin = drape.Fabric.from_values(
    "poplin", {"W": 12.0, "T": 0.3, "mean": {"G": 0.9, "2HG": 2.0}, "warp": yarns, "weft": yarns}
)

builder = drape.SceneBuilder(spacing=0.02, time={"step": 0.005, "end": 0.1})
builder.fabric("poplin", poplin)
builder.panel("napkin", "poplin", rectangle=[0.4, 0.4], center=[0, 0.11, 0], turn=[-90, 0, 0])
builder.mesh("ball", vertices, faces, friction=0.3)
run = builder.scene().run()
print(f"{run.summary['particles']} particles, {run.summary['steps']} steps, {run.summary['status']}")
assert run.summary["status"] == "ok"
