// SPDX-License-Identifier: BSD-3-Clause
// Coarse shapes that contain the visual ones (contains.py proves it), in the same frames. Round ones are circumscribed.
include <dimensions.scad>
use <../../tools/shapes.scad>
part = "platter";
coarse = 32;

module base_bed() {
  w = base_half_width;
  translate([pivot.x, 0, 0])
    along_y([[-w, floor_z], [w, floor_z], [w, bed_shoulder], [w - 40, bed_shoulder], [trough_half, bed_top],
             [-trough_half, bed_top], [-w + 40, bed_shoulder], [-w, bed_shoulder]], bed_front, rear_base_front + 20);
}

module base_rear() {
  w = base_half_width;
  top = rear_base_top + 34;
  translate([pivot.x, 0, 0]) {
    along_x([[rear_base_front, floor_z], [rear_base_back, floor_z], [rear_base_back, top], [rear_base_front + 70, top],
             [rear_base_front, rear_base_top - 90]], -w, w);
  }
}

module base_drive() {
  y0 = pivot.y + drive_housing_start;
  translate([pivot.x, 0, 0]) {
    hull() {
      translate([0, 0, pivot.z]) y_cylinder(around(drive_housing_r, coarse), y0, rear_base_front + 30, coarse);
      between([-322, y0, bed_top - 20], [322, rear_base_front + 30, bed_top + 60]);
    }
    along_x([[rear_base_front + 10, bed_top - 40], [y0 + 60, bed_top - 40], [rear_base_front + 10, -560]], -390, 390);
  }
}

module base_pedestal() {
  y0 = pivot.y - bearing_housing_end;
  y1 = pivot.y - bearing_housing_start;
  translate([pivot.x, 0, 0]) {
    hull() {
      translate([0, 0, pivot.z]) y_cylinder(around(bearing_housing_r, coarse), y0, y1, coarse);
      between([-252, y0, bed_top - 20], [252, y1, bed_top + 20]);
    }
    hull() {
      between([-290, y0 - 40, bed_top - 20], [290, y1, bed_top + 30]);
      between([-250, y0 + 10, bed_top - 20], [250, y1, bed_top + 90]);
    }
  }
}

module enclosure_walls() {
  w = enclosure_half_width;
  translate([pivot.x, 0, 0]) {
    for (x = [-w - wall, w])
      between([x, enclosure_front - wall, enclosure_bottom], [x + wall, enclosure_back, enclosure_top]);
    between([-w - wall, enclosure_front - wall - 60, enclosure_bottom], [w + wall, enclosure_front, front_top]);
    for (x = [-w + 70, w - 70])
      between([x - 77, enclosure_back - 30, enclosure_bottom], [x + 77, enclosure_back, rear_base_top - 150]);
  }
}

module enclosure_outside() {
  w = enclosure_half_width;
  y0 = enclosure_front - wall;
  translate([pivot.x, 0, 0]) {
    between([-700, cabinet_front, floor_z + 60], [700, cabinet_back, cabinet_top]);
    // Sill, pendant and its arm.
    between([-w + 60, y0 - 70, -930], [w - 60, y0, -800]);
    between([510, y0 - 400, -500], [1010, y0, 270]);
  }
}

module tool_changer() {
  translate([0, carousel_y, carousel_z])
    x_cylinder(around(carousel_r, coarse), carousel_x[0] - 15, carousel_x[1], coarse);
}

module column_stem() {
  w = column_half_width;
  between([-w, column_front, column_bottom - 26], [w, column_back, column_bottom + 110]);
  between([-w + 8, column_front + 20, column_bottom + 100], [w - 8, column_back - 20, column_deck + 30]);
}

module column_frame() {
  w = column_half_width;
  for (side = [-1, 1])
    along_x([[column_front + 20, column_deck - 20], [column_back - 20, column_deck - 20],
             [column_back - 20, column_top - 190], [column_back - 150, column_top], [column_front + 110, column_top],
             [column_front + 20, column_top - 120]],
            side > 0 ? w - cheek_thickness - 8 : -w + 8, side > 0 ? w - 8 : -w + cheek_thickness + 8);
  between([-w + 8, column_front + 110, column_top - 62], [w - 8, column_back - 150, column_top]);
}

