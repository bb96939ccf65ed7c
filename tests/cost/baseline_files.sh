#!/usr/bin/env bash
# baseline_files.sh GOBO DRIVER: the table of --baseline is written through a symbolic link, and one with fewer keys says what went.
set -euo pipefail
gobo=$(realpath "$1")
driver=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
hold() { "$gobo" cost lit --gpu navi21 --driver "$driver" --baseline "$@"; }
hold kept.csv --update --key default --key point=1
ln -s kept.csv costs.csv
hold costs.csv --update --key point=1 2> said
[ -L costs.csv ]
diff said - <<< "costs.csv (rows gone, which were not measured now: 1)"
hold costs.csv --key point=1
status=0
hold costs.csv --key default --key point=1 2> said || status=$?
[ $status -eq 1 ]
grep -qx "costs.csv: error: it lacks the fragment stage of 'default' on navi21" said
