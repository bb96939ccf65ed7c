#!/usr/bin/env bash
# Installs what gobo builds and tests with, where it is missing. Debian 12; on another system it names the packages and stops.
set -euo pipefail

packages=(
  ca-certificates g++ clang cmake make ninja-build ccache git dpkg-dev file
  libexpected-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libxxhash-dev libglm-dev
  glslang-dev glslang-tools spirv-tools spirv-headers spirv-cross glslc
  libosmesa6 libegl1 libgl1-mesa-dri libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers libtinyobjloader-dev libopenexr-dev liblodepng-dev libjpeg62-turbo-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  libglfw3-dev libgl1 libglx-mesa0 xvfb xdotool
)

# Tests of pages open them in a browser, those of a cache in Redis start one, and are skipped where there is none.
optional=(chromium chromium-driver python3-selenium libhiredis-dev redis-server)

# absent PACKAGE...: those that are not installed.
absent() {
  for package in "$@"; do
    command -v dpkg-query >/dev/null && dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -x installed >/dev/null || echo "$package"
  done
}
mapfile -t missing < <(absent "${packages[@]}")
mapfile -t missing_optional < <(absent "${optional[@]}")
[ $((${#missing[@]} + ${#missing_optional[@]})) -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
  [ ${#missing[@]} -eq 0 ] && exit 0
  echo "setup.sh: this system has no apt-get. Install what corresponds to these Debian 12 packages, then run again:" >&2
  echo "  ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    [ ${#missing[@]} -eq 0 ] && exit 0
    echo "setup.sh: not root, and there is no sudo. As root, run: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup.sh: installing ${missing[*]} ${missing_optional[*]}" >&2
"${as_root[@]}" apt-get update -q >&2
install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends)
[ ${#missing[@]} -eq 0 ] || "${install[@]}" "${missing[@]}" >&2
[ ${#missing_optional[@]} -eq 0 ] || "${install[@]}" "${missing_optional[@]}" >&2 ||
  echo "setup.sh: cannot install ${missing_optional[*]}: tests that need them will be skipped" >&2
