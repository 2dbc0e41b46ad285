"""Compares what programs read out of the files of `drape export` with the run itself.

    readers.py DRAPE RUN [READER ...]

DRAPE is the program, RUN the folder of a run; readers are usd, gltf, vtk, numpy, obj, cache and
blender, all but blender without arguments. Each prints its version and the largest differences.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

# Half a unit in the last place of a coordinate up to 4 m in single precision.
SINGLE = 2.5e-7
# A morph target and its base have one each.
MORPH = 2 * SINGLE


class Run:
    """The run as its folder has it."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.manifest = json.loads((self.folder / "surfaces.json").read_text())
        table = np.genfromtxt(self.folder / "frames.csv", delimiter=",", names=True)
        table = np.atleast_1d(table)
        times = table["time"]
        # Of frames at one time the last.
        self.numbers = [i for i in range(len(times)) if i + 1 == len(times) or times[i + 1] > times[i]]
        self.times = times[self.numbers]
        load = lambda name: np.load(self.folder / name)
        self.cloth = np.stack([load(f"frame-{n:05}.npy") for n in self.numbers])
        self.triangles = load("triangles.npy")
        self.material = load("material.npy")
        self.panels = self.parts(self.manifest["panels"])
        self.bodies = self.parts(self.manifest["bodies"])
        self.pattern = np.concatenate(
            [self.turned(self.material[own], panel["weft"]) for panel, own in self.panels]
        )
        # Pressures where the frame has a file of them, in which something touches.
        at = lambda n: self.folder / f"pressure-{n:05}.npy"
        none = np.zeros(len(self.material), dtype="<f2")
        self.pressure = np.stack([np.load(at(n)) if at(n).exists() else none for n in self.numbers])
        energy = np.genfromtxt(self.folder / "energy.csv", delimiter=",", names=True)
        self.energy = {name: energy[name][self.numbers] for name in energy.dtype.names[2:]}
        if self.bodies:
            files = [f"bodies-{int(table['bodies'][n]):05}.npy" for n in self.numbers]
            self.body = np.stack([load(file) for file in files])
            self.body_triangles = load("body-triangles.npy")

    @staticmethod
    def parts(parts):
        ends = np.cumsum([part["vertices"] for part in parts])
        return [(part, slice(end - part["vertices"], end)) for part, end in zip(parts, ends)]

    @staticmethod
    def turned(material, weft):
        (x, y), (u, v) = weft, material.T
        return np.stack([u * x - v * y, u * y + v * x], axis=1)

    def difference(self, seconds, positions):
        """Largest difference of positions from the frame that is nearest to some seconds after the
        first; of two as near, from the better."""
        late = np.abs(self.times - self.times[0] - seconds)
        near = np.flatnonzero(late <= late.min() + 1e-6)
        return min(float(np.abs(positions - self.cloth[frame]).max()) for frame in near)

    def normals(self, frame):
        """Normals of the vertices of a frame, without those of twins."""
        positions = self.cloth[frame]
        a, b, c = positions[self.triangles].transpose(1, 0, 2)
        sums = np.zeros_like(positions)
        for corner in range(3):
            np.add.at(sums, self.triangles[:, corner], np.cross(b - a, c - a))
        return sums / np.linalg.norm(sums, axis=1)[:, None]

    def warp_strain(self, frame):
        """Mean strain along the warp at the vertices of a frame, weighted by areas at rest, in %."""
        a, b, c = self.material[self.triangles].transpose(1, 0, 2)
        rest = np.stack([b - a, c - a], axis=2)
        a, b, c = self.cloth[frame][self.triangles].transpose(1, 0, 2)
        gradient = np.stack([b - a, c - a], axis=2) @ np.linalg.inv(rest)
        strain = 100 * (np.linalg.norm(gradient[:, :, 1], axis=1) - 1)
        areas = np.abs(np.linalg.det(rest))
        sums, weights = np.zeros((2, len(self.material)))
        for corner in range(3):
            np.add.at(sums, self.triangles[:, corner], areas * strain)
            np.add.at(weights, self.triangles[:, corner], areas)
        return sums / weights

    def sewn(self):
        pairs = self.manifest.get("twins", [])
        return np.unique(np.array(pairs, dtype=int).reshape(-1))


