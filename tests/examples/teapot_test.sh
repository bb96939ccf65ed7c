#!/usr/bin/env bash
# teapot_test.sh SOURCE_FOLDER PACKAGE_FOLDER: the example that the README shows is built against gobo, as tools/demo.sh does it, and draws
# the README's picture, to the byte where Mesa is the one that drew it (22.3.6).
set -euo pipefail
source=$1
package=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake -S "$source/examples/teapot" -B "$scratch/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D "gobo_DIR=$package" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build" --target teapot >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
scenes=()
for name in mist per_vertex phong toon spot moonlight; do scenes+=("$source/examples/teapot/scenes/$name.gltf"); done
"$scratch/build/teapot" "$scratch" "${scenes[@]}"
# Other versions of Mesa may round otherwise: there it is enough that the picture is drawn.
osmesa=$(ldconfig -p | awk '/libOSMesa\.so/ && !path {path = $NF} END {print path}')  # to the end: ldconfig must not write to a closed pipe
if ! grep -aqF 22.3.6 "${osmesa:-/dev/null}"; then
  [ -s "$scratch/teapots.png" ]
  exit
fi
cmp "$scratch/teapots.png" "$source/docs/pictures/teapots.png" || { echo "FAILED: docs/pictures/teapots.png is drawn otherwise"; exit 1; }
