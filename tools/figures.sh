#!/usr/bin/env bash
# figures.sh PROGRAM_FOLDER... [--only PATTERN] [--given COMMAND FILE]... [--check] [--page PAGE]: runs the commands of a page's
# figures and puts what they print in their places: each block ```sh below the line "## Last figures" and the block ```text that
# follows it. --only takes the commands that match. --given does not run the command, but takes what it printed from the file.
# --check leaves the page alone and fails where a figure is stale.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
page="$root/docs/verification.md"
pattern=''
check=no
programs=''
declare -A given
while [ $# -gt 0 ]; do
  case "$1" in
    --only) pattern=$2; shift 2 ;;
    --check) check=yes; shift ;;
    --page) page=$2; shift 2 ;;
    --given) given[$2]=$(realpath "$3"); shift 3 ;;
    *) programs=$programs$(cd "$1" && pwd):; shift ;;
  esac
done
export PATH="$programs$PATH"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$root"

stage=before # before, between, command, answer
command=''
while IFS= read -r line; do
  case "$stage:$line" in
    'before:## Last figures') stage=between ;;
    'between:```sh') stage=command; command='' ;;
    'command:```') stage=between ;;
    'between:```text')
      if [[ "$command" =~ $pattern ]]; then
        echo "$line"
        stage=answer
        echo "$command" >&2
        if [ -n "${given[$command]:-}" ]; then
          cp "${given[$command]}" "$scratch/answer"
        else
          bash -c "$command" >"$scratch/answer" </dev/null
        fi
        cat "$scratch/answer"
        continue
      fi
      stage=kept ;;
    'kept:```') stage=between ;;
    'answer:```') stage=between ;;
    'answer:'*) continue ;;
    'command:'*) command=$line ;;
  esac
  printf '%s\n' "$line"
done <"$page" >"$scratch/page"

if [ "$check" = no ]; then
  cp "$scratch/page" "$page"
elif ! diff -u "$page" "$scratch/page"; then
  echo "stale figures: run cmake --build BUILD --target figures" >&2
  exit 1
fi
