#!/usr/bin/env bash
# Packs the npm package, installs it in an empty folder, and tests it there: types, errors, and
# energies against those of the command arap_deform.
# usage: bindings/javascript/test/run.sh PACKAGE [FOLDER]
#   FOLDER  has meshes NAME.off with NAME.sel and NAME.def
set -euo pipefail
root=$(cd "$(dirname "$0")/../../.." && pwd)
package=$(cd "$1" && pwd)
meshes=${2:+$(cd "$2" && pwd)}
work=$root/build/live/empty
rm -rf "$work"
mkdir -p "$work"
(cd "$package" && npm pack --silent --pack-destination "$work" >/dev/null)
cd "$work"
echo '{ "name": "empty", "private": true, "type": "module" }' >package.json
npm install --silent --no-audit --no-fund ./arap-deformation-*.tgz
cp "$root"/bindings/javascript/test/test.mjs "$root"/bindings/javascript/test/types.ts .
cp "$root/demo/ARAP_deformation/live/models.js" .
"$root/build/live/node_modules/.bin/tsc" --noEmit --strict --target es2022 --module nodenext types.ts
ARAP_DEFORM=$root/build/release/demo/ARAP_deformation/arap_deform node test.mjs ${meshes:+"$meshes"}
