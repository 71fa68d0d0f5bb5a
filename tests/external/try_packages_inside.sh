#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What try_packages.sh runs in a bare Debian 12, as root. /mnt has arete.deb, libarete-dev.deb, old.deb and main.cpp.
set -euo pipefail
export HOME=/root LC_ALL=C.UTF-8 XDG_RUNTIME_DIR=/tmp
apt() { apt-get -q=2 -y -o Dpkg::Use-Pty=0 "$@" >/tmp/apt.txt 2>&1 || { cat /tmp/apt.txt; fail "apt-get $*"; }; }
fail() { echo "FAILED: $*"; exit 1; }
ok() { echo "ok: $*"; }
has() { dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed; }
left() {  # what of Arete is anywhere, but for logs and what man has formatted for root
  find / -xdev \( -path /mnt -o -path /tmp -o -path /proc -o -path /var/log -o -path /var/cache/man -o -path /root/work \) -prune -o -iname '*arete*' -print
}

apt update
mkdir -p /root/work && cd /root/work

# The library alone: README's first program, with nothing installed but the package and what it brings.
apt install /mnt/libarete-dev.deb
! has arete || fail "libarete-dev brings arete"
awk 'BEGIN { print "ncols 65\nnrows 65\nxllcorner 600000\nyllcorner 5100000\ncellsize 30";
  for (r = 0; r < 65; ++r) { for (c = 0; c < 65; ++c) printf "%.2f ", 500 + 90 * sin(r / 7) * cos(c / 9); print "" } }' >dem.asc
cp -r /usr/share/doc/libarete-dev/examples examples
cmake -S examples -B examples/build >/dev/null && cmake --build examples/build --target build >/dev/null
examples/build/build dem.asc alps.amt | grep -q '4225 vertices' || fail "the example \"build\""
mkdir -p first && cp /mnt/main.cpp first/
cat >first/CMakeLists.txt <<'TXT'
cmake_minimum_required(VERSION 3.22)
project(first LANGUAGES CXX)
find_package(Arete REQUIRED)
add_executable(first main.cpp)
target_link_libraries(first PRIVATE Arete::arete)
TXT
cmake -S first -B first/build >/dev/null && cmake --build first/build >/dev/null && first/build/first && [ -s alps.glb ] ||
  fail "README's first program"
ok "libarete-dev alone: find_package(Arete), an example and README's first program"
apt purge libarete-dev
[ -z "$(left)" ] || fail "libarete-dev leaves $(left)"

# From the single package of 0.1, whose library the new packages share between them.
apt install /mnt/old.deb
[ "$(arete --version)" = "arete 0.1.0" ] || fail "the old package"
apt install /mnt/arete.deb
[ ! -e /usr/include/arete ] || fail "the library of 0.1 stays with the new arete"
apt install /mnt/libarete-dev.deb
ok "upgraded from 0.1 to $(arete --version)"
apt purge arete libarete-dev
apt install /mnt/old.deb
apt install /mnt/arete.deb /mnt/libarete-dev.deb
has arete && has libarete-dev || fail "both at once over 0.1"
apt install --reinstall /mnt/arete.deb /mnt/libarete-dev.deb
version=$(dpkg-query -W -f '${Version}' arete)
[ "$(arete --version)" = "arete ${version%-*}" ] || fail "arete --version: $(arete --version), the package is $version"

# Use.
apt install gdal-bin man-db bash-completion
arete-datasets generate -o dem.tif --size 257 --quiet >/dev/null
arete build dem.tif -o dem.amt --quiet
arete extract dem.amt -o tin.ply --max-error 5 --quiet
arete measure tin.ply dem.tif --expect 5 | grep -q kept || fail "build, extract, measure"
gdalinfo dem.amt | grep -q '^Driver: AMT/' || fail "gdalinfo dem.amt"
ogrinfo -q dem.amt | grep -q triangles || fail "ogrinfo dem.amt"
/usr/bin/python3 - <<'PY' || fail "import arete"
import arete
tin = arete.build("dem.tif").cut(max_error=5)
assert len(tin.triangles) > 100
PY
arete demo dem.tif -o demo --quiet >demo.txt 2>&1 || { cat demo.txt; fail "arete demo"; }
arete view dem.amt --headless --screenshot view.png --size 320x200 --quiet && [ -s view.png ] || fail "arete view --headless"
for page in arete arete-build arete-datasets; do
  man -w "$page" >/dev/null && MANPAGER=cat man "$page" | grep -qi arete || fail "man $page"
done
bash -ic '. /usr/share/bash-completion/bash_completion; _completion_loader arete; complete -p arete' 2>/dev/null |
  grep -q arete || fail "completion"
[ -s /usr/share/doc/arete/README.md ] && [ -s /usr/share/doc/arete/docs/topics/package.md ] || fail "the pages"
zcat /usr/share/doc/arete/changelog.gz | grep -q "^## ${version%-*}" || fail "the changelog has no ${version%-*}"
grep -qx "version=${version%-*}" /usr/share/qgis/python/plugins/arete/metadata.txt || fail "the plugin's version"
ok "arete: program, demo, picture, driver, Python, manual, completion, pages"

# The tutorial's commands, line by line; not those that fetch over the network, open a window or need other programs.
tutorial=/usr/share/doc/arete/docs/start/tutorial.md
if [ -e "$tutorial" ]; then
  mkdir -p tutorial && cd tutorial
  sed -n 's/^    \(arete.*\)/\1/p' "$tutorial" | grep -v ' fetch \|--film\|^arete view [^ ]*$' >lines.txt
  while read -r line; do
    bash -c "$line" >out.txt 2>&1 </dev/null || { cat out.txt; fail "the tutorial: $line"; }
  done <lines.txt
  ok "the tutorial's $(wc -l <lines.txt) commands"
  cd ..
fi

# Nothing stays, not even what Python has compiled for root.
PYTHONPATH=/usr/share/qgis/python/plugins /usr/bin/python3 -c 'import arete' || true
apt remove arete libarete-dev
! has arete || fail "arete is not removed"
dpkg --purge arete libarete-dev >/dev/null 2>&1 || true  # without settings nothing is left to purge
[ -z "$(left)" ] || fail "left behind: $(left)"
ok "removed: nothing is left"
