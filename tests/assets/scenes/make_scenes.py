#!/usr/bin/env python3
"""Writes the small scenes of made/: each needs something of its own. Their shapes are in made/shapes.bin, those with
colours, texture coordinates or morph targets in made/colored_shapes.bin."""
import base64
import json
import math
import struct
import zlib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "made"


def sphere(slices=16, stacks=8):
    positions = [[math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b)]
                 for a in (math.pi * i / stacks for i in range(stacks + 1))
                 for b in (2 * math.pi * j / slices for j in range(slices + 1))]
    row = slices + 1
    triangles = []
    for i in range(stacks):
        for j in range(slices):
            a, b = i * row + j, (i + 1) * row + j
            triangles += [[a, a + 1, b], [a + 1, b + 1, b]]
    return positions, positions, triangles


def box():
    positions, normals, triangles = [], [], []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner, normal = [0, 0, 0], [0, 0, 0]
                corner[axis], corner[u], corner[v], normal[axis] = sign, a * sign, b, sign
                positions.append(corner)
                normals.append(normal)
            triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    return positions, normals, triangles


def plane(cells=8):
    steps = [2 * i / cells - 1 for i in range(cells + 1)]
    positions = [[x, 0, z] for z in steps for x in steps]
    row = cells + 1
    triangles = []
    for i in range(cells):
        for j in range(cells):
            a = i * row + j
            triangles += [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]
    return positions, [[0, 1, 0]] * len(positions), triangles


