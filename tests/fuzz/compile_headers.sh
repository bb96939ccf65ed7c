#!/usr/bin/env bash
# compile_headers.sh FOLDER: each header in it as C++17; those that no compiler takes are errors. CXX names another compiler.
set -euo pipefail
find "$1" -name '*.hpp' -print0 |
  xargs -0 -r -n 16 -P 2 "${CXX:-c++}" -std=c++17 -trigraphs -fsyntax-only -w -x c++ -I "$(dirname "$0")/../../include"
