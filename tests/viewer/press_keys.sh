#!/usr/bin/env bash
# press_keys.sh VIEWER SCENE FOLDER KEYS: opens the viewer in a window of a display of its own, presses each key once the frame
# before is shown, then escape. Leaves the pictures in FOLDER and what the viewer printed in FOLDER/log.
set -euo pipefail
viewer=$1 scene=$2 folder=$3 keys=$4
mkdir -p "$folder"
display=$(mktemp) 
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$display" 2>"$folder/xvfb.log" &
server=$!
# The server may have gone with the window: cleaning up must not change the status.
trap 'kill $server 2>/dev/null || true; rm -f "$display"' EXIT
for _ in $(seq 100); do [ -s "$display" ] && break; sleep 0.1; done
export DISPLAY=":$(cat "$display")" LIBGL_ALWAYS_SOFTWARE=1
"$viewer" "$scene" --width 320 --height 200 -o "$folder" --record "$folder/viewer.keys" >"$folder/log" 2>&1 &
running=$!

# Waits until the viewer has told of so many frames.
wait_for_frame() {
  for _ in $(seq 600); do
    [ "$(grep -c '^frame' "$folder/log" || true)" -ge "$1" ] && return
    kill -0 "$running" 2>/dev/null || { echo "the viewer ended early:"; cat "$folder/log"; exit 1; }
    sleep 0.1
  done
  echo "no frame $1 within a minute:"; cat "$folder/log"; exit 1
}

frame=1
wait_for_frame $frame
window=$(xdotool search --pid "$running" | tail -n 1)
xdotool windowfocus --sync "$window"
for key in $(grep -o . <<<"$keys"); do
  xdotool key "$key"
  frame=$((frame + 1))
  wait_for_frame $frame
done
xdotool key Escape
wait "$running"