class Shapes:
    """A buffer that several scenes share."""

    def __init__(self, name):
        self.name = name
        self.content, self.views, self.accessors, self.meshes = b"", [], [], {}

    def accessor(self, data, code, kind, count):
        self.views.append({"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)})
        self.content += data + b"\0" * (-len(data) % 4)
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": code, "count": count, "type": kind})
        return len(self.accessors) - 1

    def vectors(self, rows, bounds=False):
        index = self.accessor(struct.pack(f"<{3 * len(rows)}f", *[x for row in rows for x in row]), 5126, "VEC3", len(rows))
        if bounds:
            self.accessors[index]["min"] = [min(r[k] for r in rows) for k in range(3)]
            self.accessors[index]["max"] = [max(r[k] for r in rows) for k in range(3)]
        return index

    def add(self, name, shape):
        positions, normals, triangles = shape
        indices = [i for t in triangles for i in t]
        self.meshes[name] = {"attributes": {"POSITION": self.vectors(positions, True), "NORMAL": self.vectors(normals)},
                             "indices": self.accessor(struct.pack(f"<{len(indices)}H", *indices), 5123, "SCALAR", len(indices))}

    def add_attribute(self, name, attribute, rows, code=5126):
        """Of a shape that was added; colours are bytes."""
        letter = "f" if code == 5126 else "B"
        data = struct.pack(f"<{len(rows) * len(rows[0])}{letter}", *[x for row in rows for x in row])
        index = self.accessor(data, code, f"VEC{len(rows[0])}", len(rows))
        if code != 5126:
            self.accessors[index]["normalized"] = True
        self.meshes[name]["attributes"][attribute] = index

    def add_target(self, name, positions, normals):
        """Displacements, one for each vertex."""
        target = {"POSITION": self.vectors(positions, True), "NORMAL": self.vectors(normals)}
        self.meshes[name].setdefault("targets", []).append(target)


def quaternion(direction):
    """The rotation that takes -z to a direction."""
    length = math.sqrt(sum(x * x for x in direction))
    x, y, z = (-c / length for c in direction)
    if z < -0.999999:
        return [0, 1, 0, 0]
    half = math.sqrt(2 * (1 + z))
    return [round(-y / half, 7), round(x / half, 7), 0, round(half / 2, 7)]


class SceneFile:
    def __init__(self, shapes, **gobo):
        self.shapes, self.gobo = shapes, gobo
        self.nodes, self.lights, self.materials, self.meshes = [], [], [], []
        self.members = {}  # of the file, beside what all have

    def material(self, base=(0.8, 0.8, 0.8), metallic=0, roughness=0.95, gobo=None, texture=None, **members):
        pbr = {"baseColorFactor": [*base, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            pbr["baseColorTexture"] = {"index": texture}
        extras = {"extras": {"gobo": gobo}} if gobo else {}
        self.materials.append({"pbrMetallicRoughness": pbr, **extras, **members})
        return len(self.materials) - 1

    def mesh(self, shape, material):
        mesh = {"primitives": [{**self.shapes.meshes[shape], "material": material}]}
        if mesh not in self.meshes:
            self.meshes.append(mesh)
        return self.meshes.index(mesh)

    def put(self, name, shape, material, at=(0, 0, 0), scale=(1, 1, 1), gobo=None, **members):
        extras = {"extras": {"gobo": gobo}} if gobo else {}
        self.nodes.append({"name": name, "mesh": self.mesh(shape, material), "translation": list(at), "scale": list(scale),
                           **extras, **members})

    def light(self, kind, at=(0, 0, 0), toward=None, gobo=None, **members):
        extras = {"extras": {"gobo": gobo}} if gobo else {}
        self.lights.append({"type": kind, **members, **extras})
        node = {"name": f"{kind} light", "translation": list(at), "extensions": {"KHR_lights_punctual": {"light": len(self.lights) - 1}}}
        if toward:
            node["rotation"] = quaternion(toward)
        self.nodes.append(node)

    def camera(self, at, toward):
        self.nodes.append({"name": "camera", "translation": list(at), "rotation": quaternion(toward), "camera": 0})

    def write(self, name, camera=None):
        camera = camera or {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 100}}
        roots = [i for i in range(len(self.nodes)) if not any(i in n.get("children", []) for n in self.nodes)]
        scene = {"nodes": roots, "extras": {"gobo": {"ambient": [0.05, 0.05, 0.06], **self.gobo}}}
        gltf = {"asset": {"version": "2.0", "generator": "make_scenes.py"}, "scene": 0, "scenes": [scene], "nodes": self.nodes,
                "meshes": self.meshes, "materials": self.materials, "cameras": [camera],
                "buffers": [{"uri": self.shapes.name, "byteLength": len(self.shapes.content)}],
                "bufferViews": self.shapes.views, "accessors": self.shapes.accessors}
        gltf.update(self.members)
        if self.lights:
            gltf["extensionsUsed"] = ["KHR_lights_punctual", *gltf.get("extensionsUsed", [])]
            gltf["extensions"] = {"KHR_lights_punctual": {"lights": self.lights}}
        (FOLDER / f"{name}.gltf").write_text(json.dumps(gltf) + "\n")


SOFT = {"attenuation": [1, 0, 0.2]}
WARM, COLD = [1, 0.8, 0.6], [0.5, 0.7, 1]


def room(shapes, **gobo):
    """A ball and a box on a floor, seen from the front."""
    scene = SceneFile(shapes, **gobo)
    scene.put("floor", "plane", scene.material((0.6, 0.6, 0.6)), scale=(4, 1, 4))
    scene.put("ball", "sphere", scene.material((0.7, 0.3, 0.2), roughness=0.5), at=(-1.2, 1, 0))
    scene.put("box", "box", scene.material((0.2, 0.4, 0.7), metallic=0.8, roughness=0.6), at=(1.5, 0.8, 0.3), scale=(0.8, 0.8, 0.8))
    scene.camera((0, 2.5, 7), (0, -0.2, -1))
    return scene


def write_all(shapes):
    scene = room(shapes)
    scene.light("directional", toward=(-1, -1, -0.5), color=WARM)
    scene.write("sun")

    scene = room(shapes)
    scene.light("point", (0, 3, 1), color=COLD, intensity=6)
    scene.write("bulb")

    scene = room(shapes)
    scene.light("spot", (0, 4, 2), (-0.3, -1, -0.5), intensity=20, spot={"innerConeAngle": 0.3, "outerConeAngle": 0.6})
    scene.write("stage_light")

    scene = room(shapes)
    scene.light("spot", (-3, 3, 1), (1, -1.2, -0.4), intensity=9, gobo={"exponent": 20}, spot={"outerConeAngle": 0.25})
    scene.light("spot", (3, 5, 1), (-0.3, -1, -0.1), intensity=9, spot={"innerConeAngle": 0.1, "outerConeAngle": 0.2})
    scene.write("narrow_spots")

    scene = room(shapes)
    for x in (-9, -3, 3, 9):  # the outer ones do not reach
        scene.light("point", (x, 1.5, 1.5), intensity=0.8, range=4)
    scene.write("ranges")

    scene = room(shapes)
    scene.light("directional", toward=(0, 1, 0), color=COLD)  # from below: the floor faces away
    scene.light("point", (0, -1.5, 0), intensity=3)
    scene.write("from_below")

    scene = room(shapes)
    scene.light("directional", toward=(1, -1, -1), intensity=0)
    scene.light("directional", toward=(1, -2, -1), color=WARM, intensity=0.7)
    scene.light("directional", toward=(-1, -1, -1), color=COLD, intensity=0.4)
    scene.write("one_light_off")

    fog = {"kind": "linear", "near": 5, "far": 14, "color": [0.5, 0.6, 0.7]}
    scene = room(shapes, fog=fog)
    scene.light("point", (1, 3, 2), intensity=5, gobo=SOFT)
    scene.write("linear_fog")

    scene = room(shapes, fog={"kind": "exponential", "density": 0.08, "color": [0.3, 0.3, 0.35]})
    scene.light("directional", toward=(-0.4, -1, -0.3))
    scene.write("haze")

    scene = room(shapes, fog={"kind": "exponential_squared", "density": 0.09, "color": [0.2, 0.25, 0.3]})
    scene.light("directional", toward=(-0.4, -1, -0.3))
    scene.light("point", (-2, 1, 2), color=WARM, intensity=2)
    scene.write("mist")

    scene = room(shapes, fog={"kind": "linear", "near": 60, "far": 90, "color": [1, 1, 1]})  # too far away to matter
    scene.light("directional", toward=(-0.4, -1, -0.3))
    scene.write("distant_fog")

    scene = room(shapes, toon=4)
    scene.light("directional", toward=(-0.6, -1, -0.8))
    scene.light("spot", (2, 4, 3), (-0.3, -1, -0.6), intensity=12, spot={"outerConeAngle": 0.5})
    scene.write("toon")

    scene = room(shapes, specular="phong")
    scene.light("directional", toward=(-0.6, -1, -0.8))
    scene.light("point", (0, 2, 3), color=COLD, intensity=2)
    scene.write("phong")

    scene = room(shapes, fog=fog)
    glow = scene.material((1, 0.9, 0.5), extensions={"KHR_materials_unlit": {}}, gobo={"fog": {"kind": "none"}})
    scene.put("lamp", "sphere", glow, at=(0, 2.5, 0), scale=(0.2, 0.2, 0.2))
    scene.light("point", (0, 2.5, 0), color=WARM, intensity=4)
    scene.write("lamp")

    scene = SceneFile(shapes)
    glossy = [scene.material((0.9, 0.9, 0.9), metallic=1, roughness=r) for r in (0.2, 0.4, 0.6, 0.8, 1)]
    for i, material in enumerate(glossy):
        scene.put(f"ball {i}", "sphere", material, at=(2.2 * i - 4.4, 0, 0))
    scene.light("directional", toward=(-0.3, -0.6, -1))
    scene.light("point", (0, 3, 2), intensity=2)
    scene.camera((0, 0, 13), (0, 0, -1))
    scene.write("roughness")

    scene = room(shapes)  # one mesh, several times, under nodes that turn, stretch and mirror
    marble = scene.material((0.7, 0.7, 0.75), roughness=0.3)
    first = len(scene.nodes)
    scene.put("egg", "sphere", marble, at=(0, 1, 0), scale=(0.3, 0.7, 0.3))
    scene.put("disc", "sphere", marble, at=(1, 0.2, 0), scale=(0.5, 0.05, 0.5), rotation=[0.2, 0, 0.1, 0.9746794])
    scene.put("mirrored", "box", marble, at=(-1, 0.5, 0), scale=(-0.3, 0.3, 0.3))
    scene.nodes.append({"name": "group", "translation": [0, 0.5, 2.5], "rotation": [0, 0.3826834, 0, 0.9238795],
                        "scale": [1, 1.5, 1], "children": [first, first + 1, first + 2]})
    scene.light("directional", toward=(-1, -1, -0.5))
    scene.light("point", (0, 2, 4), intensity=1.5)
    scene.write("instances")

    scene = room(shapes)  # as many lights as the ubershader holds
    for i in range(6):
        angle = math.pi * i / 3
        scene.light("point", (4 * math.cos(angle), 1.5, 4 * math.sin(angle)), color=[WARM, COLD][i % 2], intensity=1.5)
    for x in (-2, 2):
        scene.light("spot", (x, 4, 3), (-x / 4, -1, -0.6), intensity=6, spot={"outerConeAngle": 0.45})
    scene.light("directional", toward=(0, -1, -0.2), color=COLD, intensity=0.1)
    scene.light("directional", toward=(1, -1, 0), color=WARM, intensity=0.1)
    scene.write("ten_lights")

    scene = room(shapes)
    scene.put("curtain", "plane", scene.material((0.8, 0.2, 0.2), doubleSided=True), at=(0, 1, -2), scale=(2, 1, 1),
              rotation=[0.7071068, 0, 0, 0.7071068])
    scene.light("point", (0, 2, -4), intensity=4)
    scene.light("directional", toward=(0, -1, -0.6), intensity=0.5)
    scene.write("curtain")

    scene = room(shapes)
    scene.light("spot", (0, 5, 0), (0, -1, 0), intensity=8, spot={"outerConeAngle": 1.5707963})
    scene.write("half_space", {"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 3, "znear": 0.1, "zfar": 30}})


def lattice():
    """A picture of 8 by 8 pixels, white, opaque but for a round hole, as a data URI."""
    rows = b""
    for y in range(8):
        rows += b"\0"
        for x in range(8):
            rows += bytes([255, 255, 255, 255 if math.hypot(x - 3.5, y - 3.5) > 2.6 else 0])

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 8, 8, 8, 6, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows, 9))
    return "data:image/png;base64," + base64.b64encode(png + chunk(b"IEND", b"")).decode()


def add_colored(shapes):
    steps = range(9)
    grid = [(x, z) for z in steps for x in steps]
    shapes.add("striped", plane())
    shapes.add_attribute("striped", "COLOR_0", [[255, 40 * (x % 3), 255 - 30 * z] for x, z in grid], 5121)
    shapes.add("chalk", plane())
    shapes.add_attribute("chalk", "COLOR_0", [[255, 255, 255]] * len(grid), 5121)
    shapes.add("holed", plane())
    shapes.add_attribute("holed", "COLOR_0", [[255, 255, 255, 0 if x % 4 == 2 and z % 4 == 2 else 255] for x, z in grid], 5121)
    shapes.add("tiled", plane())
    shapes.add_attribute("tiled", "TEXCOORD_0", [[x / 2, z / 2] for x, z in grid])
    shapes.add("bent", plane())
    heights = [0.5 * (x / 4 - 1) ** 2 for x, z in grid]
    slopes = [x / 4 - 1 for x, z in grid]
    lengths = [math.sqrt(1 + s * s) for s in slopes]
    shapes.add_target("bent", [[0, h, 0] for h in heights],
                      [[-s / n, 1 / n - 1, 0] for s, n in zip(slopes, lengths)])


UPRIGHT = [0.7071068, 0, 0, 0.7071068]


def write_surfaces(shapes):
    """What a surface itself needs: colours, holes, morphed normals, instances."""
    scene = room(shapes)
    scene.put("banner", "striped", scene.material(), at=(0, 1.2, -2), scale=(2, 1, 1), rotation=UPRIGHT)
    scene.put("board", "chalk", scene.material((0.3, 0.5, 0.3)), at=(-3, 1, -1), scale=(0.8, 1, 0.8), rotation=UPRIGHT)
    scene.light("directional", toward=(-0.3, -0.6, -1), color=WARM)
    scene.write("vertex_colors")

    scene = room(shapes)
    holed = scene.material((0.3, 0.6, 0.3), alphaMode="MASK", doubleSided=True)
    scene.put("screen", "holed", holed, at=(0, 1.5, 2.2), scale=(2, 1, 1), rotation=UPRIGHT)
    scene.put("shutter", "plane", scene.material(alphaMode="MASK"), at=(-3, 1, -1), rotation=UPRIGHT)  # nothing is cut
    scene.light("directional", toward=(-0.3, -0.6, -1))
    scene.light("point", (1, 2, -3), color=WARM, intensity=3)
    scene.write("perforated")

    scene = room(shapes)
    scene.members = {"images": [{"uri": lattice()}], "textures": [{"source": 0}]}
    leaf = scene.material((0.4, 0.7, 0.3), alphaMode="MASK", doubleSided=True, alphaCutoff=0.4, texture=0)
    scene.put("leaves", "tiled", leaf, at=(0, 1.5, 2.2), scale=(2, 1, 1), rotation=UPRIGHT)
    scene.light("directional", toward=(-0.3, -0.6, -1))
    scene.write("leaves")

    scene = room(shapes)
    scene.put("awning", "bent", scene.material((0.8, 0.5, 0.3), roughness=0.5), at=(0, 2.5, -1.5), scale=(2, 1, 1), weights=[0.8])
    scene.light("directional", toward=(-0.5, -1, -0.2))
    scene.light("point", (0, 4, 0), color=COLD, intensity=2)
    scene.write("morphed_normals")

    scene = room(shapes)
    at = [[1.4 * i - 3.5, 0.3, -2 - 0.4 * (i % 2)] for i in range(6)]
    turns = [[0, math.sin(0.2 * i), 0, math.cos(0.2 * i)] for i in range(6)]
    sizes = [[0.2 + 0.05 * i, 0.3, 0.2] for i in range(6)]
    shapes.add("posts", box())
    columns = {}
    for name, rows in (("TRANSLATION", at), ("ROTATION", turns), ("SCALE", sizes)):
        shapes.add_attribute("posts", name, rows)
        columns[name] = shapes.meshes["posts"]["attributes"].pop(name)
    scene.put("fence", "posts", scene.material((0.5, 0.35, 0.2), roughness=0.6),
              extensions={"EXT_mesh_gpu_instancing": {"attributes": columns}})
    scene.members = {"extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"]}
    scene.light("directional", toward=(-1, -1, -0.5))
    scene.light("point", (-1, 2, -1), color=WARM, intensity=2)
    scene.write("gpu_instances")


def write_surroundings(shapes):
    """What the light around needs: probes, reflections, shadows."""
    black = {"model": {"diffuse": [0, 0, 0], "specular": [0.5, 0.5, 0.5], "shininess": 20}}
    scene = room(shapes, probe={"kind": "hemisphere", "sky": [0.4, 0.5, 0.7], "ground": [0.25, 0.2, 0.15]})
    scene.put("coal", "sphere", scene.material(gobo=black), at=(0, 0.4, 2), scale=(0.4, 0.4, 0.4))  # gives no ambient light back
    scene.light("directional", toward=(-1, -1, -0.5), color=WARM, intensity=0.4)
    scene.write("open_sky")

    rows = [[0.79, 0.44, 0.54], [0.39, 0.35, 0.60], [-0.34, -0.18, -0.27], [-0.29, -0.06, 0.01], [-0.11, -0.05, -0.12],
            [-0.26, -0.22, -0.47], [-0.16, -0.09, -0.15], [0.56, 0.21, 0.14], [0.21, -0.05, -0.30]]
    scene = room(shapes, probe={"kind": "spherical_harmonics", "coefficients": rows})
    scene.put("pearl", "sphere", scene.material(gobo={"probe": {"kind": "none"}}), at=(0, 0.5, 2), scale=(0.5, 0.5, 0.5))
    scene.write("harmonics")

    scene = room(shapes, probe={"kind": "image", "share": 0.7}, reflection=0.6)
    scene.light("point", (0, 3, 2), color=WARM, intensity=2)
    scene.write("studio")

    scene = room(shapes)
    scene.light("directional", toward=(-1, -1.2, -0.5), color=WARM, gobo={"shadow": True})
    scene.light("directional", toward=(1, -1, -0.5), color=COLD, intensity=0.3)
    scene.write("sun_shadow")

    scene = room(shapes)
    scene.light("point", (0, 1, 3), color=WARM, intensity=0.6)  # casts none
    scene.light("point", (0, 3.5, 0.5), color=COLD, intensity=3, gobo={"shadow": True})
    scene.light("spot", (3, 4, 3), (-0.7, -1, -0.8), intensity=12, spot={"outerConeAngle": 0.5}, gobo={"shadow": True})
    scene.light("spot", (-3, 4, 3), (0.5, -1, -0.8), intensity=6, spot={"outerConeAngle": 0.4}, gobo={"shadow": True})
    scene.put("lampshade", "plane", scene.material(gobo={"shadow": False}), at=(0, 0.02, 2.5), scale=(0.5, 1, 0.5))
    scene.write("lamp_shadows")


def main():
    FOLDER.mkdir(exist_ok=True)
    solids = (("plane", plane()), ("box", box()), ("sphere", sphere()))
    shapes, colored = Shapes("shapes.bin"), Shapes("colored_shapes.bin")
    for name, shape in solids:
        shapes.add(name, shape)
        colored.add(name, shape)
    add_colored(colored)
    write_all(shapes)
    write_surroundings(shapes)
    write_surfaces(colored)
    for each in (shapes, colored):
        (FOLDER / each.name).write_bytes(each.content)


main()
