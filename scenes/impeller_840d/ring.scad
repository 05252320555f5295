// SPDX-License-Identifier: BSD-3-Clause
// A guard ring around the part, on the rim of the chuck. Its upper outer edge has a corner in the plane of C0: that
// is what README.md measures from. Millimetres; zero on its lower face.
inner_r = 86;
outer_r = 96;
height = 70;

difference() {
  cylinder(r = outer_r, h = height, $fn = 120);
  translate([0, 0, -1]) cylinder(r = inner_r, h = height + 2, $fn = 120);
}
