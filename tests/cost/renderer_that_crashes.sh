#!/usr/bin/env bash
# renderer_that_crashes.sh GOBO FOLDER: FOLDER holds an OSMesa that aborts. The commands that draw say so and end with status 3.
set -euo pipefail
gobo=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export LD_LIBRARY_PATH=$2
cat > "$folder/expected" <<'END'
gobo: error: the renderer of --backend osmesa crashed
  help: try the other --backend, or another version of Mesa
END
for command in "render lit --key point=1 -o $folder/pictures" "test lit --key point=1 --render"; do
  status=0
  # shellcheck disable=SC2086
  "$gobo" $command > "$folder/output" 2> "$folder/errors" || status=$?
  [ $status -eq 3 ] || { echo "$command: status $status"; cat "$folder/errors"; exit 1; }
  diff "$folder/expected" "$folder/errors"
  [ ! -s "$folder/output" ]
done
[ -z "$(ls -A "$folder/pictures" 2> /dev/null)" ]

# One that ends the process without a word has not done its work either.
status=0
RENDERER_EXITS=1 "$gobo" render lit --key point=1 -o "$folder/pictures" > "$folder/output" 2> "$folder/errors" || status=$?
[ $status -eq 3 ]
sed 's/crashed/ended the process/' "$folder/expected" | diff - "$folder/errors"
