#!/usr/bin/env bash
# Checks the recipes as far as that goes without the servers of vcpkg and conda-forge: their files are
# read, and the sources of HEAD are built by them, with the libraries of this system.
# usage: packaging/check_recipes.sh [VCPKG]   VCPKG: a clone of vcpkg's repository, whose scripts run the
#                                          portfile, with ninja; without it vcpkg's recipe is only read
set -euo pipefail
vcpkg=${1:+$(cd "$1" && pwd)}
cd "$(dirname "$0")/.."
work=$PWD/build/recipes
rm -rf "$work"
mkdir -p "$work"
version=$(sed -n 's/^project(ARAP_deformation VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
archive=$work/ARAP_deformation-$version.tar.gz
git archive --prefix="ARAP_deformation-$version/" -o "$archive" HEAD
tar -C "$work" -xf "$archive"
sources=$work/ARAP_deformation-$version

echo "conda-forge: the recipe, its build and its tests"
python3 - "$version" "$work/commands" <<'END'
import sys, jinja2, yaml
text = open('packaging/conda/meta.yaml').read()
recipe = yaml.safe_load(jinja2.Environment(undefined=jinja2.StrictUndefined).from_string(text).render(
    compiler=lambda name: name + '_compiler', stdlib=lambda name: name + '_stdlib'))
assert recipe['package']['version'] == sys.argv[1], 'its version is not that of CMakeLists.txt'
known = {'package', 'source', 'build', 'requirements', 'test', 'about', 'extra'}
assert set(recipe) == known, set(recipe) ^ known
open(sys.argv[2], 'w').write('\n'.join(recipe['test']['commands']) + '\n')
END
prefix=$work/prefix
mkdir "$work/conda"
(cd "$work/conda" && SRC_DIR=$sources PREFIX=$prefix CPU_COUNT=2 "$OLDPWD/packaging/conda/build.sh") >"$work/log" ||
  { tail -n 40 "$work/log"; exit 1; }
(cd "$sources" && PREFIX=$prefix PATH=$prefix/bin:$PATH bash -euo pipefail "$work/commands") >"$work/log" ||
  { tail -n 40 "$work/log"; exit 1; }
tail -n 3 "$work/log"

port=packaging/vcpkg/ports/arap-deformation
echo "vcpkg: the manifest"
python3 - "$version" "$port/vcpkg.json" ${vcpkg:+"$vcpkg"} <<'END'
import json, os, sys
port = json.load(open(sys.argv[2]))
assert port['version'] == sys.argv[1], 'its version is not that of CMakeLists.txt'
parts = [port] + list(port['features'].values())
for dependency in (d for part in parts for d in part['dependencies']):
    name = dependency if isinstance(dependency, str) else dependency['name']
    if len(sys.argv) > 3:
        assert os.path.isdir(os.path.join(sys.argv[3], 'ports', name)), 'vcpkg has no port ' + name
assert set(port['default-features']) <= set(port['features'])
END
if [ -z "$vcpkg" ]; then
  echo "NOTICE: without a clone of vcpkg's repository its portfile is not run"
  exit 0
fi
echo "vcpkg: the portfile, with vcpkg's own scripts, but not its tool"
installed=$work/vcpkg/installed
for helper in vcpkg-cmake vcpkg-cmake-config; do
  mkdir -p "$installed/x64-linux/share"
  cp -r "$vcpkg/ports/$helper" "$installed/x64-linux/share"
done
mkdir -p "$work/vcpkg/port" "$work/vcpkg/downloads"
cp "$archive" "$work/vcpkg/downloads"
cp $port/* "$work/vcpkg/port"
sed -i "s/^set(SOURCE_SHA512 .*)/set(SOURCE_SHA512 $(sha512sum "$archive" | cut -d ' ' -f 1))/" "$work/vcpkg/port/portfile.cmake"
helpers=$installed/x64-linux/share
cmake -DCMD=BUILD -DPORT=arap-deformation -DVERSION="$version" "-DFEATURES=core;tbb;tools" \
  "-DALL_FEATURES=tbb;tools" -DTARGET_TRIPLET=x64-linux -D_HOST_TRIPLET=x64-linux \
  -DTARGET_TRIPLET_FILE="$vcpkg/triplets/x64-linux.cmake" -DVCPKG_ROOT_DIR="$vcpkg" \
  -D_VCPKG_INSTALLED_DIR="$installed" -DVCPKG_BASE_VERSION=2999-12-31 -DVCPKG_CONCURRENCY=2 \
  -DDOWNLOADS="$work/vcpkg/downloads" -DBUILDTREES_DIR="$work/vcpkg/buildtrees" \
  -DPACKAGES_DIR="$work/vcpkg/packages" -DCURRENT_PORT_DIR="$work/vcpkg/port" \
  "-DVCPKG_PORT_CONFIGS=$helpers/vcpkg-cmake/vcpkg-port-config.cmake;$helpers/vcpkg-cmake-config/vcpkg-port-config.cmake" \
  -D_VCPKG_NO_DOWNLOADS=ON -DVCPKG_FIXUP_ELF_RPATH=OFF -DNINJA="$(command -v ninja)" -P "$vcpkg/scripts/ports.cmake"
(cd "$work/vcpkg/packages/arap-deformation_x64-linux" && find . -type f | grep -v '^./include/')
