#!/usr/bin/env bash
# scale.sh [ROUNDS]: 100,000 keys that all differ, of a family of five counts, listed, checked and built by gobo, beside bare glslang on the same
# distinct stages; rounds are interleaved. For each round the processor seconds, processes that it starts included, and the largest process.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --build build/release --target gobo write_stages bare_glslang >/dev/null
bin=$PWD/build/release
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset GOBO_CACHE_DIR
cat >"$scratch/big.toml" <<'END'
name     = "big"
vertex   = "big.vert"
fragment = "big.frag"
[features]
a = { count = [0, 9], constant = "A" }
b = { count = [0, 9], constant = "B" }
c = { count = [0, 9], constant = "C" }
d = { count = [0, 9], constant = "D" }
e = { count = [0, 9], constant = "E" }
END
cat >"$scratch/big.vert" <<'END'
#version 450
layout(location = 0) in vec4 position;
void main() { gl_Position = position; }
END
cat >"$scratch/big.frag" <<'END'
#version 450
layout(location = 0) out vec4 color;
layout(std140, binding = 0) uniform Light { vec4 hue; } light;
void main() {
    color = light.hue;
    for (int i = 0; i < A + B; ++i) color = color * float(C) + float(D - E);
}
END

# measure COMMAND...: "processor seconds, seconds by the clock, MB of the largest process".
measure() { tools/measure.py "$@" | awk '{ printf "%s s (%s s by the clock), %s MB", $1, $2, $3 }'; }

"$bin/bin/gobo" list "$scratch/big.toml" --all >"$scratch/keys"
mkdir "$scratch/stages"
"$bin/tests/benchmarks/write_stages" "$scratch/big.toml" "$scratch/keys" "$scratch/stages"
find "$scratch/stages" -type f | sort >"$scratch/list"
printf '%d keys, %d distinct stages\n' "$(wc -l <"$scratch/keys")" "$(wc -l <"$scratch/list")"
printf 'gobo list: %s\n' "$(measure "$bin/bin/gobo" list "$scratch/big.toml" --all)"
for ((round = 0; round < ${1:-1}; ++round)); do
  printf 'bare glslang, two threads: %s\n' "$(measure "$bin/tests/benchmarks/bare_glslang" 2 - <"$scratch/list")"
  printf 'gobo check -j 2: %s\n' "$(measure "$bin/bin/gobo" check "$scratch/big.toml" --all -j 2)"
  printf 'gobo build -j 2: %s\n' "$(measure "$bin/bin/gobo" build "$scratch/big.toml" --all -j 2 -o "$scratch/out")"
done
du -b "$scratch"/out/* | sed "s|$scratch/||"