def apart(what, found, expected, most):
    found, expected = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    assert found.shape == expected.shape, f"{what}: {found.shape}, and the run has {expected.shape}"
    difference = float(np.max(np.abs(found - expected), initial=0.0))
    assert difference <= most, f"{what}: {difference:g} apart, more than {most:g}"
    print(f"  {what}: {difference:.2g} apart at most, of {found.shape}")


def same(what, found, expected):
    assert found == expected, f"{what}: {found!r}, and the run has {expected!r}"
    print(f"  {what}: {found!r}"[:110])


def free(run):
    """Vertices of the cloth that are in no seam."""
    return np.setdiff1d(np.arange(run.cloth.shape[1]), run.sewn())


def read_usd(run, export):
    from pxr import Usd, UsdGeom, UsdShade

    print("usd-core", ".".join(map(str, Usd.GetVersion())))
    stage = Usd.Stage.Open(str(export("usda")))
    same("units in m", UsdGeom.GetStageMetersPerUnit(stage), 1.0)
    same("up", UsdGeom.GetStageUpAxis(stage), "Y")
    rate = stage.GetTimeCodesPerSecond()
    meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    parts = run.panels + run.bodies
    same("names", [m.GetPrim().GetCustomDataByKey("name") for m in meshes], [p["name"] for p, _ in parts])
    same("display names given", all(m.GetPrim().GetDisplayName() for m in meshes), True)
    panels = meshes[: len(run.panels)]
    codes = panels[0].GetPointsAttr().GetTimeSamples() if len(run.times) > 1 else [0.0]
    apart("times in s", np.array(codes) / rate + run.times[0], run.times, 1e-5 / rate)
    at = lambda get: np.stack(
        [np.concatenate([np.array(get(mesh, code)) for mesh in panels]) for code in codes]
    )
    apart("positions in m", at(lambda mesh, code: mesh.GetPointsAttr().Get(code)), run.cloth, SINGLE)
    normals = at(lambda mesh, code: mesh.GetNormalsAttr().Get(code))
    own = free(run)
    apart("normals away from seams", normals[-1][own], run.normals(len(codes) - 1)[own], 1e-6)
    shared = [[a, b] for a, b in run.manifest.get("twins", []) if np.all(run.cloth[-1][a] == run.cloth[-1][b])]
    if shared:
        a, b = np.array(shared).T
        cosines = np.sum(normals[-1][a] * normals[-1][b], axis=1)
        print(f"  normals of {len(a)} twins: {np.mean(cosines > 0.99999):.1%} shared")
    st = np.concatenate([np.array(UsdGeom.PrimvarsAPI(m).GetPrimvar("st").Get()) for m in panels])
    apart("UV in m", st, run.pattern, SINGLE)
    for mesh, (part, own) in zip(meshes[len(run.panels):], run.bodies):
        points = mesh.GetPointsAttr()
        found = np.stack([np.array(points.Get(code)) for code in codes])
        apart(f"body {part['name']!r}", found, run.body[:, own], SINGLE)
        primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
        corners = np.array(mesh.GetFaceVertexIndicesAttr().Get())
        same("its normals", (primvar.GetInterpolation(), len(primvar.ComputeFlattened(codes[-1]))), ("faceVarying", len(corners)))
    triangles = [np.array(m.GetFaceVertexIndicesAttr().Get()) + own.start for m, (_, own) in zip(panels, run.panels)]
    same("triangles", bool(np.all(np.concatenate(triangles).reshape(-1, 3) == run.triangles)), True)
    colours = set()
    for mesh in panels:
        shader, = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0].ComputeSurfaceSource()[:1]
        colours.add(tuple(shader.GetInput("diffuseColor").Get()))
    same("colours of panels", len(colours), len(panels))


