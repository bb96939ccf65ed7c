#!/bin/sh
# keep_output.sh FILE COMMAND...: runs the command, prints what it prints and keeps that in the file as well.
file=$1
shift
"$@" >"$file"
status=$?
cat "$file"
exit $status
