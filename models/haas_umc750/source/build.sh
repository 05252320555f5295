#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the meshes (build.sh), or compares them with what is committed (build.sh --check).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../tools/make_meshes.sh"

VISUAL="base x_rails enclosure_left enclosure_right enclosure_back enclosure_front enclosure_glass pendant
  pendant_screen tool_changer column y_rails ram head head_rails spindle cradle drive_disc platter"
COLLISION="base_bed base_rear base_drive base_pedestal enclosure_walls enclosure_outside tool_changer column_stem
  column_frame ram head spindle cradle_arms cradle_floor platter"

make_meshes "$here/../umc750.urdf" "$VISUAL" "$COLLISION" "$@"
