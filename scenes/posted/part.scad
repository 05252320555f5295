// SPDX-License-Identifier: BSD-3-Clause
// A hub in program coordinates: zero in the middle of the top face. generate.py has the same numbers.
$fn = 180;
outer_r = 50;
top_r = 25;        // the cone goes from here
cone_bottom = -25; // to here, at 45 degrees
base = -60;
bore_r = 12;
bore_depth = 20;
hole_r = 4;
hole_depth = 18;   // to the tip of the drill, square to the cone
point = 118;       // degrees

module hole() {
  tip = hole_r / tan(point / 2);
  translate([0, 0, -hole_depth]) union() {
    cylinder(r1 = 0, r2 = hole_r, h = tip);
    translate([0, 0, tip]) cylinder(r = hole_r, h = hole_depth + 5);
  }
}

difference() {
  rotate_extrude() polygon([[0, 0], [top_r, 0], [outer_r, cone_bottom], [outer_r, base], [0, base]]);
  translate([0, 0, -bore_depth]) cylinder(r = bore_r, h = bore_depth + 1);
  for (a = [0:120:240]) rotate([0, 0, a]) translate([37.5, 0, -12.5]) rotate([0, 45, 0]) hole();
}
