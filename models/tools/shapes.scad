// SPDX-License-Identifier: BSD-3-Clause
// Helpers. `between` and `chamfered` take two opposite corners.

module between(a, b) { translate(a) cube(b - a); }

// A box with all its edges cut by c.
module chamfered(a, b, c) {
  hull() {
    between(a + [c, c, 0], b - [c, c, 0]);
    between(a + [c, 0, c], b - [c, 0, c]);
    between(a + [0, c, c], b - [0, c, c]);
  }
}

// A cylinder along Y from y0 to y1.
module y_cylinder(r, y0, y1, n) {
  translate([0, y0, 0]) rotate([-90, 0, 0]) cylinder(r = r, h = y1 - y0, $fn = n);
}

// A cylinder along X from x0 to x1.
module x_cylinder(r, x0, x1, n) {
  translate([x0, 0, 0]) rotate([0, 90, 0]) cylinder(r = r, h = x1 - x0, $fn = n);
}

// Radius of the n-gon whose flats lie on the circle r: what a conservative shape takes.
function around(r, n) = r / cos(180 / n);

// Copies on a bolt circle about Z.
module bolt_circle(r, n, start = 0) {
  for (i = [0:n - 1]) rotate([0, 0, start + 360 * i / n]) translate([r, 0, 0]) children();
}

// Extrudes a polygon of the XZ plane along Y, from y0 to y1.
module along_y(points, y0, y1) {
  translate([0, y1, 0]) rotate([90, 0, 0]) linear_extrude(y1 - y0) polygon(points);
}

// Extrudes a polygon of the YZ plane along X, from x0 to x1.
module along_x(points, x0, x1) {
  translate([x0, 0, 0]) rotate([90, 0, 90]) linear_extrude(x1 - x0) polygon(points);
}
