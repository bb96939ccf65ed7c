#!/usr/bin/env python3
"""Writes still_life.gltf, still_life.bin and three pictures beside it: things of several materials on a table."""
import json
import math
import struct
import sys
import zlib
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.append(str(here / "../../tests/assets/scenes"))
from make_teapot_scene import Buffer, light, node, read_teapot, shining, smooth_normals, stand_on_plane, subtract

SIDE = 256  # texels of each picture


# ---- Pictures ----------------------------------------------------------------------------------------------

def write_png(name, texel):
    """Three channels of 8 bits; texel(u, v) gives numbers from 0 to 1, of which each texel is the mean of nine."""
    rows = b""
    for y in range(SIDE):
        colors = []
        for x in range(SIDE):
            nine = [texel((x + (i % 3 + 0.5) / 3) / SIDE, (y + (i // 3 + 0.5) / 3) / SIDE) for i in range(9)]
            colors.append([sum(channel) / 9 for channel in zip(*nine)])
        rows += b"\0" + bytes(round(255 * min(max(c, 0), 1)) for color in colors for c in color)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    (here / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                              chunk(b"IEND", b""))


def noise(u, v, cells, seed):
    """Smooth, between 0 and 1, repeated after 1 in u and in v."""
    def corner(i, j):
        return zlib.crc32(f"{i % cells[0]},{j % cells[1]},{seed}".encode()) / 0xFFFFFFFF

    x, y = u * cells[0], v * cells[1]
    i, j = math.floor(x), math.floor(y)
    s, t = (f * f * (3 - 2 * f) for f in (x - i, y - j))
    low = corner(i, j) * (1 - s) + corner(i + 1, j) * s
    high = corner(i, j + 1) * (1 - s) + corner(i + 1, j + 1) * s
    return low * (1 - t) + high * t


PLANKS = 4


def grain(u, v):
    """How dark the wood is, 0 to 1, and how near the joint between two planks."""
    plank = math.floor(v * PLANKS)
    across = v * PLANKS - plank
    shift = 0.37 * plank
    rings = noise(u + shift, v, (3, 24), plank) + 0.5 * noise(u + shift, v, (6, 96), 7 + plank)
    joint = min(across, 1 - across)
    return 0.5 + 0.5 * math.sin(9 * rings) * 0.6 + 0.2 * (noise(u, v, (16, 128), 3) - 0.5), joint


def wood_color(u, v):
    dark, joint = grain(u, v)
    tone = 0.9 + 0.2 * (zlib.crc32(str(math.floor(v * PLANKS)).encode()) % 100 / 100)
    shade = (0.3 if joint < 0.012 else 1) * tone
    return [shade * (light_ + (dark_ - light_) * dark) for light_, dark_ in ((0.60, 0.38), (0.42, 0.24), (0.28, 0.14))]


def wood_normal(u, v):
    step = 1 / SIDE

    def height(x, y):
        dark, joint = grain(x % 1, y % 1)
        return -0.15 * dark - (0.5 if joint < 0.012 else 0)

    slope = [height(u - step, v) - height(u + step, v), height(u, v - step) - height(u, v + step), 1]
    length = math.sqrt(sum(s * s for s in slope))
    return [0.5 + 0.5 * s / length for s in slope]


def is_gilt(u, v):
    """A band of lozenges between two lines."""
    if 0.30 < v < 0.33 or 0.67 < v < 0.70:
        return True
    return abs((u * 12) % 1 - 0.5) + abs(v - 0.5) / 0.3 < 0.34


def glaze_color(u, v):
    if is_gilt(u, v):
        return [1.0, 0.86, 0.57]
    return [0.05, 0.16, 0.42] if 0.33 < v < 0.67 else [0.93, 0.92, 0.88]


def glaze_surface(u, v):
    """Green is roughness, blue is metallic."""
    return [1, 0.28, 1] if is_gilt(u, v) else [1, 0.12, 0]


# ---- Meshes ------------------------------------------------------------------------------------------------

def lathe(outline, segments=72):
    """Turns points (radius, height) from the foot up about the axis; a point that stands twice is an edge."""
    positions, normals, places, tangents, triangles = [], [], [], [], []
    lengths = [0]
    for (r0, y0), (r1, y1) in zip(outline, outline[1:]):
        lengths.append(lengths[-1] + math.hypot(r1 - r0, y1 - y0))

    def slope(i):
        def along(a, b):
            return (outline[b][0] - outline[a][0], outline[b][1] - outline[a][1])
        before = along(i - 1, i) if i > 0 else (0, 0)
        after = along(i, i + 1) if i + 1 < len(outline) else (0, 0)
        if before == (0, 0) or after == (0, 0):
            return before if after == (0, 0) else after
        return (before[0] + after[0], before[1] + after[1])

    for i, (radius, height) in enumerate(outline):
        dr, dy = slope(i)
        size = math.hypot(dr, dy)
        for j in range(segments + 1):
            angle = 2 * math.pi * j / segments
            c, s = math.cos(angle), math.sin(angle)
            positions.append([radius * c, height, -radius * s])
            normals.append([dy / size * c, -dr / size, -dy / size * s])
            places.append([j / segments, 1 - lengths[i] / lengths[-1]])
            tangents.append([-s, 0, -c, 1])
    for i in range(len(outline) - 1):
        if outline[i] == outline[i + 1]:
            continue
        for j in range(segments):
            a = i * (segments + 1) + j
            b = a + segments + 1
            triangles += [t for t in ([a, a + 1, b + 1], [a, b + 1, b]) if len({tuple(positions[k]) for k in t}) == 3]
    return positions, normals, places, tangents, triangles


def sphere(radius, segments=64):
    rings = segments // 2
    return lathe([(radius * math.sin(math.pi * i / rings) if 0 < i < rings else 0,
                   radius - radius * math.cos(math.pi * i / rings)) for i in range(rings + 1)], segments)


def rounded(points, steps=6):
    """A smooth line through some points (Catmull and Rom)."""
    line = []
    for i in range(len(points) - 1):
        p = [points[max(i - 1, 0)], points[i], points[i + 1], points[min(i + 2, len(points) - 1)]]
        for k in range(steps):
            t = k / steps
            line.append(tuple(max(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t +
                                         (3 * b - a - 3 * c + d) * t ** 3), 0) for a, b, c, d in zip(*p)))
    return line + [points[-1]]


VASE = rounded([(0.001, 0), (0.34, 0.0), (0.36, 0.04), (0.62, 0.45), (0.66, 0.85), (0.46, 1.35), (0.24, 1.65), (0.25, 1.85), (0.33, 1.98)])
CUP = ([(0.001, 0), (0.48, 0), (0.48, 0), (0.5, 0.02), (0.5, 1.0), (0.5, 1.0), (0.46, 1.0), (0.46, 1.0), (0.46, 0.06), (0.46, 0.06), (0.001, 0.06)])


def primitive(buffer, mesh, material, has_tangents=False):
    positions, normals, places, tangents, triangles = mesh
    attributes = {"POSITION": buffer.add(positions, "VEC3"), "NORMAL": buffer.add(normals, "VEC3")}
    if places:
        attributes["TEXCOORD_0"] = buffer.add(places, "VEC2")
    if has_tangents:
        attributes["TANGENT"] = buffer.add(tangents, "VEC4")
    return {"primitives": [{"attributes": attributes, "indices": buffer.add([i for t in triangles for i in t], "SCALAR"),
                            "material": material}]}


class Rows(Buffer):
    """Vectors of other lengths than three have no bounds."""
    def add(self, rows, shape):
        if shape in ("SCALAR", "VEC3"):
            return super().add(rows, shape)
        number = super().add([row[:3] if len(row) > 2 else row + [0] for row in rows[:1]], "VEC3")
        self.content = self.content[:self.views[-1]["byteOffset"]]
        data = struct.pack(f"<{sum(map(len, rows))}f", *(x for row in rows for x in row))
        self.views[-1]["byteLength"] = len(data)
        self.accessors[-1] = {"bufferView": len(self.views) - 1, "componentType": 5126, "count": len(rows), "type": shape}
        self.content += data
        return number


# ---- The scene ---------------------------------------------------------------------------------------------

def material(name, color, metallic, roughness, **more):
    factors = {"baseColorFactor": [*color, 1] if len(color) == 3 else color, "metallicFactor": metallic, "roughnessFactor": roughness}
    factors.update(more.pop("textures", {}))
    return {"name": name, "pbrMetallicRoughness": factors, **more}


def main():
    write_png("wood.png", wood_color)
    write_png("wood_normal.png", wood_normal)
    write_png("glaze.png", glaze_color)
    write_png("glaze_surface.png", glaze_surface)
    buffer = Rows()
    positions, triangles = read_teapot()
    positions = stand_on_plane(positions)
    positions = [[0.72 * x for x in p] for p in positions]
    teapot = (positions, smooth_normals(positions, triangles), None, None, triangles)
    size = 9
    table = ([[-size, 0, size], [size, 0, size], [size, 0, -size], [-size, 0, -size]], [[0, 1, 0]] * 4,
             [[0, 4], [4, 4], [4, 0], [0, 0]], None, [[0, 1, 2], [0, 2, 3]])
    meshes = [primitive(buffer, table, 0), primitive(buffer, teapot, 1), primitive(buffer, sphere(0.42), 2),
              primitive(buffer, lathe(CUP), 3, has_tangents=True), primitive(buffer, lathe(VASE), 4),
              primitive(buffer, sphere(0.34, 48), 5), primitive(buffer, sphere(0.16, 32), 6)]
    materials = [
        material("wood", [1, 1, 1], 0, 0.42, textures={"baseColorTexture": {"index": 0}}, normalTexture={"index": 1, "scale": 0.8}),
        material("lacquer", [0.45, 0.012, 0.02], 0, 0.5, extensions={"KHR_materials_clearcoat": {
            "clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.03}}),
        material("gold", [1, 0.78, 0.36], 1, 0.26),
        material("brushed steel", [0.76, 0.76, 0.78], 1, 0.32, doubleSided=True, extensions={"KHR_materials_anisotropy": {
            "anisotropyStrength": 0.75}}),
        material("gilt porcelain", [1, 1, 1], 1, 1, textures={"baseColorTexture": {"index": 2},
                                                              "metallicRoughnessTexture": {"index": 3}}),
        material("glass", [0.7, 0.88, 1, 0.3], 0, 0.04, alphaMode="BLEND"),
        material("ember", [0.02, 0.01, 0.01], 0, 0.6, emissiveFactor=[1, 0.24, 0.03],
                 extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 2}})]
    eye, target, spot = [0.15, 2.35, 7.0], [0.05, 0.72, 0], [-4.2, 6.2, 3.6]
    lights = [light("spot", name="window", color=[1, 0.93, 0.82], intensity=230,
                    spot={"innerConeAngle": 0.28, "outerConeAngle": 0.42}, extras={"gobo": {"shadow": True}}),
              light("point", name="ember", color=[1, 0.36, 0.09], intensity=1.6)]
    ember = [1.62, 0.17, 1.75]
    nodes = [node("table", mesh=0), node("teapot", [-0.35, 0, 0.1], mesh=1, rotation=[0, 0.1736482, 0, 0.9848078]),
             node("gold ball", [0.95, 0, 1.25], mesh=2), node("cup", [2.15, 0, 0.25], mesh=3), node("vase", [-2.35, 0, -0.55], mesh=4),
             node("glass ball", [-1.75, 0, 1.35], mesh=5), node("ember ball", [ember[0], 0, ember[2]], mesh=6),
             node("window", spot, subtract([0.0, 0.5, 0.2], spot), **shining(0)),
             node("light of the ember", [ember[0], 0.5, ember[2]], **shining(1)),
             node("camera", eye, subtract(target, eye), camera=0)]
    scene = {
        "asset": {"version": "2.0", "generator": "make_scene.py"},
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_emissive_strength"],
        "extensions": {"KHR_lights_punctual": {"lights": lights}},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes))), "extras": {"gobo": {
            "probe": {"kind": "image", "share": 1}, "reflection": 1, "background": [0.012, 0.014, 0.018],
            "fog": {"kind": "linear", "color": [0.012, 0.014, 0.018], "near": 8, "far": 15}}}}],
        "nodes": nodes,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.41, "znear": 0.5, "zfar": 60}}],
        "materials": materials,
        "textures": [{"source": i} for i in range(4)],
        "images": [{"uri": uri} for uri in ("wood.png", "wood_normal.png", "glaze.png", "glaze_surface.png")],
        "meshes": meshes,
        "buffers": [{"uri": "still_life.bin", "byteLength": len(buffer.content)}],
        "bufferViews": buffer.views,
        "accessors": buffer.accessors,
    }
    (here / "still_life.bin").write_bytes(buffer.content)
    (here / "still_life.gltf").write_text(json.dumps(scene, indent=1) + "\n")


if __name__ == "__main__":
    main()
