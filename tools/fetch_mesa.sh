#!/bin/bash
# Fetches the Vulkan drivers of Debian 13's Mesa with all that they stand on and unpacks them into FOLDER, for
# `gobo cost --driver FOLDER`. Nothing is installed, and no root is needed. Which packages these are, with their
# SHA-256, says data/study/mesa_packages.txt: the figures of the shipped study are theirs.
set -euo pipefail
if [ $# -ne 1 ]; then
    echo "usage: tools/fetch_mesa.sh FOLDER" >&2
    exit 2
fi
packages=$(cd "$(dirname "$0")/.." && pwd)/data/study/mesa_packages.txt
# Where packages are looked for: the archive, and its past for those that newer ones have replaced there.
archives=(http://deb.debian.org/debian http://deb.debian.org/debian-security https://snapshot.debian.org/archive/debian/20261130T000000Z)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
scratch=$(mktemp -d "$folder/.fetch.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
while read -r sum path; do
    [ -z "$sum" ] || [ "${sum:0:1}" = "#" ] && continue
    file=$scratch/$(basename "$path")
    for archive in "${archives[@]}"; do
        curl --silent --show-error --fail --location --retry 2 --max-time 300 --output "$file" "$archive/$path" 2> "$scratch/error" && break
    done
    if ! echo "$sum  $file" | sha256sum --check --status 2> /dev/null; then
        echo "fetch_mesa.sh: $path cannot be fetched, or is not what it should be: $(cat "$scratch/error")" >&2
        exit 1
    fi
    dpkg-deb --extract "$file" "$folder"
    rm "$file"
done < "$packages"
# Only libraries are wanted.
rm -rf "$folder/usr/share/doc" "$folder/usr/share/lintian" "$folder/usr/share/locale" "$folder/usr/share/bug"
echo "$folder"
