#!/usr/bin/env bash
# Sets up, builds and runs all tests. Arguments go to ctest: tools/test.sh -R family
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
cmake --preset release
cmake --build --preset release
exec ctest --preset release -j "$(nproc)" "$@"
