#!/usr/bin/env bash
# Compiles the module for JavaScript into FOLDER: the npm package, ready for `npm pack`.
# usage: bindings/javascript/build.sh FOLDER   needs emscripten and nodejs; headers are those in /usr/include
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:?usage: bindings/javascript/build.sh FOLDER}
mkdir -p "$out/include"
out=$(cd "$out" && pwd)
# only the headers that are the same on all platforms
for library in CGAL boost; do ln -sfn "/usr/include/$library" "$out/include/$library"; done

# Debian's emscripten needs modules in this folder, and emscripten 3.1 takes node for a browser if there is a fetch()
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs} NODE_OPTIONS=--no-experimental-fetch
# WebAssembly can only round to nearest, which CGAL has to be told
read -ra extra_flags <<<"${ARAP_WASM_FLAGS--msimd128}"
flags=(-std=c++17 -O3 -DNDEBUG -Wall -Wextra -Wshadow -fwasm-exceptions "${extra_flags[@]}"
       -DCGAL_EIGEN3_ENABLED -DCGAL_DISABLE_GMP=1 -DCGAL_ALWAYS_ROUND_TO_NEAREST -DCGAL_DISABLE_ROUNDING_MATH_CHECK
       -DFE_UNDERFLOW=0 -DCGAL_ARAP_DEFORMATION_COMPILED "-I$root/include" -isystem "$out/include" -isystem /usr/include/eigen3)
made_by="${flags[*]} $(em++ --version | head -1) $(
  grep -hsE '^#define (CGAL_VERSION|EIGEN_[A-Z]*_VERSION|BOOST_LIB_VERSION) ' /usr/include/CGAL/version.h \
    /usr/include/boost/version.hpp /usr/include/eigen3/Eigen/{Version,src/Core/util/Macros.h} || true)"
[ "$(cat "$out/made_by" 2>/dev/null)" = "$made_by" ] || rm -f "$out"/*.o
echo "$made_by" >"$out/made_by"
objects=()
pids=
for source in bindings/javascript/arap bindings/Array_deformation src/ARAP_deformation/core; do
  object=$out/${source##*/}.o
  objects+=("$object")
  if [ ! -f "$object" ] || [ -n "$(find "$root"/{include,src,bindings} -newer "$object" -name '*.[hc]*' \
       -not -path "$root/bindings/*/test/*" -not -path "$root/bindings/python/*")" ]; then
    em++ "${flags[@]}" -c "$root/$source.cpp" -o "$object" &
    pids="$pids $!"
  fi
done
for pid in $pids; do wait "$pid"; done
em++ "${flags[@]}" "${objects[@]}" -o "$out/arap.js" --no-entry -sMODULARIZE=1 -sEXPORT_NAME=createArap \
  -sENVIRONMENT=web,worker -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sFILESYSTEM=0 \
  -sEXPORTED_FUNCTIONS=_malloc,_free -sEXPORTED_RUNTIME_METHODS=UTF8ToString
# a module, but without what emscripten would add to find the file of the machine code: index.js does
{ sed 's/document\.currentScript/undefined/; /^if (typeof exports/,$d' "$out/arap.js"; echo 'export default createArap;'; } >"$out/arap.mjs"
rm "$out/arap.js"
cp "$root"/bindings/javascript/{index.js,index.d.ts,package.json,README.md} "$root/LICENSE" "$out/"
