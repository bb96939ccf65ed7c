#!/usr/bin/env bash
# How long it takes to validate 256 and 1,024 distinct keys of lit, side by side: glslangValidator started per stage, glslc in
# two processes, bare glslang in one process, gobo check, gobo build. Rounds are interleaved; the table holds their medians
# (glslangValidator, which takes fifty times as long, runs once). Arguments: the number of rounds (5), then the numbers of keys (256 1024).
set -euo pipefail
cd "$(dirname "$0")/.."
rounds=${1:-5}
counts=("${@:2}")
[ ${#counts[@]} -gt 0 ] || counts=(256 1024)
tools/setup.sh
cmake --preset release >/dev/null
cmake --build --preset release --target gobo write_stages bare_glslang >/dev/null
bin=$PWD/build/release
gobo=$bin/bin/gobo
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

names=("glslangValidator per stage, xargs -P2" "glslc -c, two processes" "bare glslang, two threads" "gobo check -j 2" "gobo build -j 2")
run_0() { printf '%s\0' "${stages[@]}" | xargs -0 -P2 -n1 sh -c 'exec glslangValidator -G -o "$0.spv" "$0"' >"$scratch/log"; }
run_1() {
  cd "$scratch/spirv"
  printf '%s\0' "${stages[@]}" | xargs -0 -P2 -n$(((${#stages[@]} + 1) / 2)) glslc --target-env=opengl -c >"$scratch/log"
  cd "$OLDPWD"
}
run_2() { "$bin/tests/benchmarks/bare_glslang" 2 "${stages[@]}"; }
run_3() { "$gobo" check lit --keys-from "$keys" -j 2; }
run_4() { rm -rf "$scratch/out" && "$gobo" build lit --keys-from "$keys" -j 2 -q -o "$scratch/out"; }

# The time in microseconds that run_N takes.
measure() {
  local start=${EPOCHREALTIME/./}
  "run_$1"
  echo $((${EPOCHREALTIME/./} - start))
}

for count in "${counts[@]}"; do
  keys=$scratch/keys
  # Evenly spaced through a 4-way cover, so that every feature is there.
  "$gobo" list lit --cover 4 | awk -v count="$count" '{ key[NR] = $0 } END { for (i = 0; i < count; ++i) print key[1 + int(i * NR / count)] }' >"$keys"
  rm -rf "$scratch/stages" "$scratch/spirv"
  mkdir "$scratch/stages" "$scratch/spirv"
  "$bin/tests/benchmarks/write_stages" lit "$keys" "$scratch/stages"
  stages=("$scratch"/stages/*)
  for ((round = 0; round < rounds; ++round)); do
    for i in "${!names[@]}"; do
      if [ "$i" -eq 0 ] && [ "$round" -gt 0 ]; then continue; fi
      measure "$i" >>"$scratch/times.$count.$i"
    done
  done
  printf '\n%d keys of lit: %d distinct stages, medians of %d rounds\n\n' "$(wc -l <"$keys")" "${#stages[@]}" "$rounds"
  printf '%-40s %9s %9s\n' "" "seconds" "to bare"
  median() { sort -n "$scratch/times.$count.$1" | awk '{ time[NR] = $1 } END { print time[int((NR + 1) / 2)] }'; }
  bare=$(median 2)
  for i in "${!names[@]}"; do
    awk -v name="${names[$i]}" -v time="$(median "$i")" -v bare="$bare" \
      'BEGIN { printf "%-40s %9.3f %9.2f\n", name, time / 1e6, time / bare }'
  done
done
