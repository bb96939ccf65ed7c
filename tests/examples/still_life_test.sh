#!/usr/bin/env bash
# still_life_test.sh SOURCE_FOLDER GOBO: the still life of the README is drawn to the byte, where Mesa 22.3.6 draws it.
set -euo pipefail
source=$1
gobo=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$gobo" render pbr --scene "$source/examples/still_life/still_life.gltf" -o "$scratch" --size 960x400 --smooth 2
# The README's funnel is the scene's.
"$gobo" scene "$source/examples/still_life/still_life.gltf" pbr > "$scratch/funnel"
sed -n '/^```text/,/^```/p' "$source/README.md" | grep -E '^  (needed|distinct|compiled)' | while IFS= read -r line; do
  grep -qxF -- "$line" "$scratch/funnel" || { echo "FAILED: the README says '$line', gobo scene another number"; exit 1; }
done
# Other versions of Mesa may round otherwise: there it is enough that the picture is drawn.
osmesa=$(ldconfig -p | awk '/libOSMesa\.so/ && !path {path = $NF} END {print path}')  # to the end: ldconfig must not write to a closed pipe
if ! grep -aqF 22.3.6 "${osmesa:-/dev/null}"; then
  [ -s "$scratch/still_life.png" ]
  exit
fi
cmp "$scratch/still_life.png" "$source/docs/pictures/still_life.png" || { echo "FAILED: docs/pictures/still_life.png is drawn otherwise"; exit 1; }
