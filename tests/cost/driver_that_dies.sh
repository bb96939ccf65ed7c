#!/usr/bin/env bash
# driver_that_dies.sh GOBO OSMESA_FOLDER VULKAN_LIBRARY FAMILY: drivers of OpenGL and Vulkan that abort on one key of three, or fail. It alone is lost,
# and what the driver was given is kept.
set -euo pipefail
gobo=$1
family=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo "{\"file_format_version\": \"1.0.0\", \"ICD\": {\"library_path\": \"$3\", \"api_version\": \"1.1.230\"}}" > icd.json
osmesa=(env "LD_LIBRARY_PATH=$2" "RENDERER_DRAWS=$(ldconfig -p | sed -n 's/.*libOSMesa.so.8.*=> //p' | head -n 1)")
vulkan=(env "VK_ICD_FILENAMES=$folder/icd.json" "RENDERER_DRAWS=$(ldconfig -p | sed -n 's/.*libvulkan_lvp.so.*=> //p' | head -n 1)")
keys=(--key crash=on --key default --key red=on)

# expect NAME STATUS FILES COMMAND...: the errors are those of NAME.
expect() {
  local name=$1 status=$2 files=$3 found=0
  shift 3
  "$@" > output 2> errors || found=$?
  [ $found -eq "$status" ] || { echo "$name: status $found"; cat errors; exit 1; }
  diff "$name.expected" <(grep -v '^[0-9]* pictures\? of' errors) || { echo "$name"; exit 1; }
  [ "$(ls out | tr '\n' ' ')" = "$files" ] || { echo "$name left: $(ls out)"; exit 1; }
}

for backend in osmesa vulkan; do
  kept='crash-on.vert crash-on.frag'
  run=("${osmesa[@]}")
  if [ $backend = vulkan ]; then
    kept='crash-on.vert.spv crash-on.frag.spv'
    run=("${vulkan[@]}")
  fi
  sorted=$(tr ' ' '\n' <<< "$kept" | sort | tr '\n' ' ')
  cat > $backend.expected <<END
gobo: error: the renderer of --backend $backend crashed [crash=on]
  help: what it was given is in out/${kept/ / and out/}
END
  expect $backend 1 "$(tr ' ' '\n' <<< "$sorted default.png red-on.png" | sed '/^$/d' | sort | tr '\n' ' ')" \
    "${run[@]}" "$gobo" render "$family" "${keys[@]}" --backend $backend -o out
  printf 'out/default.png\nout/red-on.png\n' | diff - output
  rm -r out
  expect $backend 1 "$sorted" "${run[@]}" "$gobo" test "$family" "${keys[@]}" --render --backend $backend -o out
  grep -q '^2 of 3 permutations drawn by' output
  rm -r out
done

# A device that is lost at the second key: it alone is lost, the third has a device of its own.
clip_space=$(dirname "$family")/../clip_space/clip_space.toml
others=("$clip_space" --key default --key lifted=on --key flattened=on --backend vulkan -j 1 -o out)
cat > lost.expected <<END
gobo: error: the Vulkan driver answers vkQueueSubmit with VK_ERROR_DEVICE_LOST [lifted=on]
  help: see whether a loop of the shaders ends, and what the system's log says; what it was given is in out/lifted-on.vert.spv and out/lifted-on.frag.spv
END
expect lost 1 'default.png flattened-on.png lifted-on.frag.spv lifted-on.vert.spv ' \
  "${vulkan[@]}" RENDERER_LOST_AT=2 "$gobo" render "${others[@]}"
rm -r out
expect lost 1 'lifted-on.frag.spv lifted-on.vert.spv ' "${vulkan[@]}" RENDERER_LOST_AT=2 "$gobo" test "${others[@]}" --render
rm -r out

# A scene has one key, that of its last draw.
"${vulkan[@]}" RENDERER_LOST_AT=1 "$gobo" render --scene "$(dirname "$family")/../scenes/teapot.gltf" --backend vulkan -o out 2> errors && exit 1 || [ $? -eq 1 ]
grep -q '^gobo: error: the Vulkan driver answers vkQueueSubmit with VK_ERROR_DEVICE_LOST \[' errors
[ "$(ls out | grep -c 'spv$')" -eq 2 ]
rm -r out

# What a driver prints is none of gobo's output.
"${vulkan[@]}" RENDERER_TALKS=1 "$gobo" render "$family" --key default --backend vulkan -o out > output 2> errors
echo out/default.png | diff - output
grep -q '^the driver talks$' errors
rm -r out

# One that calls exit() as it is opened, within the loader's lock.
cat > exits.expected <<END
gobo: error: the renderer of --backend vulkan ended the process
  help: try the other --backend, or another version of Mesa
END
mkdir out
expect exits 3 '' "${vulkan[@]}" RENDERER_EXITS=1 timeout 30 "$gobo" render "$family" --key default --backend vulkan -o out

# What is compared is the driver's verdict, and a crash is one.
status=0
"${osmesa[@]}" "$gobo" link "$family" "${keys[@]}" > output 2> errors || status=$?
[ $status -eq 1 ]
grep -q 'gobo takes what the driver does not link: .*the driver crashed \[crash=on\]' errors
grep -q '^3 compared: 2 taken and linked' output
