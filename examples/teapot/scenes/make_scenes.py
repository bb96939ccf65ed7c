#!/usr/bin/env python3
"""Writes the six scenes beside it, and demo.bin with their meshes: a porcelain teapot on a chequered floor at night, under
moonlight, a spot from above and a lamp beside it. They differ in lights, fog, highlights, tones and quality alone."""
import json
import math
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here / "../../../tests/assets/scenes"))
from make_teapot_scene import (Buffer, cross, light, model, read_teapot, shining, smooth_normals, stand_on_plane,  # noqa: E402
                               subtract, unit)

NIGHT = [0.012, 0.022, 0.045]
LAMP, LAMP_COLOR, LAMP_INTENSITY = [2.0, 0.4, 1.9], [1, 1.7 / 4.2, 0.45 / 4.2], 4.2
EYE, SPOT = [-1.0, 2.9, 8.2], [2.6, 7.0, 3.4]
TILES, DIVISIONS = 40, 4


def turn_to(direction):
    """The rotation, as a quaternion, that takes -z to a direction and keeps x level."""
    z = [-x for x in unit(direction)]
    x = unit(cross([0, 1, 0], z))
    y = cross(z, x)
    w = math.sqrt(max(0, 1 + x[0] + y[1] + z[2])) / 2
    return [(y[2] - z[1]) / (4 * w), (z[0] - x[2]) / (4 * w), (x[1] - y[0]) / (4 * w), w]


def tile():
    """A square of side 1 at y = 0, divided, so that lights computed per vertex look right."""
    row = DIVISIONS + 1
    positions = [[x / DIVISIONS, 0, z / DIVISIONS] for z in range(row) for x in range(row)]
    triangles = []
    for z in range(DIVISIONS):
        for x in range(DIVISIONS):
            a = z * row + x
            triangles += [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]
    return positions, [[0, 1, 0]] * len(positions), triangles


def places(odd):
    """The tiles of one colour of the floor: column and row add up to an even number, or to an odd one."""
    half = TILES // 2
    return [[x, 0, z] for z in range(-half, half) for x in range(-half, half) if (x + z) % 2 == odd]


def sphere(radius, rings=16, sectors=32):
    angles = [(math.pi * i / rings, 2 * math.pi * j / sectors) for i in range(rings + 1) for j in range(sectors + 1)]
    normals = [[math.sin(a) * math.sin(b), math.cos(a), math.sin(a) * math.cos(b)] for a, b in angles]
    triangles = []
    for i in range(rings):
        for j in range(sectors):
            at = i * (sectors + 1) + j
            below = at + sectors + 1
            triangles += [[at, below, at + 1], [at + 1, below, below + 1]]
    return [[radius * x for x in n] for n in normals], normals, triangles


def make_meshes(buffer):
    """Teapot, light tiles, dark tiles, lamp; and where the tiles lie."""
    positions, triangles = read_teapot()
    positions = stand_on_plane(positions)
    shapes = [(positions, smooth_normals(positions, triangles), triangles), tile(), sphere(0.12)]
    ready = [{"attributes": {"POSITION": buffer.add(p, "VEC3"), "NORMAL": buffer.add(n, "VEC3")},
              "indices": buffer.add([i for t in ts for i in t], "SCALAR")} for p, n, ts in shapes]
    meshes = [{"primitives": [{**ready[shape], "material": material}]} for material, shape in ((0, 0), (1, 1), (2, 1), (3, 2))]
    return meshes, [buffer.add(places(odd), "VEC3") for odd in (0, 1)]


def glow():
    return {"name": "glow", "emissiveFactor": LAMP_COLOR, **model([0, 0, 0], [0, 0, 0], 0),
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": LAMP_INTENSITY}}}


def materials():
    grey = [0.1, 0.1, 0.1]
    return [{"name": "porcelain", **model([0.8, 0.78, 0.74], [0.9, 0.9, 0.9], 90)},
            {"name": "light stone", **model([0.36, 0.38, 0.42], grey, 24)},
            {"name": "dark stone", **model([0.09, 0.1, 0.13], grey, 24)}, glow()]


LIGHTS = [light("directional", name="moon", color=[0.26, 0.46, 0.95]),
          light("point", name="lamp", color=LAMP_COLOR, intensity=LAMP_INTENSITY,
                extras={"gobo": {"attenuation": [0.25, 0, 1]}}),
          light("spot", name="stage light", color=[1, 0.93, 0.8], intensity=1.55,
                spot={"innerConeAngle": math.radians(15), "outerConeAngle": math.radians(19)},
                extras={"gobo": {"attenuation": [1, 0, 0], "exponent": 6}})]


def nodes(lights, tiles):
    def floor(name, mesh, places):
        return {"name": name, "mesh": mesh, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}}

    half = math.radians(25) / 2
    result = [floor("light tiles", 1, tiles[0]), floor("dark tiles", 2, tiles[1]),
              {"name": "teapot", "mesh": 0, "rotation": [0, math.sin(half), 0, math.cos(half)]}]
    if "moon" in lights:
        result.append({"name": "moon", "rotation": turn_to([0.85, -0.42, -0.1]), **shining(0)})
    if "lamp" in lights:
        result.append({"name": "lamp", "translation": LAMP, "mesh": 3, **shining(1)})
    if "spot" in lights:
        result.append({"name": "stage light", "translation": SPOT, "rotation": turn_to(subtract([0, 0.5, 0], SPOT)), **shining(2)})
    result.append({"name": "camera", "translation": EYE, "rotation": turn_to(subtract([0.12, 0.8, 0], EYE)), "camera": 0})
    return result


def fog(kind):
    return {"fog": {"kind": kind, "color": NIGHT, "density": 0.075, "near": 8, "far": 17}}


ALL = {"moon", "lamp", "spot"}
SCENES = {
    "mist": (ALL, fog("exponential_squared")),
    "per_vertex": (ALL, {"quality": {"shading": "vertex"}}),
    "phong": (ALL, {"specular": "phong"}),
    "toon": (ALL, {"toon": 4, **fog("linear")}),
    "spot": ({"spot"}, fog("linear")),
    "moonlight": ({"moon"}, fog("exponential")),
}


def main():
    buffer = Buffer()
    meshes, tiles = make_meshes(buffer)
    (here / "demo.bin").write_bytes(buffer.content)
    for name, (lights, gobo) in SCENES.items():
        own = nodes(lights, tiles)
        scene = {
            "asset": {"version": "2.0", "generator": "make_scenes.py"},
            "extensionsUsed": ["EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_materials_emissive_strength"],
            "extensionsRequired": ["EXT_mesh_gpu_instancing"],
            "extensions": {"KHR_lights_punctual": {"lights": LIGHTS}},
            "scene": 0,
            "scenes": [{"nodes": list(range(len(own))),
                        "extras": {"gobo": {"ambient": [0.03, 0.04, 0.065], "background": NIGHT, **gobo}}}],
            "nodes": own,
            "cameras": [{"type": "perspective", "perspective": {"yfov": math.radians(27), "znear": 0.5, "zfar": 60}}],
            "materials": materials(),
            "meshes": meshes,
            "buffers": [{"uri": "demo.bin", "byteLength": len(buffer.content)}],
            "bufferViews": buffer.views,
            "accessors": buffer.accessors,
        }
        (here / f"{name}.gltf").write_text(json.dumps(scene, indent=1) + "\n")


main()
