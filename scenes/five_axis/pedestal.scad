// SPDX-License-Identifier: BSD-3-Clause
// A bolted pedestal, standing on the middle of the platter; the part sits on it, held from below.
$fn = 48;
difference() {
  union() {
    cylinder(d = 200, h = 20);
    translate([0, 0, 19]) cylinder(d1 = 150, d2 = 100, h = 30);
    cylinder(d = 100, h = 160);
  }
  for (a = [0:60:300]) rotate([0, 0, a]) translate([86, 0, -1]) cylinder(d = 13, h = 30);
}
