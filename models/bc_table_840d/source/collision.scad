// SPDX-License-Identifier: BSD-3-Clause
// Coarse shapes that contain the visual ones (contains.py proves it), in the same frames. Round ones are circumscribed.
include <dimensions.scad>
use <../../tools/shapes.scad>
part = "platter";
coarse = 32;

module base_bed() {
  between([-bed_half_width, bed_front, floor_z], [bed_half_width, bed_back, bed_top]);
  // The saddle's rails.
  for (x = [-240, 240])
    between([x - rail_w / 2, bed_front + 40, bed_top - 1], [x + rail_w / 2, column_front, bed_top + rail_h]);
}

module base_column() {
  w = column_half_width;
  along_x([[column_front, bed_top - 1], [column_back, bed_top - 1], [column_back, column_top - 160],
           [column_back - 120, column_top], [column_front, column_top]], -w, w);
  // The head's rails.
  for (side = [-1, 1])
    between([side * z_rail_x - rail_w / 2, column_front - rail_h, -430],
            [side * z_rail_x + rail_w / 2, column_front + 1, column_top - 30]);
}

module enclosure_walls() {
  w = enclosure_half_width;
  for (x = [-w - wall, w])
    between([x, enclosure_front - wall, enclosure_bottom], [x + wall, enclosure_back, enclosure_top]);
  between([-w - wall, enclosure_front - wall - 60, enclosure_bottom], [w + wall, enclosure_front, front_top]);
}

module enclosure_outside() {
  w = cabinet_half_width;
  y0 = enclosure_front - wall;
  between([-w, cabinet_front, floor_z + 40], [w, cabinet_back, cabinet_top]);
  between([490, y0 - 300, -560], [950, y0, 240]);
  // The doors' sill.
  between([-enclosure_half_width + 60, y0 - 61, -1020], [enclosure_half_width - 60, y0 + 1, -900]);
}

module tool_changer() {
  translate(carousel - [0, 0, pocket_drop + 24])
    cylinder(r = around(carousel_r + 16, coarse), h = carousel_height + pocket_drop + 24, $fn = coarse);
  translate(carousel) {
    cylinder(r = around(84, coarse), h = 250, $fn = coarse);
    // Arm to the column, and its foot.
    between([-50, 0, 150], [50, 600, 236]);
    between([-50, 520, 110], [-carousel.x - column_half_width + 20, 600, 276]);
  }
}

module saddle() {
  between([-saddle_half_width, saddle_front, saddle_bottom], [saddle_half_width, saddle_back, saddle_top]);
  for (x = [-240, 240], y = [saddle_front + 10, saddle_back - 110])
    between([x - 34, y, bed_top + 4], [x + 34, y + 100, saddle_bottom + 1]);
}

module table() {
  w = table_size.x / 2;
  between([-w, table_front, table_top - table_thickness], [w, table_front + table_size.y, table_top]);
  for (x = [-250, 160], y = x_rail_y)
    between([x, y - 34, saddle_top + 3], [x + 90, y + 34, table_top - table_thickness + 1]);
}

module support(r, y0, y1) {
  hull() {
    translate([0, 0, pivot_z]) y_cylinder(around(r, coarse), y0, y1, coarse);
    between([-support_foot_half, y0, table_top], [support_foot_half, y1, table_top + 30]);
  }
}

module support_front() { support(front_support_r, -front_support_end, -support_start); }
module support_rear() {
  support(rear_support_r, support_start, rear_support_end);
  // Under the part that hangs over the table's edge.
  between([-support_foot_half, table_front + table_size.y - 20, table_top - 30],
          [support_foot_half, rear_support_end, table_top + 1]);
}

module cradle_arms() {
  for (side = [-1, 1]) {
    y0 = side < 0 ? -arm_outer : arm_inner;
    y1 = side < 0 ? -arm_inner : arm_outer;
    hull() {
      y_cylinder(around(arm_hub_r, coarse), y0, y1, coarse);
      between([-arm_half_width, y0, cradle_bottom + 30], [arm_half_width, y1, cradle_top]);
    }
    y_cylinder(around(flange_r, coarse), side < 0 ? -flange_end : arm_outer - 1, side < 0 ? -arm_outer + 1 : flange_end,
               coarse);
  }
}

module cradle_floor() {
  along_y([[-cradle_half_bottom, cradle_bottom], [cradle_half_bottom, cradle_bottom],
           [cradle_half_top, cradle_top - 20], [cradle_half_top, cradle_top], [-cradle_half_top, cradle_top],
           [-cradle_half_top, cradle_top - 20]], -arm_outer, arm_outer);
  translate([0, 0, c_motor_bottom])
    cylinder(r = around(c_motor_r, coarse), h = cradle_bottom - c_motor_bottom + 1, $fn = coarse);
}

module platter() {
  n = 96;
  translate([0, 0, -platter_thickness]) cylinder(r = around(platter_d / 2, n), h = platter_thickness, $fn = n);
  translate([0, 0, -platter_thickness - neck_height])
    cylinder(r = around(neck_r, coarse), h = neck_height + 1, $fn = coarse);
}

module nose(first, last) {
  rotate_extrude($fn = 48) polygon(concat([[0, nose_heights[first]]],
    [for (i = [first:last]) [around(nose_radii[i], 48), nose_heights[i]]], [[0, nose_heights[last]]]));
}

module head() {
  nose(1, 3);
  between([-head_half, head_front, head_bottom], [head_half, head_back, head_top]);
  between([-head_motor_half, -head_motor_half, head_top - 1], [head_motor_half, head_motor_half, head_motor_top]);
  for (side = [-1, 1], z = [head_bottom + 30, head_top - 130])
    between([side * z_rail_x - 36, head_back - 60, z], [side * z_rail_x + 36, column_front - 4, z + 100]);
  between([-190, head_back - 60, head_bottom + 20], [190, head_back, head_top]);
}

module spindle() { nose(0, 1); }

if (part == "base_bed") base_bed();
else if (part == "base_column") base_column();
else if (part == "enclosure_walls") enclosure_walls();
else if (part == "enclosure_outside") enclosure_outside();
else if (part == "tool_changer") tool_changer();
else if (part == "saddle") saddle();
else if (part == "table") table();
else if (part == "support_front") support_front();
else if (part == "support_rear") support_rear();
else if (part == "cradle_arms") cradle_arms();
else if (part == "cradle_floor") cradle_floor();
else if (part == "platter") platter();
else if (part == "head") head();
else if (part == "spindle") spindle();
else assert(false, str("no such part: ", part));
