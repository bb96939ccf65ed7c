#!/usr/bin/env bash
# package_test.sh WAY SOURCE_FOLDER BUILD_FOLDER [--build]: a small application takes gobo by WAY: find_package (what `cmake --install
# --component gobo` puts), subdirectory, fetch_content, or debian (the packages that cpack makes, unpacked). The gobo of the build folder
# makes the header where the application would build its own; with --build it does build its own.
set -euo pipefail
way=$1
source=$2
build=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix="$scratch/with spaces/prefix"
options=(-D "WAY=$way")

case $way in
  find_package)
    cmake --install "$build" --prefix "$prefix" --component gobo >"$scratch/install.log"
    [ -x "$prefix/bin/gobo" ] || { echo "FAILED: no gobo is installed"; exit 1; }
    [ -e "$prefix/share/doc/gobo/docs/command_line.md" ] || { echo "FAILED: no pages are installed"; exit 1; }
    [ ! -e "$prefix/bin/gobo-lab" ] || { echo "FAILED: component gobo brings the lab"; exit 1; }
    options+=(-D "CMAKE_PREFIX_PATH=$prefix") ;;
  subdirectory)
    options+=(-D "GOBO_SOURCE=$source") ;;
  fetch_content)
    # A checkout as a user's would be: what git knows, and what is not committed yet.
    mkdir "$scratch/checkout"
    (cd "$source" && git ls-files -z -co --exclude-standard | while IFS= read -r -d '' file; do
      [ ! -e "$file" ] || printf '%s\0' "$file"  # git still lists what was removed and not committed
    done | xargs -0 cp --parents -t "$scratch/checkout")
    git -C "$scratch/checkout" init -q
    git -C "$scratch/checkout" add -A
    git -C "$scratch/checkout" -c user.name=test -c user.email=test@localhost commit -qm checkout
    options+=(-D "GOBO_SOURCE=$scratch/checkout") ;;
  debian)
    (cd "$scratch" && cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch/packages" >"$scratch/cpack.log") || { cat "$scratch/cpack.log"; exit 1; }
    mkdir -p "$prefix"
    for package in "$scratch"/packages/*.deb; do dpkg-deb -x "$package" "$prefix"; done
    [ "$(ls "$scratch"/packages/*.deb | wc -l)" = 2 ] || { echo "FAILED: not two packages"; exit 1; }
    [ -e "$prefix/usr/share/zsh/vendor-completions/_gobo" ] || { echo "FAILED: Debian's zsh finds no completion"; exit 1; }
    grep -q "gobo eval" <<<"$("$prefix/usr/bin/gobo" eval --help)" || { echo "FAILED: gobo does not find gobo-lab beside itself"; exit 1; }
    options=(-D WAY=find_package -D "CMAKE_PREFIX_PATH=$prefix/usr") ;;
esac
if [ "${4:-}" != --build ] && [ "$way" != find_package ] && [ "$way" != debian ]; then
  options+=(-D "GOBO_PROGRAM=$build/bin/gobo")
fi
cmake -S "$source/tests/package/application" -B "$scratch/build" -G Ninja -D CMAKE_BUILD_TYPE=Release "${options[@]}" >"$scratch/configure.log" 2>&1 ||
  { cat "$scratch/configure.log"; exit 1; }
cmake --build "$scratch/build" --target application >"$scratch/build.log" 2>&1 || { tail -50 "$scratch/build.log"; exit 1; }
"$scratch/build/application" || { echo "FAILED: the application does not find its key"; exit 1; }
echo "$way: the application finds its permutation"
