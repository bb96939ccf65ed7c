#!/usr/bin/env bash
# vulkan_test.sh SOURCE_FOLDER PACKAGE_FOLDER: the example is built against gobo and draws, without a word of Vulkan's validation layer; both
# spheres come from the same SPIR-V and look different.
set -euo pipefail
source=$1
package=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake -S "$source/examples/vulkan" -B "$scratch/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D "gobo_DIR=$package" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build" --target spheres >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation "$scratch/build/spheres" "$scratch/spheres.png" | tee "$scratch/said"
grep -qi "validation\|VUID" "$scratch/said" && { echo "FAILED: the validation layer speaks"; exit 1; }
[ "$(grep -c "SPIR-V" "$scratch/said")" = 2 ]
[ "$(grep "point=3" "$scratch/said")" = "point=3 specular=blinn: the same SPIR-V" ]
python3 - "$scratch/spheres.png" <<'PYTHON'
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
width, height = struct.unpack(">II", data[16:24])
channels = {2: 3, 6: 4}[data[25]]
chunks, at = b"", 8
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    if kind == b"IDAT": chunks += data[at + 8:at + 8 + size]
    at += size + 12
raw, stride, rows, previous = zlib.decompress(chunks), channels * width, [], bytes(channels * width)
for y in range(height):
    kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
    for x in range(stride):
        left = x - channels
        a, b, c = line[left] if left >= 0 else 0, previous[x], previous[left] if left >= 0 else 0
        p = a + b - c
        paeth = a if abs(p - a) <= abs(p - b) and abs(p - a) <= abs(p - c) else b if abs(p - b) <= abs(p - c) else c
        line[x] = (line[x] + (0, a, b, (a + b) // 2, paeth)[kind]) % 256
    rows.append(bytes(line)); previous = line
pixel = lambda x, y: rows[y][channels * x:channels * x + 3]
assert (width, height) == (640, 320)
assert sum(pixel(130, 100)) > 2 * sum(pixel(190, 240)), "the first light shines from the upper left"
assert pixel(160 + 95, 160)[2] + 60 < pixel(480 + 95, 160)[2], "the second one is blue, at the right, of three alone"
assert pixel(2, 2) == pixel(637, 317), "the background is the same"
PYTHON
