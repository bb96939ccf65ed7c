#!/usr/bin/env bash
# check_on.sh RELEASE [COMMAND...]: runs tools/demo.sh and tools/test.sh, or the commands given, on a fresh clone of HEAD in an empty
# Debian of that release (bookworm, trixie), and says how long each took. As root, with debootstrap. The Debian lies in
# GOBO_SCRATCH (default /var/tmp/gobo_on_RELEASE), is made anew unless GOBO_KEEP=1 names one to go on with, and stays for a look.
set -euo pipefail
cd "$(dirname "$0")/.."
release=${1:?usage: tools/check_on.sh bookworm|trixie [COMMAND...]}
shift
commands=("$@")
[ ${#commands[@]} -gt 0 ] || commands=(tools/demo.sh tools/test.sh)
root=${GOBO_SCRATCH:-/var/tmp/gobo_on_$release}
[ "$(id -u)" -eq 0 ] || { echo "check_on.sh: run as root: a Debian of its own is made and entered" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "check_on.sh: install debootstrap" >&2; exit 1; }

leave() {
  for place in dev/pts dev proc sys; do ! mountpoint -q "$root/$place" || umount -l "$root/$place"; done
}
trap leave EXIT

if [ "${GOBO_KEEP:-}" != 1 ] || [ ! -d "$root/etc" ]; then
  leave
  rm -rf "$root"
  debootstrap --variant=minbase --include=ca-certificates,git "$release" "$root" >"$root.log" 2>&1 || { tail "$root.log" >&2; exit 1; }
fi
# How packages are reached is this computer's affair; all else is Debian's.
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
{ grep -lsi proxy /etc/apt/apt.conf.d/* /etc/apt/apt.conf || true; } | xargs -r cp -t "$root/etc/apt/apt.conf.d/"
mount -t proc proc "$root/proc"
mount --rbind /sys "$root/sys"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/sys"
mount --make-rslave "$root/dev"

rm -rf "$root/gobo"
git clone -q --no-hardlinks . "$root/gobo"
git -C "$root/gobo" checkout -q "$(git rev-parse HEAD)"
status=0
for command in "${commands[@]}"; do
  begin=$(date +%s)
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 ${CCACHE_DISABLE:+CCACHE_DISABLE=1} \
    sh -c "cd /gobo && $command" || status=$?
  echo "check_on.sh: $release: '$command' took $(($(date +%s) - begin)) s, exit status $status"
  [ $status -eq 0 ] || exit $status
done
