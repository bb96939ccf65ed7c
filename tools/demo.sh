#!/usr/bin/env bash
# Sets up, builds gobo, has it compose, validate and emit the permutations of a demo scene, builds the example against the
# generated header and draws the scene. Leaves the header and PNG pictures in build/demo.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
gobo=build/release/bin/gobo
demo=build/demo

cmake --preset release
cmake --build --preset release --target gobo
mkdir -p "$demo"

echo "== The scene's permutations: composed, validated, emitted"
"$gobo" build lit --keys-from examples/teapot/teapot.keys -o "$demo"

echo "== The same teapot from its scene file alone: what each draw calls for, those permutations, the picture"
"$gobo" scene tests/assets/scenes/teapot.gltf
"$gobo" build lit --scene tests/assets/scenes/teapot.gltf -o "$demo/scene"
"$gobo" render --scene tests/assets/scenes/teapot.gltf --size 800x500 -o "$demo/scene"

echo "== The example, built against the header"
cmake -S examples/teapot -B "$demo/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D gobo_DIR="$PWD/build/release/cmake"
cmake --build "$demo/build"

echo "== The pictures, drawn by OSMesa"
"$demo/build/teapot" "$demo" data/meshes/teapot.obj

echo "Done. All six pictures together: $demo/teapots.png; the generated header: $demo/lit.hpp; from the scene file: $demo/scene/"
