#!/usr/bin/env bash
# Sets up, builds gobo, has it compose, validate and emit the permutations that six scene files need, builds the example
# against the generated header and draws the scenes. Leaves the header and PNG pictures in build/demo.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
gobo=build/release/bin/gobo
demo=build/demo

cmake --preset release
cmake --build --preset release --target gobo
mkdir -p "$demo"

echo "== What the draws of the scenes need: those permutations composed, validated, emitted"
scenes=()
for name in mist per_vertex phong toon spot moonlight; do scenes+=("examples/teapot/scenes/$name.gltf"); done
"$gobo" scene "${scenes[0]}"
"$gobo" build lit $(printf -- '--scene %s ' "${scenes[@]}") -o "$demo"

echo "== The example, built against the header"
cmake -S examples/teapot -B "$demo/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D gobo_DIR="$PWD/build/release/cmake"
cmake --build "$demo/build"

echo "== The pictures, drawn by OSMesa"
"$demo/build/teapot" "$demo" "${scenes[@]}"

echo "Done. All six pictures together: $demo/teapots.png; the generated header: $demo/lit.hpp"
