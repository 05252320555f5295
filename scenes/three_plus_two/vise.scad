// SPDX-License-Identifier: BSD-3-Clause
// A five-axis vise on a riser, standing on the middle of the platter.
$fn = 48;
jaw_gap = 84;
bed = 150;       // the blank stands here
grip = 6;

module block(x, y0, y1, z0, z1) { translate([-x / 2, y0, z0]) cube([x, y1 - y0, z1 - z0]); }

difference() {
  union() {
    cylinder(d = 220, h = 18);
    cylinder(d = 150, h = 92);
    block(130, -70, 70, 88, bed);
    for (side = [-1, 1]) hull() {
      block(90, side > 0 ? jaw_gap / 2 : -jaw_gap / 2 - 24, side > 0 ? jaw_gap / 2 + 24 : -jaw_gap / 2, bed - 12, bed + 1);
      block(90, side > 0 ? jaw_gap / 2 : -jaw_gap / 2 - 18, side > 0 ? jaw_gap / 2 + 18 : -jaw_gap / 2, bed, bed + grip);
    }
  }
  for (a = [0:90:270]) rotate([0, 0, a + 45]) translate([95, 0, -1]) cylinder(d = 13, h = 30);
  for (side = [-1, 1]) translate([0, side * 71, 115]) rotate([90, 0, 0]) translate([0, 0, -8]) cylinder(d = 22, h = 16);
}
