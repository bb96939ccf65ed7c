#!/usr/bin/env bash
# two_targets_test.sh COMPILER BUILD_TYPE SOURCE_FOLDER BUILD_FOLDER: an application and four libraries, each with a header of its
# own from family lit, find their own permutations once they are linked into one program; and what gobo_add_permutations() refuses.
set -euo pipefail
compiler=$1
type=$2
source=$3
build=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
options=(-G Ninja -D "CMAKE_CXX_COMPILER=$compiler" -D "CMAKE_BUILD_TYPE=$type" -D "gobo_DIR=$build/cmake")
cp -r "$source/tests/two_targets/application" "$scratch/source"
cmake -S "$scratch/source" -B "$scratch/build" "${options[@]}" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build" >"$scratch/log" 2>&1 || { tail -50 "$scratch/log"; exit 1; }
"$scratch/build/application" | diff - "$scratch/source/expected.txt" || { echo "FAILED: not their own permutations"; exit 1; }

# refuses ARGUMENTS MESSAGE: the call with these arguments ends with that message.
refuses() {
  cat >"$scratch/refused.cmake" <<<"$1"
  cmake -S "$scratch/source" -B "$scratch/refused" "${options[@]}" -D "REFUSED=$scratch/refused.cmake" >"$scratch/log" 2>&1 &&
    { echo "FAILED: accepted: $1"; exit 1; }
  tr -s ' \n' ' ' <"$scratch/log" | grep -F -- "$2" >/dev/null || { cat "$scratch/log"; echo "FAILED: no '$2' for $1"; exit 1; }
}
if [ "$compiler $type" = "g++ Debug" ]; then
  refuses 'gobo_add_permutations(application PRIVATE PUBLIC FAMILY lit)' "give one of PRIVATE, PUBLIC and INTERFACE"
  refuses 'gobo_add_permutations(application FAMILY lit HEADER ../lit.hpp)' "not '../lit.hpp'"
  refuses 'gobo_add_permutations(application FAMILY lit HEADER lit)' "HEADER is a name such as shaders.hpp or engine/shaders.hpp, not 'lit'"
  refuses 'gobo_add_permutations(gobo::headers FAMILY lit)' "'gobo::headers' is imported"
fi
echo "$compiler, $type: each finds its own"
