#!/usr/bin/env bash
# permutation_tests.sh SOURCE_FOLDER PACKAGE_FOLDER: the tests that gobo_add_permutation_tests() registers, by name, which of
# them fail, and that the report in JUnit's format names the keys that do.
set -euo pipefail
source=$1
package=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
work="$scratch/with spaces"
mkdir -p "$work/wrong"
cp -r "$source/tests/permutation_tests/application/." "$work"
# Fog that begins where it should end.
sed 's/fog\.start/fog.swapped/g; s/fog\.end/fog.start/g; s/fog\.swapped/fog.end/g' "$source/shader_lib/fog.glsl" >"$work/wrong/fog.glsl"
if cmp -s "$source/shader_lib/fog.glsl" "$work/wrong/fog.glsl"; then
  echo "FAILED: fog.glsl has no start and end to swap"
  exit 1
fi
# Shaders of an application's own, and the same with the last light forgotten: right GLSL, and precise.
cp -r "$source/tests/assets/game" "$work/game"
mkdir "$work/wrong_game"
sed 's/i < NUM_LIGHTS;/i < NUM_LIGHTS - 1;/' "$work/game/game.frag" >"$work/wrong_game/game.frag"
if cmp -s "$work/game/game.frag" "$work/wrong_game/game.frag"; then
  echo "FAILED: game.frag has no lights to forget"
  exit 1
fi

gobo="$package/../bin/gobo"
cost=("$gobo" cost lit --key point=1 --keys-from "$work/more.keys" --gpu navi21 --quiet)
priced=
if "${cost[@]}" >"$scratch/costs" 2>&1; then
  "${cost[@]}" --baseline "$work/costs.csv" --update
  sed -E 's/(point=1,fragment),[0-9]+/\1,10/' "$work/costs.csv" >"$work/less.csv"
  priced='
fail grown.cost
run grown.point=1
run priced.cost
run priced.directional=1
run priced.point=1'
else
  echo "SKIPPED: tests of costs: $(head -n 1 "$scratch/costs")"
fi

cmake -S "$work" -B "$work/build" -D gobo_DIR="$package" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
status=0
ctest --test-dir "$work/build" --output-junit "$work/report.xml" >"$scratch/log" 2>&1 || status=$?

expected='fail wrong.fog=linear
fail wrong.point=1 fog=linear
fail wrong_game.lights=2
fail wrong_shared.1_of_1
run game.fog=on lights=1 rim=on
run game.lights=2
run listed.directional=1
run listed.point=1
run listed.render.directional=1
run listed.render.point=1
run listed.render.spot=1 fog=linear
run listed.spot=1 fog=linear
run of_vulkan.point=1
run shared.1_of_2
run shared.2_of_2
run wrong.directional=1
run wrong_game.fog=on'
expected=$(echo "$expected$priced" | LC_ALL=C sort)
found=$(sed -nE 's/.*<testcase name="([^"]*)".* status="(run|fail)".*/\2 \1/p' "$work/report.xml" | LC_ALL=C sort)
if [ "$found" != "$expected" ] || [ "$status" = 0 ]; then
  cat "$scratch/log"
  diff <(echo "$expected") <(echo "$found")
  exit 1
fi
if ! grep -q 'out of tolerance \[fog=linear\]' "$work/report.xml"; then
  echo "FAILED: the report does not name the key that fails in a shard"
  exit 1
fi
if ! grep -q 'the relation any_order = .*uLights.* does not hold at .* of 64 points' "$work/report.xml"; then
  echo "FAILED: the report does not name the relation that the game's shaders break"
  exit 1
fi
echo "$found"
