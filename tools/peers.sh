#!/usr/bin/env bash
# peers.sh [NUMBER OF KEYS...]: gobo beside what builds shaders elsewhere, for 256 keys of lit unless others are named: glslangValidator started per
# stage, glslc per stage, ninja with glslc -MD, gobo without and with a cache. For each the first build, a build where nothing changed and one
# where a piece changed (the linear fog); seconds by the clock, processor seconds of all processes, MB of the largest process, and the bytes that are left.
set -euo pipefail
cd "$(dirname "$0")/.."
counts=("$@")
[ ${#counts[@]} -gt 0 ] || counts=(256)
cmake --preset release >/dev/null
cmake --build --preset release --target gobo write_stages >/dev/null
bin=$PWD/build/release
gobo=$bin/bin/gobo
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset GOBO_CACHE_DIR

# measure FUNCTION...: sets `took` to "wall (processor)", in seconds, and `memory` to the largest process in MB where that is more.
measure() {
  local times
  times=$(tools/measure.py bash -c '"$@"' bash "$@")
  took=$(awk '{ printf "%s (%s)", $2, $1 }' <<<"$times")
  memory=$(awk -v so_far="$memory" '{ print ($3 > so_far ? $3 : so_far) }' <<<"$times")
}
bytes_of() { du -sb "$@" | awk '{ sum += $1 } END { print sum }'; }
row() { printf '| %s | %s | %s | %s | %s | %s |\n' "$1" "$2" "$3" "$4" "$memory" "$5"; memory=0; }
memory=0

per_stage_validator() { printf '%s\0' "$scratch"/plain/*.vert "$scratch"/plain/*.frag | xargs -0 -P2 -n1 sh -c 'exec glslangValidator -G -o "$0.spv" "$0"'; }
per_stage_glslc() { printf '%s\0' "$scratch"/plain/*.vert "$scratch"/plain/*.frag | xargs -0 -P2 -n1 sh -c 'exec glslc --target-env=opengl -o "$0.spv" "$0"'; }
by_ninja() { ninja -C "$scratch/included" -j2; }
by_gobo() { "$gobo" build lit --library "$scratch/library" --keys-from "$scratch/keys" -j 2 -o "$scratch/$1" "${@:2}"; }

export -f per_stage_validator per_stage_glslc by_ninja by_gobo
export scratch gobo

for count in "${counts[@]}"; do
  "$gobo" list lit --cover 4 | awk -v count="$count" '{ key[NR] = $0 } END { for (i = 0; i < count; ++i) print key[1 + int(i * NR / count)] }' >"$scratch/keys"
  rm -rf "$scratch"/{plain,included,library,out,cached,kept}
  mkdir "$scratch/plain" "$scratch/included"
  "$gobo" library -o "$scratch/library" >/dev/null
  "$bin/tests/benchmarks/write_stages" lit "$scratch/keys" "$scratch/plain"
  "$bin/tests/benchmarks/write_stages" lit "$scratch/keys" "$scratch/included" includes
  {
    printf 'rule glslc\n  command = glslc --target-env=opengl -MD -MF $out.d -o $out $in\n  depfile = $out.d\n  deps = gcc\n'
    (cd "$scratch/included" && for stage in *.vert *.frag; do echo "build $stage.spv: glslc $stage"; done)
  } >"$scratch/included/build.ninja"
  piece=$(grep -l 'clamp(ahead / depth' "$scratch"/included/pieces/*.glsl | head -n 1)
  stages=$(find "$scratch/plain" -type f | wc -l)
  printf '\n%d keys of lit, %d distinct stages\n\n| | first build, s (processor) | nothing changed | one piece changed | MB | bytes |\n|---|---|---|---|---|---|\n' "$count" "$stages"
  measure per_stage_validator; first=$took
  row "glslangValidator per stage" "$first" "the same" "the same" "$(bytes_of "$scratch"/plain/*.spv)"
  rm -f "$scratch"/plain/*.spv
  measure per_stage_glslc; first=$took
  row "glslc per stage" "$first" "the same" "the same" "$(bytes_of "$scratch"/plain/*.spv)"
  measure by_ninja; first=$took
  measure by_ninja; again=$took
  sed -i 's|clamp(ahead / depth|clamp(1.0 * ahead / depth|' "$piece"
  measure by_ninja; changed=$took
  row "ninja and glslc -MD" "$first" "$again" "$changed" "$(bytes_of "$scratch"/included/*.spv)"
  measure by_gobo out; first=$took
  measure by_gobo out; again=$took
  sed -i 's|clamp(ahead / depth|clamp(1.0 * ahead / depth|' "$scratch/library/shader_lib/fog.glsl"
  measure by_gobo out; changed=$took
  row "gobo build" "$first" "$again" "$changed" "$(bytes_of "$scratch/out")"
  sed -i 's|clamp(1.0 [*] ahead|clamp(ahead|' "$scratch/library/shader_lib/fog.glsl"
  measure by_gobo cached --cache "$scratch/kept"; first=$took
  measure by_gobo cached --cache "$scratch/kept"; again=$took
  sed -i 's|clamp(ahead / depth|clamp(1.0 * ahead / depth|' "$scratch/library/shader_lib/fog.glsl"
  measure by_gobo cached --cache "$scratch/kept"; changed=$took
  row "gobo build with a cache" "$first" "$again" "$changed" "$(bytes_of "$scratch/cached")"
done
