"""Holds cloth that Blender simulates with the script of `drape fabric export` against closed forms.

    blender_cloth.py DRAPE

DRAPE is the program. A strip hangs, a panel shears by its weight, a cantilever bends, on two meshes
each; the script of a fabric with straight laws makes the settings.
"""

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

GRAVITY = 9.81

# Difference from the closed form, over it. Springs on diagonals add a few hundredths to the stretch,
# large angles and rims of few cells take a few from the others.
LIMIT = 0.05

FABRIC = """
name = "straight"
density = {density}
thickness = 0.0004
shear.stiffness = 30.0
[warp]
traction.primed = {{ stiffness = {stretch}, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }}
traction.buckling = {{ strain = 0.1, stiffness = 0.0 }}
bending.rigidity = 1e-4
[weft]
traction.primed = {{ stiffness = {stretch}, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }}
traction.buckling = {{ strain = 0.1, stiffness = 0.0 }}
bending.rigidity = 1e-4
"""


def exported(drape, folder, density, stretch):
    """Returns the script of a fabric, as a module."""
    fabric, script = folder / "fabric.toml", folder / f"cloth{stretch}.py"
    fabric.write_text(FABRIC.format(density=density, stretch=stretch))
    subprocess.run([drape, "fabric", "export", fabric, "-o", script, "--quiet"], check=True)
    spec = importlib.util.spec_from_file_location(script.stem, script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def grid(cells, spacing, hangs):
    """Returns a sheet of square cells, from above or from its left upper corner down, and its rows."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    columns, rows = (count + 1 for count in cells)
    places = [(i * spacing, j * spacing) for j in range(rows) for i in range(columns)]
    vertices = [(x, 0, -y) if hangs else (x, y, 0) for x, y in places]
    corners = [(i + j * columns) for j in range(rows - 1) for i in range(columns - 1)]
    faces = [(k, k + 1, k + columns + 1, k + columns) for k in corners]
    mesh = bpy.data.meshes.new("cloth")
    mesh.from_pydata(vertices, [], faces)
    mesh.update()
    cloth = bpy.data.objects.new("cloth", mesh)
    bpy.context.scene.collection.objects.link(cloth)
    return cloth, np.arange(columns * rows).reshape(rows, columns)


def heights(cloth, script, pinned):
    """Returns the heights of the vertices at rest, and the settings of the cloth."""
    group = cloth.vertex_groups.new(name="pinned")
    group.add([int(vertex) for vertex in pinned], 1.0, "REPLACE")
    script.apply(cloth, 24.0)
    (modifier,) = [modifier for modifier in cloth.modifiers if modifier.type == "CLOTH"]
    modifier.settings.vertex_group_mass = "pinned"
    modifier.collision_settings.use_collision = False
    frames = 300
    scene = bpy.context.scene
    scene.frame_end = modifier.point_cache.frame_end = frames
    for frame in range(1, frames + 1):
        scene.frame_set(frame)
    mesh = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    positions = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", positions)
    return positions.reshape(-1, 3)[:, 2], modifier.settings


def hanging(script, spacing, length=0.5):
    """Extension of a strip by its weight: ρ g L² / 2K."""
    cloth, rows = grid((20, round(length / spacing)), spacing, hangs=True)
    z, _ = heights(cloth, script, rows[0])
    extension = -z[rows[-1, 10]] - length
    return extension, script.DENSITY * GRAVITY * length**2 / (2 * script.STRETCH[0])


def sheared(script, spacing, length=0.2):
    """Sag of a panel that is held at its left side: ρ g L² / 2G."""
    count = round(length / spacing)
    cloth, rows = grid((count, count), spacing, hangs=True)
    z, _ = heights(cloth, script, rows[:, 0])
    sag = z[rows[count // 2, 0]] - z[rows[count // 2, -1]]
    return sag, script.DENSITY * GRAVITY * length**2 / (2 * script.SHEAR)


def cantilever(script, spacing, length):
    """Tip of a cantilever that bends by its weight at the edges, each by moment over rigidity."""
    count = round(length / spacing)
    cloth, rows = grid((count + 2, 20), spacing, hangs=False)
    z, settings = heights(cloth, script, rows[:, :3].flat)
    # Masses of a row over its width, and the angles that the edges turn by.
    mass = settings.mass * len(rows) / (len(rows) - 1) / spacing
    moments = [sum((j - i) * spacing * mass * GRAVITY for j in range(i + 1, count + 1)) for i in range(count)]
    angles = [moment * spacing / script.BENDING[0] for moment in moments]
    return -z[rows[10, -1]], sum(angle * (count - i) * spacing for i, angle in enumerate(angles))


def main():
    """Prints the differences, and fails beyond the limit."""
    print(f"Blender {bpy.app.version_string}")
    worst = 0.0
    with tempfile.TemporaryDirectory() as folder:
        light = exported(sys.argv[1], Path(folder), 0.02, 20000.0)
        heavy = exported(sys.argv[1], Path(folder), 0.15, 2000.0)
        for name, measured, expected in [
            *(("hanging strip", *hanging(heavy, spacing)) for spacing in (0.02, 0.01)),
            *(("sheared panel", *sheared(light, spacing)) for spacing in (0.02, 0.01)),
            *(("cantilever", *cantilever(heavy, *sizes)) for sizes in ((0.01, 0.03), (0.005, 0.03))),
        ]:
            difference = measured / expected - 1
            worst = max(worst, abs(difference))
            print(f"{name}: {1e3 * measured:.4f} mm, {1e3 * expected:.4f} mm by hand, {100 * difference:+.1f} %")
    if not worst < LIMIT:
        raise SystemExit(f"A difference is beyond {100 * LIMIT:.0f} %")


if __name__ == "__main__":
    main()
