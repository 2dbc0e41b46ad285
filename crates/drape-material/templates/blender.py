# Fabric "{{ name }}" for the cloth simulation of Blender, written by drape {{ version }}.
#
# Select the mesh, open this file in the Scripting tab and run it, or:
#
#     blender scene.blend --python FILE
#
# The cloth modifier of every selected mesh is set, from the fabric and from the mesh: springs of
# Blender stand for cloth of the width of a cell, so that a finer mesh needs other settings. The mesh
# should be of quads that are nearly square, with edges along the yarns. Tried with Blender 4.5.
#
# What is lost:
{%- for loss in losses %}
{%- for line in loss %}
# {% if loop.first %}*{% else %} {% endif %} {{ line }}
{%- endfor %}
{%- endfor %}
# * Slack: of the two springs along the diagonals of a cell only the longer one pulls, and pulls the
#   yarns together. Where yarns are slack, the shear stiffness becomes {{ slack_shear }} N/m.
# * Surface friction: it is {{ material.surface_friction }}. The friction of Blender's collisions is another number,
#   and stays as it is.
# * Damping: the fabric has none but its friction. Blender's springs need some; the script keeps the
#   ratio to the mass that Blender's own settings have.

import math

NAME = {{ literal }}

# Mass per area, in kg/m².
DENSITY = {{ density }}
# Thickness under 49 Pa, in m.
THICKNESS = {{ thickness }}
# Tension per width over strain, on the first stretching from rest to {{ load }} N/m: warp and weft, in N/m.
STRETCH = {{ stretch }}
# The same from rest to a compression of 1 %, in N/m.
COMPRESSION = {{ compression }}
# Shear force per width over the angle, KES G, in N/m per rad.
SHEAR = {{ shear }}
# Bending moment per width over the curvature, KES B: warp and weft, in N·m.
BENDING = {{ bending }}

# Blender takes 0.001 of gravity, in m per square of its unit of time. That unit is therefore
# sqrt(0.001) s, and a stiffness of 1 N/m is 0.001 in Blender.
UNIT_OF_TIME = math.sqrt(0.001)
GRAVITY = 9.81
# Half the density of air, in kg/m³, times the drag coefficient of a plate across the stream.
HALF_AIR = 0.5 * 1.2 * 1.17
# Mass of a vertex of Blender's own settings, in kg, to which their damping and drag belong.
USUAL_MASS = 0.3


def settings(spacing, area, frame_rate=24.0):
    """Returns settings of a cloth modifier, attributes of bpy.types.ClothSettings, by their names.

    `spacing` is the mean length of the edges, in m; `area` is that of the mesh over the number of its
    vertices, in m². `frame_rate` is in frames per second.
    """
    stretch, compression, bending = (sum(pair) / 2 for pair in (STRETCH, COMPRESSION, BENDING))
    stiffness = UNIT_OF_TIME**2
    mass = DENSITY * area

    # Blender moves one unit of its time a frame. The factor makes a second of the scene a second.
    time_scale = 1.0 / (frame_rate * UNIT_OF_TIME)

    # Springs of bending are explicit: steps have to be shorter than the fastest wave of the mesh.
    fastest = math.sqrt(64.0 * stiffness * bending / (DENSITY * spacing**4))
    quality = max(5, math.ceil(0.75 * fastest * time_scale))

    # A flat sheet sinks through still air at this speed. Blender's drag grows with the speed
    # instead of its square, and acts along the sheet too: it is right at that speed across it.
    sinking = math.sqrt(DENSITY * GRAVITY / HALF_AIR)
    drag = mass * GRAVITY / sinking

    damping = mass / USUAL_MASS
    return {
        "mass": mass,
        "quality": quality,
        "time_scale": time_scale,
        "bending_model": "ANGULAR",
        # A spring between neighbours is tension_stiffness / spacing. It carries a cell's width, and less
        # where many of them are on a rim.
        "tension_stiffness": stiffness * area / spacing * stretch,
        "compression_stiffness": stiffness * area / spacing * compression,
        # Springs along both diagonals of a cell, of which the one that shortens is slack.
        "shear_stiffness": stiffness * 2.0 * spacing * SHEAR,
        # An edge turns with 0.1 * bending_stiffness * edge, at half a cell from its neighbours.
        "bending_stiffness": stiffness * 20.0 * bending / spacing**2,
        "tension_damping": 5.0 * damping,
        "compression_damping": 5.0 * damping,
        "shear_damping": 5.0 * damping,
        "bending_damping": 0.5 * damping,
        # Drag is 0.01 * air_damping, of a vertex.
        "air_damping": 100.0 * drag * UNIT_OF_TIME,
    }


def measure(cloth):
    """Returns spacing, area per vertex and the share of faces that are no quads, of a mesh object."""
    import bpy

    mesh = cloth.data.copy()
    mesh.transform(cloth.matrix_world)
    positions = [vertex.co for vertex in mesh.vertices]
    lengths = [(positions[a] - positions[b]).length for a, b in (edge.vertices for edge in mesh.edges)]
    area = sum(face.area for face in mesh.polygons)
    triangles = sum(len(face.vertices) != 4 for face in mesh.polygons)
    spacing = sum(lengths) / max(1, len(lengths))
    measures = (spacing, area / max(1, len(positions)), triangles / max(1, len(mesh.polygons)))
    bpy.data.meshes.remove(mesh)
    return measures


def apply(cloth, frame_rate=24.0):
    """Sets the cloth modifier of a mesh object, which gets one if it has none."""
    spacing, area, triangles = measure(cloth)
    if not (spacing > 0.0 and area > 0.0):
        raise ValueError(f"{cloth.name} has no faces")
    if triangles > 0.1:
        print(
            f"{cloth.name}: {100 * triangles:.0f} % of the faces are no quads. Sides of triangles stretch like"
            " yarns and keep the cloth from shearing: make quads of them first (Alt J)."
        )
    modifiers = [modifier for modifier in cloth.modifiers if modifier.type == "CLOTH"]
    modifier = modifiers[0] if modifiers else cloth.modifiers.new(NAME, "CLOTH")
    for name, value in settings(spacing, area, frame_rate).items():
        setattr(modifier.settings, name, value)
    # Blender keeps layers of cloth at least a millimetre apart.
    modifier.collision_settings.self_distance_min = max(0.001, THICKNESS)
    print(f"{cloth.name}: {NAME}, for edges of {1000 * spacing:.1f} mm, {modifier.settings.quality} steps a frame")


def main():
    import bpy

    meshes = [thing for thing in bpy.context.selected_objects if thing.type == "MESH"]
    if not meshes:
        meshes = [
            thing
            for thing in bpy.context.scene.objects
            if thing.type == "MESH" and any(modifier.type == "CLOTH" for modifier in thing.modifiers)
        ]
    if not meshes:
        raise SystemExit("select a mesh, or give one a cloth modifier")
    render = bpy.context.scene.render
    for cloth in meshes:
        apply(cloth, render.fps / render.fps_base)


if __name__ == "__main__":
    main()
