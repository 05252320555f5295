// SPDX-License-Identifier: BSD-3-Clause
// The finished angle block in its program coordinates (G54): zero on the middle of the finished top face.
$fn = 64;
length = 100;
width = 80;
corner = 8;
ledge = -40;     // below it the blank is left for the jaws
bottom = -50;
blank = [104, 84];
leg = 15;        // of the 45 degree faces on the left and right edge
pocket = [50, 30, 12];
hole_d = 8.5;
hole_depth = 25;
sink_d = 10.5;
hole_x = 25;
hole_z = -22;

module rounded(size, r, z0, z1) {
  translate([0, 0, z0]) linear_extrude(z1 - z0) offset(r) square([size.x - 2 * r, size.y - 2 * r], center = true);
}

difference() {
  union() {
    rounded([length, width], corner, ledge - 1, 0);
    translate([-blank.x / 2, -blank.y / 2, bottom]) cube([blank.x, blank.y, ledge - bottom]);
  }
  rounded([pocket.x, pocket.y], corner, -pocket.z, 1);
  for (side = [0, 180]) rotate([0, 0, side])
    translate([length / 2 - leg / 2, -width, -leg / 2]) rotate([0, 45, 0]) translate([-leg * 2, 0, 0])
      cube([leg * 4, 2 * width, leg * 2]);
  for (x = [-hole_x, hole_x]) translate([x, width / 2, hole_z]) rotate([90, 0, 0]) {
    translate([0, 0, -1]) cylinder(d = hole_d, h = hole_depth + 1);
    translate([0, 0, -1]) cylinder(d1 = sink_d + 2, d2 = 0, h = sink_d / 2 + 1);
  }
}
