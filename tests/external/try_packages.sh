#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages in a bare Debian 12, uses, upgrades and removes them there, and looks them over with lintian:
#
#   tests/external/try_packages.sh [FOLDER] [OLD.deb]
#
# FOLDER has arete_*.deb and libarete-dev_*.deb (default: out/package, where ./dev package leaves them). OLD.deb is an
# earlier release of arete; without one a package is made that has the files of 0.1, the library among them, and no more.
# Ends with 77 where mmdebstrap, root or the packages are missing. What runs inside is try_packages_inside.sh.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
folder=$(cd "${1:-$root/out/package}" 2>/dev/null && pwd) || folder=
skip() { printf '%s:1: Skipped\npackages: %s\n\n' "$(basename "$0")" "$1"; exit 77; }

[ -n "$folder" ] || skip "there are no packages: ./dev package makes them"
new=$(ls "$folder"/arete_*.deb 2>/dev/null | tail -1) && dev=$(ls "$folder"/libarete-dev_*.deb 2>/dev/null | tail -1) ||
  skip "there are no packages in $folder: ./dev package makes them"
[ "$(id -u)" = 0 ] || skip "a bare Debian is made by root"
command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed (Debian package mmdebstrap)"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$new" "$work/arete.deb"
cp "$dev" "$work/libarete-dev.deb"
cp "$here/try_packages_inside.sh" "$work"
# The first program of README.md, as it stands there.
awk '/^    #include <arete\/arete.h>/ { on = 1 } on && !/^    / { exit } on { print substr($0, 5) }' "$root/README.md" >"$work/main.cpp"
if [ $# -gt 1 ]; then
  cp "$2" "$work/old.deb"
else
  mkdir -p "$work/old/DEBIAN" "$work/old/usr/bin" "$work/old/usr/lib" "$work/old/usr/include"
  dpkg-deb -x "$dev" "$work/library"
  (cd "$work/library" && cp -r usr/include usr/lib "$work/old/usr/")
  printf '#!/bin/sh\necho arete 0.1.0\n' >"$work/old/usr/bin/arete"
  chmod 755 "$work/old/usr/bin/arete"
  printf '%s\n' "Package: arete" "Version: 0.1.0" "Architecture: $(dpkg --print-architecture)" "Maintainer: The Arete developers <>" \
    "Description: the files of the package of 0.1" >"$work/old/DEBIAN/control"
  dpkg-deb --root-owner-group -Znone -b "$work/old" "$work/old.deb" >/dev/null
fi

if command -v lintian >/dev/null; then
  said=$(lintian --allow-root -I --pedantic "$new" "$dev" 2>&1) || true
  [ -z "$said" ] || { printf 'FAILED: lintian says\n%s\n' "$said"; exit 1; }
  echo "ok: lintian has no complaint"
else
  echo "-- lintian is not installed: it is left out"
fi

mirror=${ARETE_DEBIAN_MIRROR:-http://deb.debian.org/debian}
mmdebstrap --quiet --variant=apt --format=null \
  --customize-hook="copy-in '$work/arete.deb' '$work/libarete-dev.deb' '$work/old.deb' '$work/main.cpp' '$work/try_packages_inside.sh' /mnt" \
  --customize-hook='chroot "$1" env DEBIAN_FRONTEND=noninteractive bash /mnt/try_packages_inside.sh' bookworm - "$mirror"
echo "ok: installed, used, upgraded and removed in a bare Debian 12"
