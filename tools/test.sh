#!/usr/bin/env bash
# Sets up, builds and runs the tests: those of every day, or with --full all of them. Other arguments go to ctest: tools/test.sh -R family
set -euo pipefail
cd "$(dirname "$0")/.."
tier=(-LE full)
[ "${1:-}" != --full ] || { tier=(); shift; }
tools/setup.sh
cmake --preset release
cmake --build --preset release
results=build/release/test_results
rm -rf "$results"
status=0
ctest --preset release -j "$(nproc)" "${tier[@]}" --output-junit "$PWD/$results/ctest.xml" "$@" || status=$?
echo "The ten slowest, in seconds:"
sed -nE 's/.*<testcase name="([^"]*)".* classname="([^"]*)".* time="([0-9.]+)".*/\3 \1/p; s/.*<testcase name="([^"]*)".* time="([0-9.]+)".* classname="([^"]*)".*/\2 \3.\1/p' \
  "$results"/*.xml | sort -rn | sed -n 1,10p
if [ ${#tier[@]} -eq 0 ]; then
  # Figures to look at: no test fails by them.
  timeout 60 tools/bench_start.sh build/release/bin/gobo 5 || echo "test.sh: tools/bench_start.sh did not come to its end" >&2
fi
exit $status
