#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the meshes of the scenes (Debian: openscad, python3) and what scripts write.
#   build.sh           writes them
#   build.sh --check   makes them elsewhere, and fails if what is committed differs
set -eu
here=$(cd "$(dirname "$0")" && pwd)
stl="$here/../models/tools/stl.py"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for source in "$here"/*/*.scad; do
  scene=$(basename "$(dirname "$source")")
  name=$(basename "$source" .scad)
  mkdir -p "$work/$scene"
  openscad -q -o "$work/part.stl" "$source"
  python3 "$stl" "$work/part.stl" "$work/$scene/$name.stl"
done
python3 "$here/five_axis/generate.py" > "$work/five_axis/dome.nc"
python3 "$here/posted/generate.py" > "$work/posted/hub.cls"

status=0
for made in "$work"/*/*; do
  kept=$here/${made#"$work"/}
  if [ "${1:-}" = --check ]; then
    cmp "$made" "$kept" || status=1
  else
    cp "$made" "$kept"
  fi
done
exit $status
