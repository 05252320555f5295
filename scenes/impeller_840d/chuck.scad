// SPDX-License-Identifier: BSD-3-Clause
// A three-jaw chuck, standing on the middle of the platter. Millimetres; zero on its lower face.
body_d = 200;
body_h = 60;
rim = 3;          // bevel of the body's upper edge
bore_d = 52;
grip_r = 30;      // of what the jaws hold
seat_h = 70;      // height of the steps that it stands on
jaw_h = 88;       // top of the jaws
jaw_w = 26;
jaw_end = 66;     // their outer end, from the axis
step_r = 24;      // inner end of the steps

module jaw() {
  translate([step_r, -jaw_w / 2, body_h - 1]) cube([jaw_end - step_r, jaw_w, seat_h - body_h + 1]);
  difference() {
    translate([step_r, -jaw_w / 2, seat_h - 1]) cube([jaw_end - step_r, jaw_w, jaw_h - seat_h + 1]);
    // Round jaws: they touch what they hold along the whole arc.
    translate([0, 0, seat_h]) cylinder(r = grip_r, h = jaw_h, $fn = 120);
    // Outer step.
    translate([jaw_end - 14, -jaw_w, seat_h + 8]) cube([20, 2 * jaw_w, jaw_h]);
  }
}

difference() {
  union() {
    cylinder(d = body_d, h = body_h - rim, $fn = 120);
    translate([0, 0, body_h - rim - 1]) cylinder(d1 = body_d, d2 = body_d - 2 * rim, h = rim + 1, $fn = 120);
  }
  translate([0, 0, -1]) cylinder(d = bore_d, h = body_h + 2, $fn = 96);
}
for (a = [0, 120, 240]) rotate([0, 0, a]) jaw();
