#!/bin/sh
# In a clean Debian, as root: installs the packages in /work, uses the command, its man page and the
# library, removes all, and compares what files are there. script/package --check runs it.
set -eu
export DEBIAN_FRONTEND=noninteractive
cd /work
apt() { apt-get -qq -y --no-install-recommends "$@" >apt.log 2>&1 || { cat apt.log; exit 1; }; }
files() { # but what dpkg, apt, man and the linker note of themselves
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /work -o -path /tmp -o -path /var/lib/dpkg \
    -o -path /var/lib/apt -o -path /var/cache -o -path /var/log \) -prune -o -print | sort
}
apt update
apt install man-db
files >before

echo "arap-deform is installed, with what it depends on"
apt install ./arap-deform_*.deb
{ echo "OFF 9 8 0"
  printf '%s %s %s\n' 0 0 0  4 0 0  4 4 0  0 4 0  1 1 1  3 1 1  3 3 1  1 3 1  2 2 2
  printf '4 %s %s %s %s\n' 0 1 5 4  1 2 6 5  2 3 7 6  3 0 4 7
  printf '3 %s %s 8\n' 4 5  5 6  6 7  7 4; } >tent.off
arap_deform tent.off -o moved.off --fix z:..0 --handle z:2.. --move 0,0,0.5
grep '^2 2 2\.5$' moved.off
man arap_deform >page
grep -A 1 '^NAME' page
grep -q -- '--initial_guess' page

echo "libarap-deformation-dev is installed, and an application outside is built"
apt install ./libarap-deformation-dev_*.deb cmake g++ make
cmake -S outside -B application -DINSTALLED=ON -DCMAKE_PREFIX_PATH=/usr -DCMAKE_BUILD_TYPE=Release >cmake.log ||
  { cat cmake.log; exit 1; }
cmake --build application -j "$(nproc)" >cmake.log || { cat cmake.log; exit 1; }
(cd application && ctest --output-on-failure --no-tests=error)

echo "all is removed"
apt purge --autoremove arap-deform libarap-deformation-dev cmake g++ make
if dpkg -l arap-deform libarap-deformation-dev 2>/dev/null | grep '^i'; then exit 1; fi
files >after
diff before after
echo "The clean root is as before: $(wc -l <after) files and folders."