def read_gltf(run, export):
    import pygltflib
    import trimesh

    print("pygltflib", pygltflib.__version__, "trimesh", trimesh.__version__)
    path = export("glb")
    gltf = pygltflib.GLTF2().load(str(path))
    binary = gltf.binary_blob()
    def read(index):
        accessor = gltf.accessors[index]
        view = gltf.bufferViews[accessor.bufferView]
        kind = {5126: np.float32, 5125: np.uint32}[accessor.componentType]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor.type]
        start = (view.byteOffset or 0) + (accessor.byteOffset or 0)
        rows = np.frombuffer(binary, kind, accessor.count * width, start).reshape(-1, width)
        if accessor.min:
            bounds = [rows.min(axis=0), rows.max(axis=0)]
            assert np.array_equal(np.float32(bounds), np.float32([accessor.min, accessor.max]))
        return rows.astype(float)
    extras = gltf.scenes[0].extras
    same("units, up", (extras["units"], extras["up"]), ("m", "y"))
    frames = [run.numbers.index(number) for number in extras["frames"]]
    same("names", [node.extras["name"] for node in gltf.nodes], [p["name"] for p, _ in run.panels + run.bodies])
    panels = gltf.meshes[: len(run.panels)]
    primitives = [mesh.primitives[0] for mesh in panels]
    base = np.concatenate([read(p.attributes.POSITION) for p in primitives])
    apart("positions of the last frame in m", base, run.cloth[frames[-1]], SINGLE)
    targets = len(primitives[0].targets or [])
    same("morph targets", targets, len(frames) - 1)
    target = lambda p, k: p.targets[k]["POSITION"] if isinstance(p.targets[k], dict) else p.targets[k].POSITION
    moved = np.stack([base + np.concatenate([read(target(p, k)) for p in primitives]) for k in range(targets)] + [base])
    apart("positions of all frames in m", moved, run.cloth[frames], MORPH)
    if targets:
        sampler = gltf.animations[0].samplers[0]
        apart("times in s", read(sampler.input)[:, 0] + extras["startTime"], run.times[frames], 1e-6)
        weights = read(sampler.output).reshape(len(frames), targets)
        same("weights", bool(np.all(weights == np.eye(len(frames))[:, :targets])), True)
    uv = np.concatenate([read(p.attributes.TEXCOORD_0) for p in primitives])
    apart("UV in m", np.stack([uv[:, 0], 1 - uv[:, 1]], axis=1), run.pattern, SINGLE)
    scene = trimesh.load(path, process=False)
    same("trimesh: parts", len(scene.geometry), len(run.panels + run.bodies))
    parts = run.panels + run.bodies
    count = sum(len(geometry.faces) for geometry in scene.geometry.values())
    same("trimesh: triangles", count, sum(part["triangles"] for part, _ in parts))
    low, high = scene.bounds
    points = np.concatenate([run.cloth[frames[-1]]] + ([run.body[frames[-1]]] if run.bodies else []))
    apart("trimesh: bounds in m", [low, high], [points.min(axis=0), points.max(axis=0)], SINGLE)


def read_vtk(run, export):
    import pyvista
    import vtk

    print("pyvista", pyvista.__version__, "vtk", vtk.vtkVersion.GetVTKVersion())
    reader = pyvista.get_reader(str(export("vtp").with_suffix(".pvd")))
    apart("times in s", reader.time_values, run.times, 0)
    for index, time in enumerate(run.times):
        reader.set_active_time_value(time)
        blocks = reader.read()
        cloth = blocks[0]
        assert np.array_equal(cloth.points, run.cloth[index]), f"frame {index}"
        assert cloth.field_data["TimeValue"][0] == time
        if run.bodies:
            assert np.array_equal(blocks[1].points, run.body[index]), f"bodies of frame {index}"
    apart("positions of the last frame in m", cloth.points, run.cloth[-1], 0)
    same("names", list(cloth.field_data["names"]), [part["name"] for part, _ in run.panels])
    same("units, up", (cloth.field_data["units"][0], cloth.field_data["up"][0]), ("m", "y"))
    apart("UV in m", cloth.active_texture_coordinates, run.pattern, 0)
    own = free(run)
    apart("normals away from seams", cloth.point_data["Normals"][own], run.normals(-1)[own], 1e-6)
    moved = run.cloth[-1] - run.cloth[-2]
    speed = np.linalg.norm(moved, axis=1) / (run.times[-1] - run.times[-2])
    apart("speed in m/s", cloth.point_data["speed (m/s)"], speed, 1e-9)
    apart("pressure in Pa", cloth.point_data["pressure (Pa)"], run.pressure[-1], 0)
    warp = run.warp_strain(-1)
    apart("strain along the warp in %", cloth.point_data["strain-warp (%)"], warp, 1e-9)
    same("triangles", bool(np.all(cloth.regular_faces == run.triangles)), True)
    counts = [part["triangles"] for part, _ in run.panels]
    same("panels of triangles", np.bincount(cloth.cell_data["part"]).tolist(), counts)