module ram() {
  between([-ram_half_width, ram_front + 20, ram_bottom], [ram_half_width, ram_back, ram_top]);
  between([-ram_plate_half_width, ram_front - 24, ram_plate_bottom],
          [ram_plate_half_width, ram_front + ram_plate_thickness, ram_plate_top]);
  between([-120, ram_front, ram_top - 30], [120, ram_front + 120, z_motor_top]);
}

module nose(first, last) {
  rotate_extrude($fn = 48) polygon(concat([[0, nose_heights[first]]],
    [for (i = [first:last]) [nose_radii[i], nose_heights[i]]], [[0, nose_heights[last]]]));
}

module octagon(half, corner, z0, z1) {
  translate([0, 0, z0]) linear_extrude(z1 - z0)
    polygon([[half, -corner], [half, corner], [corner, half], [-corner, half], [-half, corner], [-half, -corner],
             [-corner, -half], [corner, -half]]);
}

module head() {
  u = head_upper_half;
  nose(1, 4);
  octagon(head_half, head_corner, 120, head_lower_top + 1);
  hull() {
    octagon(head_half, head_corner, head_lower_top, head_lower_top + 1);
    between([-u, -u, head_upper_bottom], [u, head_back, head_upper_bottom + 60]);
  }
  between([-u, -u, head_upper_bottom], [u, head_back + head_rail_h, head_top]);
  between([-head_half, 60, head_back_bottom], [head_half, head_back + head_rail_h, head_upper_bottom + 40]);
}

module spindle() { nose(0, 1); }

module cradle_arms() {
  for (side = [-1, 1]) {
    y0 = side < 0 ? -arm_outer : arm_inner;
    y1 = side < 0 ? -arm_inner : arm_outer;
    hull() {
      y_cylinder(around(arm_hub_r, coarse), y0, y1, coarse);
      between([-arm_half_width, y0, cradle_top - 30], [arm_half_width, y1, cradle_top]);
    }
  }
  y_cylinder(around(disc_r, coarse), arm_outer, disc_end, coarse);
  y_cylinder(around(shaft_r, coarse), -shaft_end, -arm_outer, coarse);
}

module cradle_floor() {
  along_y([[-cradle_half_bottom, cradle_bottom], [cradle_half_bottom, cradle_bottom],
           [cradle_half_top, cradle_top - 30], [cradle_half_top, cradle_top + 3], [-cradle_half_top, cradle_top + 3],
           [-cradle_half_top, cradle_top - 30]], -arm_outer, arm_outer);
  translate([0, 0, c_motor_bottom]) cylinder(r = around(c_motor_r, coarse), h = 60, $fn = coarse);
  // The ribs at the arms.
  for (side = [-1, 1])
    between([-112, side < 0 ? -arm_inner : arm_inner - 34, cradle_top],
            [112, side < 0 ? -arm_inner + 34 : arm_inner, cradle_top + 14]);
}

module platter() {
  n = 96;
  translate([0, 0, -platter_thickness]) cylinder(r = around(platter_d / 2, n), h = platter_thickness, $fn = n);
  translate([0, 0, -platter_thickness - neck_height])
    cylinder(r = around(hub_gap_r, coarse), h = neck_height + 1, $fn = coarse);
}

if (part == "base_bed") base_bed();
else if (part == "base_rear") base_rear();
else if (part == "base_drive") base_drive();
else if (part == "base_pedestal") base_pedestal();
else if (part == "enclosure_walls") enclosure_walls();
else if (part == "enclosure_outside") enclosure_outside();
else if (part == "tool_changer") tool_changer();
else if (part == "column_stem") column_stem();
else if (part == "column_frame") column_frame();
else if (part == "ram") ram();
else if (part == "head") head();
else if (part == "spindle") spindle();
else if (part == "cradle_arms") cradle_arms();
else if (part == "cradle_floor") cradle_floor();
else if (part == "platter") platter();
else assert(false, str("no such part: ", part));
