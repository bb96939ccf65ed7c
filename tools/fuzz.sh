#!/usr/bin/env bash
# fuzz.sh [SECONDS [TARGET...]]: runs each target of tests/fuzz so long by libFuzzer under AddressSanitizer and
# UndefinedBehaviorSanitizer, from tests/fuzz/corpus and what it kept before on, and prints a table: what was executed, and the
# branches (edges) and kinds of their use (features) reached. Needs clang 16 or later (clang-19 of Debian 12),
# or CXX names one. What is found lies in build/fuzz/found/TARGET; give it a name in tests/fuzz/corpus/TARGET once it is fixed.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
[ $# -gt 0 ] && shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(family condition selection compose header names spirv evaluate gltf picture exr png declarations cache)
build=build/fuzz
compiler=${CXX:-$(command -v clang++-19 || command -v clang++)}
cmake -S . -B $build -G Ninja -D CMAKE_CXX_COMPILER="$compiler" -D CMAKE_C_COMPILER="${compiler/clang++/clang}" -D CMAKE_BUILD_TYPE=RelWithDebInfo \
  -D GOBO_FUZZ=ON -D GOBO_SANITIZE=ON -D GOBO_TESTS=OFF >$build.log 2>&1 || { cat $build.log; exit 1; }
cmake --build $build --target "${targets[@]/#/fuzz_}" >>$build.log 2>&1 || { tail -n 40 $build.log; exit 1; }

failures=0
TIMEFORMAT=%U
printf '| target | processor seconds | executions | edges | features | inputs kept | found |\n|---|---|---|---|---|---|---|\n'
for target in "${targets[@]}"; do
  mkdir -p "$build/corpus/$target" "$build/found/$target"
  status=0
  words=() seeds=()
  case $target in family | header) seeds=(tests/errors/cases) ;; esac
  case $target in family | condition | selection | compose | header | names | declarations) words=(-dict=tests/fuzz/words.dict) ;; esac
  log="$build/found/$target.log"
  processor=$({ time "$build/fuzz/fuzz_$target" -max_total_time="$seconds" -rss_limit_mb=4096 -timeout=120 -print_final_stats=1 -max_len=65536 "${words[@]}" \
    -artifact_prefix="$build/found/$target/" "$build/corpus/$target" "tests/fuzz/corpus/$target" "${seeds[@]}" >"$log" 2>&1; } 2>&1) || status=$?
  last() { grep -oE "$1: [0-9]+" "$log" | tail -n 1 | cut -d ' ' -f 2; }
  found=$(find "$build/found/$target" -type f | wc -l)
  [ $status -eq 0 ] || failures=$((failures + 1))
  printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$target" "$processor" "$(sed -nE 's/^stat::number_of_executed_units: *([0-9]+).*/\1/p' "$log")" \
    "$(last cov)" "$(last ft)" "$(find "$build/corpus/$target" -type f | wc -l)" "$found"
done

# What came of the inputs of headers, each once.
headers=$build/headers
rm -rf "$headers"
for target in "${targets[@]}"; do
  case $target in header | names)
    GOBO_FUZZ_HEADERS=$headers "$build/fuzz/fuzz_$target" -runs=0 "$build/corpus/$target" "tests/fuzz/corpus/$target" >"$build/found/$target.log" 2>&1 ;;
  esac
done
if [ -d "$headers" ]; then
  if CXX=$compiler tests/fuzz/compile_headers.sh "$headers" >"$headers.log" 2>&1; then
    printf 'headers compiled: %s\n' "$(find "$headers" -name '*.hpp' | wc -l)"
  else
    printf 'some header does not compile: %s.log\n' "$headers"
    failures=$((failures + 1))
  fi
fi
exit $((failures > 0))
