#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the meshes (build.sh), or compares them with what is committed (build.sh --check).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../tools/make_meshes.sh"

VISUAL="base z_rails enclosure_left enclosure_right enclosure_back enclosure_front enclosure_glass panel panel_screen
  tool_changer saddle x_rails table supports cradle platter head spindle"
COLLISION="base_bed base_column enclosure_walls enclosure_outside tool_changer saddle table support_front support_rear
  cradle_arms cradle_floor platter head spindle"

make_meshes "$here/../bc_table_840d.urdf" "$VISUAL" "$COLLISION" "$@"
