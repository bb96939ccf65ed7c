#!/usr/bin/env bash
# cross_test.sh SOURCE_FOLDER BUILD_FOLDER: a build for another computer runs the gobo of this one, from PATH, and says so where
# there is none. The package's own gobo does not run here: its place is taken by a file that cannot.
set -euo pipefail
source=$1
build=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -r "$source/tests/two_targets/application" "$scratch/source"
mkdir "$scratch/package" "$scratch/bin"
# The package as of another computer: same files, but a program that ends with an error.
cp "$build"/cmake/gobo*.cmake "$scratch/package"
sed -i "s|$build/bin/gobo\"|$scratch/foreign\"|" "$scratch"/package/*.cmake
printf '#!/bin/sh\nexit 1\n' >"$scratch/foreign"
chmod +x "$scratch/foreign"
options=(-G Ninja -D "gobo_DIR=$scratch/package" -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=other -D CMAKE_FIND_ROOT_PATH_MODE_PROGRAM=ONLY)

PATH="/usr/bin:/bin" cmake -S "$scratch/source" -B "$scratch/without" "${options[@]}" >"$scratch/log" 2>&1 && ! command -v /usr/bin/gobo >/dev/null &&
  { echo "FAILED: no gobo runs, and nothing is said"; exit 1; }
tr -s ' \n' ' ' <"$scratch/log" | grep -F "cross-compiling needs a gobo that runs here" >/dev/null || [ -x /usr/bin/gobo ] ||
  { cat "$scratch/log"; echo "FAILED: it is not said why"; exit 1; }

ln -s "$build/bin/gobo" "$scratch/bin/gobo"
PATH="$scratch/bin:$PATH" cmake -S "$scratch/source" -B "$scratch/with" "${options[@]}" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/with" --target application_lit_permutations >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
[ -s "$(find "$scratch/with" -name lit.hpp | head -n 1)" ] || { echo "FAILED: no header"; exit 1; }
echo "a build for another computer takes the gobo of this one"