def read_numpy(run, export):
    print("numpy", np.__version__)
    npz = np.load(export("npz"))
    apart("positions in m", npz["positions"], run.cloth, 0)
    apart("times in s", npz["times"], run.times, 0)
    apart("UV in m", npz["uv"], run.pattern, 0)
    same("triangles", bool(np.all(npz["triangles"] == run.triangles)), True)
    same("names", npz["panels"].tolist(), [part["name"] for part, _ in run.panels])
    same("vertices of panels", np.bincount(npz["panel"]).tolist(), [part["vertices"] for part, _ in run.panels])
    same("something touches", bool(run.pressure.max() > 0), True)
    apart("pressure in Pa", npz["pressure"], run.pressure, 0)
    same("entries of the energy", npz["energies"].tolist(), list(run.energy))
    apart("energy in J", npz["energy"], np.stack(list(run.energy.values()), axis=1), 0)
    if run.bodies:
        apart("bodies in m", np.broadcast_to(npz["body_positions"], run.body.shape), run.body, 0)
    table = np.genfromtxt(export("csv"), delimiter=",", names=True)
    apart("CSV: lowest in m", table["lowest_m"], run.cloth[:, :, 1].min(axis=1), 0)
    apart("CSV: largest pressure in Pa", table["largest_pressure_Pa"], run.pressure.max(axis=1), 0)
    apart("CSV: kinetic energy in J", table["kinetic_J"], run.energy["kinetic"], 0)
    a, b, c = run.cloth[-1][run.triangles].transpose(1, 0, 2)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    apart("CSV: area in m2", table["area_m2"][-1], area, 1e-12)
    moved = np.linalg.norm(np.diff(run.cloth, axis=0), axis=2) / np.diff(run.times)[:, None]
    apart("CSV: largest speed in m/s", table["largest_speed_ms"][1:], moved.max(axis=1), 1e-9)


def read_mdd(export):
    """Times and positions of an MDD file, by its definition."""
    content = export("mdd").read_bytes()
    frames, points = np.frombuffer(content, ">i4", 2)
    times = np.frombuffer(content, ">f4", frames, 8)
    return times, np.frombuffer(content, ">f4", offset=8 + 4 * frames).reshape(frames, points, 3)


def read_cache(run, export):
    print("pc2, mdd: by their definitions; Blender is another reader")
    times, positions = read_mdd(export)
    worst = max(run.difference(*pair) for pair in zip(times, positions))
    apart("MDD: positions in m", worst, 0, SINGLE)
    pc2 = export("pc2").read_bytes()
    same("PC2: head", pc2[:12], b"POINTCACHE2\0")
    same("PC2: version, points", np.frombuffer(pc2, "<i4", 2, 12).tolist(), [1, positions.shape[1]])
    same("PC2: frames", int(np.frombuffer(pc2, "<i4", 1, 28)[0]), len(times))
    positions = np.frombuffer(pc2, "<f4", offset=32).reshape(positions.shape)
    worst = max(run.difference(*pair) for pair in zip(times, positions))
    apart("PC2: positions in m", worst, 0, SINGLE)


def read_obj(run, export):
    import trimesh

    print("trimesh", trimesh.__version__)
    path = export("obj")
    points = np.concatenate([run.cloth[-1]] + ([run.body[-1]] if run.bodies else []))
    found = trimesh.load(path, process=False, force="mesh")
    apart("bounds in m", found.bounds, [points.min(axis=0), points.max(axis=0)], 1e-12)
    lines = path.read_text().splitlines()
    rows = lambda key: np.array([line.split()[1:] for line in lines if line.startswith(key)], dtype=float)
    apart("positions in m", rows("v "), points, 0)
    apart("UV in m", rows("vt "), run.pattern, 0)


