// SPDX-License-Identifier: BSD-3-Clause
// A small impeller in program coordinates (G54): zero in the middle of its upper face. impeller.mpf has the same
// numbers.
top_r = 12;       // hub at z = 0
foot_r = 36;      // hub at z = foot_z
foot_z = -30;
disc_r = 40;
disc_z = -40;
grip_r = 30;
grip_z = -70;
blades = 5;
blade_w = 4;
blade_r = 39;     // outer ends
blade_z = -4;     // upper edges

union() {
  rotate_extrude($fn = 180) polygon([[0, 0], [top_r, 0], [foot_r, foot_z], [disc_r, foot_z],
    [disc_r, disc_z], [grip_r, disc_z], [grip_r, grip_z], [0, grip_z]]);
  // Halfway between the channels, whose middles are at 0, 72, ... degrees.
  for (k = [0:blades - 1]) rotate([0, 0, 36 + 72 * k])
    translate([2, -blade_w / 2, foot_z - 1]) cube([blade_r - 2, blade_w, blade_z - foot_z + 1]);
}
