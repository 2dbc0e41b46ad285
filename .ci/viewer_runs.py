"""Writes the folder of a run as `drape run` would, of a garment that no simulation needs to make.

    viewer_runs.py FOLDER PARTICLES FRAMES

Two panels hang round an ellipsoid and swing; waves run through them.
"""

import json
import math
import random
import sys
from array import array
from pathlib import Path


def write(path, kind, shape, numbers):
    """Writes an array of NumPy, of doubles (d) or of unsigned numbers (I)."""
    name = {"d": "<f8", "I": "<u4"}[kind]
    header = f"{{'descr': '{name}', 'fortran_order': False, 'shape': {shape}, }}"
    header = header.ljust(117) + "\n"
    head = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode()
    path.write_bytes(head + array(kind, numbers).tobytes())


def lattice(columns, rows, first):
    """Triangles of a lattice whose vertices begin with a number."""
    corners = []
    for row in range(rows - 1):
        for column in range(columns - 1):
            a = first + row * columns + column
            corners += [a, a + 1, a + columns, a + 1, a + columns + 1, a + columns]
    return corners


def ellipsoid(columns, rows):
    points, corners = [], []
    for row in range(rows):
        polar = math.pi * (row + 0.5) / rows
        for column in range(columns):
            angle = 2 * math.pi * column / columns
            points += [0.16 * math.sin(polar) * math.cos(angle), 0.4 * math.cos(polar), 0.11 * math.sin(polar) * math.sin(angle)]
    for row in range(rows - 1):
        for column in range(columns):
            a, b = row * columns + column, row * columns + (column + 1) % columns
            corners += [a, b, a + columns, b, b + columns, a + columns]
    return points, corners


def main(folder, particles, frames):
    folder.mkdir(parents=True, exist_ok=True)
    columns = round(math.sqrt(particles / 2))
    rows = math.ceil(particles / 2 / columns)
    count = columns * rows
    spacing = 0.6 / (rows - 1)
    draw = random.Random(1)
    waves = [
        [0.02 / k, draw.uniform(0, 6.28), draw.uniform(2, 5) * k, draw.uniform(1, 4) * k, draw.uniform(3, 6)]
        for k in range(1, 7)
    ]
    panel = lambda name: {
        "name": name, "vertices": count, "triangles": 2 * (columns - 1) * (rows - 1), "fabric": "wool",
        "reach": 2e-4, "separation": 1e-4, "weft": [1.0, 0.0],
    }
    points, corners = ellipsoid(96, 48)
    body = {"name": "body", "vertices": len(points) // 3, "triangles": len(corners) // 3, "reach": 0.0, "separation": 0.0}
    sides = [[row * columns + end, count + row * columns + end] for row in range(rows) for end in (0, columns - 1)]
    manifest = {
        "format": 2, "units": "m", "up": "y", "guarded": True, "panels": [panel("front"), panel("back")],
        "bodies": [body], "twins": sides,
    }
    (folder / "surfaces.json").write_text(json.dumps(manifest) + "\n")
    write(folder / "triangles.npy", "I", (4 * (columns - 1) * (rows - 1), 3), lattice(columns, rows, 0) + lattice(columns, rows, count))
    flat = [x for row in range(rows) for column in range(columns) for x in (column * spacing, row * spacing)]
    write(folder / "material.npy", "d", (2 * count, 2), flat + flat)
    write(folder / "body-triangles.npy", "I", (len(corners) // 3, 3), corners)
    write(folder / "bodies-00000.npy", "d", (len(points) // 3, 3), points)
    lines, energy = ["number,time,growth,bodies,touched"], ["number,time,kinetic,gravity,elastic"]
    for number in range(frames):
        time = number / 25
        positions = []
        for side in (1, -1):
            for row in range(rows):
                height = 0.3 - row * spacing
                for column in range(columns):
                    angle = math.pi * column / (columns - 1)
                    out = 0.03 * row / rows
                    for size, phase, across, along, speed in waves:
                        out += size * row / rows * math.sin(phase + across * angle * side + along * row / rows * 3 - speed * time)
                    positions += [(0.19 + out) * math.cos(angle), height, side * (0.14 + out) * math.sin(angle)]
        write(folder / f"frame-{number:05}.npy", "d", (2 * count, 3), positions)
        lines.append(f"{number},{time},1.0,0,0")
        energy.append(f"{number},{time},{0.1 * math.exp(-time)},{0.3 * math.exp(-time) - 0.3},{0.2 - 0.1 * math.exp(-time)}")
    (folder / "frames.csv").write_text("\n".join(lines) + "\n")
    (folder / "energy.csv").write_text("\n".join(energy) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
