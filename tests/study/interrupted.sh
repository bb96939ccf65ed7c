#!/usr/bin/env bash
# interrupted.sh GOBO: a study that is interrupted, then killed, and then left to end gives the same tables as one that never was, and
# measures nothing twice.
set -euo pipefail
set -m  # without job control the shell makes background processes deaf to interrupts
gobo=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
study=("$gobo" study lit --no-time --quick --effects 'directional=1 point=1' -q -o)

"${study[@]}" "$folder/whole" >"$folder/expected"
lines=$(wc -l <"$folder/whole/measurements.jsonl")

# Interrupted, then killed outright, as soon as some measurements are on disk; a run that was too quick for that has simply ended.
stop() {
  local signal=$1 at_least=$2 status=$3
  "${study[@]}" "$folder/parts" >"$folder/printed" &
  process=$!
  while kill -0 $process 2>/dev/null; do
    [ -f "$folder/parts/measurements.jsonl" ] && [ "$(wc -l <"$folder/parts/measurements.jsonl")" -ge "$at_least" ] && break
    sleep 0.02
  done
  # Where it has ended already there is nothing to signal: the status that wait finds below decides.
  kill "-$signal" $process 2>/dev/null || true
  wait $process && echo "ended before it could be interrupted" || [ $? -eq "$status" ]
}
stop INT 3 130
stop KILL $((lines / 2)) 137
"${study[@]}" "$folder/parts" >"$folder/printed"
cmp "$folder/expected" "$folder/printed"
for table in study.csv summary.csv curves.csv; do cmp "$folder/whole/$table" "$folder/parts/$table"; done
identities=$(grep -o '"identity":"[0-9a-f]*"' "$folder/parts/measurements.jsonl" | sort)
[ "$(wc -l <<<"$identities")" -eq "$(uniq <<<"$identities" | wc -l)" ] || { echo "measured twice"; exit 1; }
[ "$(uniq <<<"$identities" | wc -l)" -eq "$lines" ] || { echo "lost measurements"; exit 1; }
