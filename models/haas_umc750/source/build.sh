#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes every mesh of the model from the OpenSCAD source (Debian: openscad, python3).
#   build.sh           writes ../meshes
#   build.sh --check   makes them elsewhere, and fails if what is committed differs or a visual shape leaves its
#                      collision shapes
set -eu
here=$(cd "$(dirname "$0")" && pwd)
model=$(dirname "$here")

VISUAL="base x_rails enclosure_left enclosure_right enclosure_back enclosure_front enclosure_glass pendant
  pendant_screen tool_changer column y_rails ram head head_rails spindle cradle drive_disc platter"
COLLISION="base_bed base_rear base_drive base_pedestal enclosure_walls enclosure_outside tool_changer column_stem
  column_frame ram head spindle cradle_arms cradle_floor platter"

check=no
case "${1:-}" in
  "") ;;
  --check) check=yes ;;
  *) echo "usage: build.sh [--check]" >&2; exit 2 ;;
esac

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/visual" "$work/collision"

make_part() {  # kind part
  if ! openscad -q -o "$work/part.stl" -D "part=\"$2\"" "$here/$1.scad" 2>"$work/log"; then
    cat "$work/log" >&2
    exit 1
  fi
  python3 "$here/stl.py" "$work/part.stl" "$work/$1/$2.stl"
}

for part in $VISUAL; do make_part visual "$part"; done
for part in $COLLISION; do make_part collision "$part"; done

if [ $check = yes ]; then
  diff -r "$work/visual" "$model/meshes/visual"
  diff -r "$work/collision" "$model/meshes/collision"
  python3 "$here/contains.py" "$model/umc750.urdf"
  echo "meshes: as the source makes them; every visual shape lies inside its link's collision shapes"
else
  rm -rf "$model/meshes"
  mkdir -p "$model/meshes"
  mv "$work/visual" "$work/collision" "$model/meshes/"
fi
