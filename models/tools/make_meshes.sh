# SPDX-License-Identifier: BSD-3-Clause
# Sourced by each model's source/build.sh: makes every mesh of the model from its OpenSCAD source (Debian: openscad, python3).
#   make_meshes URDF "VISUAL PARTS" "COLLISION PARTS" [--check]
# URDF stands in the model's folder, beside source/ with visual.scad and collision.scad, and meshes/. With --check the
# meshes are made elsewhere, and it fails if what is committed differs or a visual shape leaves its collision shapes.

make_part() {  # kind part
  if ! openscad -q -o "$work/part.stl" -D "part=\"$2\"" "$model/source/$1.scad" 2>"$work/log"; then
    cat "$work/log" >&2
    exit 1
  fi
  python3 "$tools/stl.py" "$work/part.stl" "$work/$1/$2.stl"
}

make_meshes() {
  model=$(cd "$(dirname "$1")" && pwd)
  tools=$model/../tools
  case "${4:-}" in
    ""|--check) ;;
    *) echo "usage: build.sh [--check]" >&2; exit 2 ;;
  esac
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  mkdir -p "$work/visual" "$work/collision"
  for part in $2; do make_part visual "$part"; done
  for part in $3; do make_part collision "$part"; done
  if [ "${4:-}" = --check ]; then
    diff -r "$work/visual" "$model/meshes/visual"
    diff -r "$work/collision" "$model/meshes/collision"
    python3 "$tools/contains.py" "$1"
    echo "meshes: as the source makes them; every visual shape lies inside its link's collision shapes"
  else
    rm -rf "$model/meshes"
    mkdir -p "$model/meshes"
    mv "$work/visual" "$work/collision" "$model/meshes/"
  fi
}
