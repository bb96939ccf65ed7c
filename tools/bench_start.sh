#!/usr/bin/env bash
# What short commands of gobo cost: processor time in milliseconds, the median of N runs (11), and the most that it should be.
# glslang builds tables before it compiles anything; what commands cost besides that start is compared with the bound.
# usage: tools/bench_start.sh [GOBO] [N]
set -euo pipefail
gobo=${1:-build/release/bin/gobo}
runs=${2:-11}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
printf '#version 450\nvoid main() {}\n' >"$scratch/empty.vert"
key='point=3 fog=linear'

# median COMMAND...: of its processor times
median() {
  local TIMEFORMAT='%U %S'
  for ((i = 0; i < runs; ++i)); do
    { time "$@" >/dev/null 2>&1; } 2>&1
  done | awk '{ print ($1 + $2) * 1000 }' | sort -n | awk '{ all[NR] = $1 } END { printf "%.0f", all[int((NR + 1) / 2)] }'
}

# row BOUND START COMMAND...
row() {
  local bound=$1 start=$2
  shift 2
  printf '%-45s %8s %8s\n' "gobo ${*//$scratch\//}" $(($(median "$gobo" "$@") - start)) "$bound"
}

start=$(($(median "$gobo" reflect "$scratch/empty.vert") - $(median "$gobo" --version)))
printf '%-45s %8s %8s\n' 'processor time in ms' median 'at most'
row - 0 --version
printf '%-45s %8s\n' "glslang's start, not counted below" "$start"
row 25 0 show lit "$key"
row 25 "$start" check lit --key "$key"
row 25 "$start" build lit --key "$key" -o "$scratch/header"
row 100 0 list lit --all --count
row - 0 list lit --cover 2
row 1500 0 list lit --cover 3
