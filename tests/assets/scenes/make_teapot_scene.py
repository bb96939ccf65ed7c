#!/usr/bin/env python3
"""Writes teapot.gltf and teapot.bin beside it: the teapot of data/meshes/teapot.obj, with smooth normals, on a plane."""
import json
import math
import struct
from pathlib import Path

here = Path(__file__).resolve().parent
HEIGHT = 2.0


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def read_teapot():
    """Vertices at one place are one: the teapot's patches repeat those along their seams."""
    positions, numbers, welded, triangles = [], {}, [], []
    for line in (here / "../../../data/meshes/teapot.obj").read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            positions.append(tuple(map(float, words[1:4])))
        if words[:1] == ["f"]:
            corners = []
            for word in words[1:]:
                position = positions[int(word.split("/")[0]) - 1]
                if position not in numbers:
                    numbers[position] = len(welded)
                    welded.append(position)
                corners.append(numbers[position])
            triangles += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    return welded, triangles


def smooth_normals(positions, triangles):
    """The cross product weighs each triangle by its area."""
    sums = [[0, 0, 0] for _ in positions]
    for a, b, c in triangles:
        normal = cross(subtract(positions[b], positions[a]), subtract(positions[c], positions[a]))
        for corner in (a, b, c):
            sums[corner] = [x + y for x, y in zip(sums[corner], normal)]
    return [unit(s) for s in sums]


def stand_on_plane(positions):
    low = [min(p[k] for p in positions) for k in range(3)]
    high = [max(p[k] for p in positions) for k in range(3)]
    foot = [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2]
    scale = HEIGHT / (high[1] - low[1])
    return [[x * scale for x in subtract(p, foot)] for p in positions]


def turn_to(direction):
    """The rotation, as a quaternion, that takes -z to a direction and keeps x level."""
    z = [-x for x in unit(direction)]
    x = unit(cross([0, 1, 0], z))
    y = cross(z, x)
    w = math.sqrt(max(0, 1 + x[0] + y[1] + z[2])) / 2
    quaternion = [(y[2] - z[1]) / (4 * w), (z[0] - x[2]) / (4 * w), (x[1] - y[0]) / (4 * w), w]
    return [round(q, 7) for q in quaternion]


class Buffer:
    def __init__(self):
        self.content, self.views, self.accessors = b"", [], []

    def add(self, rows, shape):
        """Vectors of floats, or single unsigned shorts. Returns the accessor's number."""
        is_index = shape == "SCALAR"
        numbers = rows if is_index else [x for row in rows for x in row]
        data = struct.pack(f"<{len(numbers)}{'H' if is_index else 'f'}", *numbers)
        self.views.append({"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)})
        accessor = {"bufferView": len(self.views) - 1, "componentType": 5123 if is_index else 5126,
                    "count": len(rows), "type": shape}
        if not is_index:
            accessor["min"] = [round(min(row[k] for row in rows), 6) for k in range(3)]
            accessor["max"] = [round(max(row[k] for row in rows), 6) for k in range(3)]
        self.accessors.append(accessor)
        self.content += data + b"\0" * (-len(data) % 4)
        return len(self.accessors) - 1


def primitive(buffer, positions, normals, triangles, material):
    return {"primitives": [{"attributes": {"POSITION": buffer.add(positions, "VEC3"), "NORMAL": buffer.add(normals, "VEC3")},
                            "indices": buffer.add([i for t in triangles for i in t], "SCALAR"), "material": material}]}


def light(kind, **members):
    return {"type": kind, **members}


def model(diffuse, specular, shininess):
    return {"extras": {"gobo": {"model": {"diffuse": diffuse, "ambient": diffuse, "specular": specular,
                                          "strength": 1, "shininess": shininess}}}}


def node(name, position=None, direction=None, **members):
    result = {"name": name}
    if position:
        result["translation"] = position
    if direction:
        result["rotation"] = turn_to(direction)
    return {**result, **members}


def shining(number):
    return {"extensions": {"KHR_lights_punctual": {"light": number}}}


def main():
    buffer = Buffer()
    positions, triangles = read_teapot()
    positions = stand_on_plane(positions)
    teapot = primitive(buffer, positions, smooth_normals(positions, triangles), triangles, 0)
    floor = primitive(buffer, [[-12, 0, 12], [12, 0, 12], [12, 0, -12], [-12, 0, -12]], [[0, 1, 0]] * 4,
                      [[0, 1, 2], [0, 2, 3]], 1)
    eye, spot = [-1.0, 2.9, 8.2], [2.6, 7.0, 3.4]
    lights = [light("directional", name="moon", color=[0.26, 0.46, 0.95]),
              light("point", name="lamp", color=[1, 0.405, 0.107], intensity=4.2,
                    extras={"gobo": {"attenuation": [0.25, 0, 1]}}),
              light("spot", name="stage light", color=[1, 0.93, 0.8], intensity=1.55,
                    spot={"innerConeAngle": 0.2617994, "outerConeAngle": 0.3316126},
                    extras={"gobo": {"attenuation": [1, 0, 0], "exponent": 6}})]
    nodes = [node("teapot", mesh=0, rotation=[0, 0.2164396, 0, 0.976296]), node("floor", mesh=1),
             node("moon", None, [0.85, -0.42, -0.10], **shining(0)), node("lamp", [2.0, 0.4, 1.9], **shining(1)),
             node("stage light", spot, subtract([0, 0.5, 0], spot), **shining(2)),
             node("camera", eye, subtract([0.12, 0.8, 0], eye), camera=0)]
    fog = {"kind": "linear", "color": [0.012, 0.022, 0.045], "near": 8, "far": 17}
    scene = {
        "asset": {"version": "2.0", "generator": "make_teapot_scene.py"},
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": lights}},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes))), "extras": {"gobo": {"ambient": [0.03, 0.04, 0.065], "fog": fog}}}],
        "nodes": nodes,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.4712389, "znear": 0.5, "zfar": 60}}],
        "materials": [{"name": "porcelain", **model([0.8, 0.78, 0.74], [0.9, 0.9, 0.9], 90)},
                      {"name": "stone", **model([0.36, 0.38, 0.42], [0, 0, 0], 0)}],
        "meshes": [teapot, floor],
        "buffers": [{"uri": "teapot.bin", "byteLength": len(buffer.content)}],
        "bufferViews": buffer.views,
        "accessors": buffer.accessors,
    }
    (here / "teapot.bin").write_bytes(buffer.content)
    (here / "teapot.gltf").write_text(json.dumps(scene, indent=1) + "\n")


if __name__ == "__main__":
    main()
