#!/usr/bin/env bash
# rebuild_test.sh GENERATOR SOURCE_FOLDER PACKAGE_FOLDER: what gobo_add_permutations() rebuilds, and what it leaves alone.
# Every step names what gobo must make again and what the compiler must; anything else is a failure.
set -euo pipefail
generator=$1
source=$2
package=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
work="$scratch/with spaces"
mkdir "$work"
cp -r "$source/tests/rebuild/application/." "$work"
mkdir "$work/library"
cp -r "$source/shader_lib" "$source/templates" "$work/library"
failures=0

fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

# expect STEP WHAT: builds, and compares what was made. Make tells modification times apart, so each build gets its own.
expect() {
  local log made
  sleep 0.02
  log=$(cmake --build "$work/build" 2>&1) || { fail "$1: the build fails"; echo "$log"; return; }
  made=$(sed -nE 's/.*Building the permutations .* of ([a-z]+).*/gobo:\1/p; s/.*Building CXX object .*\/([a-z]+)\.cpp.*/compiler:\1/p' \
    <<<"$log" | sort | xargs)
  [ "$made" = "$2" ] || fail "$1: made '$made', expected '$2'"
  echo "$1: ${made:-nothing}"
}

cmake -S "$work" -B "$work/build" -G "$generator" -D gobo_DIR="$package" >"$scratch/configure.log" 2>&1 ||
  { cat "$scratch/configure.log"; exit 1; }
expect "first build" "compiler:clear compiler:foggy gobo:clear gobo:foggy"
expect "second build" ""
"$work/build/foggy" || fail "foggy does not find its keys"
"$work/build/clear" || fail "clear does not find its keys"

touch "$work/library/shader_lib/fog_distance.glsl"
expect "a touched piece of foggy alone: gobo looks, the header stays" "gobo:foggy"
expect "again" ""
sed -i 's/return vectorLength/return 1.0 * vectorLength/' "$work/library/shader_lib/fog_distance.glsl"
expect "a changed piece of foggy alone" "compiler:foggy gobo:foggy"
expect "again" ""
sed -i 's/ahead \/ depth/ahead * (1.0 \/ depth)/' "$work/library/shader_lib/fog.glsl"
expect "a changed piece of foggy in a file that clear reads too: its header stays" "compiler:foggy gobo:clear gobo:foggy"
expect "again" ""
sed -i 's/cosine > 0.0/cosine > 0.00/' "$work/library/shader_lib/lighting/response.glsl"
expect "a changed piece of both" "compiler:clear compiler:foggy gobo:clear gobo:foggy"
echo "// changed" >>"$work/library/shader_lib/harmonics.glsl"
expect "a changed piece of neither" ""
sed -i 's/"directional=1"/"directional=2"/' "$work/CMakeLists.txt"
expect "a changed key" "compiler:foggy gobo:foggy"
sed -i 's/spot < 2"/spot < 2 \&\& point >= 0"/' "$work/CMakeLists.txt"
expect "a condition in other words" "gobo:clear"
expect "again" ""

# A scene chooses the permutations: it is read again when it or its buffer changes, and only then.
cp "$source"/tests/assets/scenes/teapot.{gltf,bin} "$work"
cat >>"$work/CMakeLists.txt" <<CMAKE
add_executable(staged staged.cpp)
gobo_add_permutations(staged FAMILY lit SCENES teapot.gltf BUCKET_LIGHTS 0 2 LIBRARY library)
CMAKE
expect "a program with a scene" "compiler:staged gobo:staged"
"$work/build/staged" || fail "staged does not find its keys"
expect "again" ""
touch "$work/teapot.bin"
expect "a touched buffer: gobo looks, the header stays" "gobo:staged"
# One draw calls for one effect more: one permutation is another, the header with it, and nothing else.
permutations() { grep '"key":' "$work/build/gobo/staged/lit/lit.json" | sed 's/,$//; s/"vertex".*//' | sort; }
permutations >"$scratch/before"
sed -i '0,/"name": "porcelain",/s//"name": "porcelain", "doubleSided": true,/' "$work/teapot.gltf"
expect "one effect more" "compiler:staged gobo:staged"
permutations >"$scratch/after"
[ "$(comm -13 "$scratch/before" "$scratch/after" | grep -c 'sides=two')" = 1 ] || fail "not one permutation is new"
[ "$(comm -12 "$scratch/before" "$scratch/after" | wc -l)" = $(($(wc -l <"$scratch/before") - 1)) ] || fail "others changed"
sed -i 's/"kind": "linear"/"kind": "exponential", "density": 1/' "$work/teapot.gltf"
expect "another fog" "compiler:staged gobo:staged"
"$work/build/staged" && fail "staged still finds the keys of the scene as it was"
expect "again" ""

# Keys and conditions reach gobo as they are written, whatever a shell, a makefile or CMake's lists would make of their
# characters: gobo refuses these, and quotes them.
odd_key="li'near=\"x\" \$HOME \$(shell) %d \\ ; & | < > *"
odd_condition="fog != \"\$HOME; %d\" && 'y' > 0"
cat >>"$work/CMakeLists.txt" <<CMAKE
add_executable(odd_key foggy.cpp)
gobo_add_permutations(odd_key FAMILY lit KEYS [==[$odd_key]==])
add_executable(odd_condition foggy.cpp)
gobo_add_permutations(odd_condition FAMILY lit ALL WHERE [==[$odd_condition]==])
CMAKE
cmake "$work/build" >"$scratch/configure.log" 2>&1
# expect_quoted TARGET TEXT: the target is refused by gobo with a message that quotes the text.
expect_quoted() {
  cmake --build "$work/build" --target "$1" >"$scratch/odd.log" 2>&1 && fail "$1 builds"
  grep -E "error:|^    " "$scratch/odd.log" | grep -v '^cd ' | grep -F -- "$2" >/dev/null || fail "$1 is not quoted: $(cat "$scratch/odd.log")"
}
expect_quoted odd_key "$odd_key"
expect_quoted odd_condition "$odd_condition"

# A cache that CMake names is gobo's.
cmake -D GOBO_CACHE_DIR="$scratch/kept" "$work/build" >"$scratch/configure.log" 2>&1
cmake --build "$work/build" --target foggy_lit_permutations >"$scratch/cached.log" 2>&1 || { fail "foggy with a cache"; cat "$scratch/cached.log"; }
[ -n "$(find "$scratch/kept" -name '*.result' -print -quit)" ] || fail "the cache that CMake names stays empty"
exit "$((failures > 0))"