def read_blender(run, export):
    import bpy

    print("Blender", bpy.app.version_string)
    for ending in ["pc2", "mdd"]:
        cache = export(ending)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.obj_import(filepath=str(cache.with_suffix(".obj")))
        cloth, = bpy.context.selected_objects
        same("object", cloth.name, "cloth")
        same("vertices", len(cloth.data.vertices), run.cloth.shape[1])
        same("materials", len(cloth.data.materials), len(run.panels))
        modifier = cloth.modifiers.new("run", "MESH_CACHE")
        modifier.cache_format = ending.upper()
        modifier.filepath = str(cache)
        modifier.frame_start = 0
        worst = 0.0
        scene = bpy.context.scene
        times, _ = read_mdd(export)
        for number, seconds in enumerate(times):
            scene.frame_set(number)
            evaluated = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get())
            mesh = evaluated.to_mesh()
            found = np.empty(3 * len(mesh.vertices), dtype=np.float32)
            mesh.vertices.foreach_get("co", found)
            worst = max(worst, run.difference(seconds, found.reshape(-1, 3)))
            evaluated.to_mesh_clear()
        assert worst <= SINGLE, f"{ending}: {worst} m"
        print(f"  {ending}: Mesh Cache, {len(times)} frames, {worst:.2g} m apart at most")
        # In the world z is up.
        world = np.array([cloth.matrix_world @ vertex.co for vertex in cloth.data.vertices])
        x, y, z = run.cloth[0].T
        apart(f"{ending}: in the world, z up, in m", world, np.stack([x, -z, y], axis=1), 1e-6)
        layer = cloth.data.uv_layers[0].data
        uv = np.empty(2 * len(layer), dtype=np.float32)
        layer.foreach_get("uv", uv)
        corners = np.array([loop.vertex_index for loop in cloth.data.loops])
        apart(f"{ending}: UV in m", uv.reshape(-1, 2), run.pattern[corners], SINGLE)
    for ending, importer in [("glb", bpy.ops.import_scene.gltf), ("usda", bpy.ops.wm.usd_import)]:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        importer(filepath=str(export(ending)))
        meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
        print(f"  {ending}: objects {sorted(thing.name for thing in meshes)}"[:110])
        points = np.concatenate([run.cloth[-1]] + ([run.body[-1]] if run.bodies else []))
        scene = bpy.context.scene
        # Frames of a USD file are its time codes; those of glTF are Blender's own.
        own = np.load(export("npz"))["frames_per_second"]
        rate = own if ending == "usda" else scene.render.fps / scene.render.fps_base
        end = float((run.times[-1] - run.times[0]) * rate)
        scene.frame_set(int(end), subframe=end - int(end))
        graph = bpy.context.evaluated_depsgraph_get()
        found = []
        for thing in meshes:
            evaluated = thing.evaluated_get(graph)
            mesh = evaluated.to_mesh()
            found += [evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]
            evaluated.to_mesh_clear()
        found = np.array(found)
        bounds = lambda p: np.stack([p.min(axis=0), p.max(axis=0)])
        x, y, z = points.T
        apart(f"{ending}: bounds at the end, z up, in m", bounds(found), bounds(np.stack([x, -z, y], axis=1)), 1e-5)


READERS = {
    "obj": read_obj,
    "gltf": read_gltf,
    "usd": read_usd,
    "cache": read_cache,
    "vtk": read_vtk,
    "numpy": read_numpy,
    "blender": read_blender,
}


def main(program, folder, *readers):
    run = Run(folder)
    with tempfile.TemporaryDirectory() as results:
        def export(ending):
            path = Path(results) / ending / f"run.{ending}"
            if not path.exists() and not path.with_suffix(".pvd").exists():
                command = [program, "export", folder, "--format", ending, "-o", str(path)]
                subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            return path
        for reader in readers or [name for name in READERS if name != "blender"]:
            READERS[reader](run, export)


if __name__ == "__main__":
    main(*sys.argv[1:])
