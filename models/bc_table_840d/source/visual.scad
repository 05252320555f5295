// SPDX-License-Identifier: BSD-3-Clause
// Detailed shapes, each in the frame of its link: base, saddle, table, head as they stand at machine zero in the machine
// frame, the cradle about the pivot, the platter about the centre of its face.
include <dimensions.scad>
use <../../tools/shapes.scad>
part = "platter";
fine = 96;

// ---------------------------------------------------------------------------------------------------------- base_link
module bed() {
  w = bed_half_width;
  difference() {
    chamfered([-w, bed_front, floor_z + 40], [w, bed_back, bed_top], 14);
    // Chip troughs beside the saddle's rails, and pockets in the casting's front and sides.
    for (side = [-1, 1])
      between([side * 340 - 50, bed_front - 1, bed_top - 60], [side * 340 + 50, column_front - 20, bed_top + 1]);
    for (x = [-210, 210])
      chamfered([x - 160, bed_front - 60, floor_z + 110], [x + 160, bed_front + 30, bed_top - 110], 24);
    for (side = [-1, 1], y = [-260, 240])
      chamfered([side * w - 30, y, floor_z + 110], [side * w + 30, y + 400, bed_top - 110], 24);
  }
  for (x = [-340, 340], y = [bed_front + 90, 290, bed_back - 90])
    translate([x, y, floor_z]) cylinder(r = 50, h = 60, $fn = 32);
  for (x = [-240, 240])
    between([x - rail_w / 2, bed_front + 40, bed_top - 1], [x + rail_w / 2, column_front, bed_top + rail_h]);
}

module column() {
  w = column_half_width;
  difference() {
    along_x([[column_front, bed_top - 1], [column_back, bed_top - 1], [column_back, column_top - 160],
             [column_back - 120, column_top], [column_front, column_top]], -w, w);
    for (side = [-1, 1], z = [-900, -440, 40])
      chamfered([side * w - 26, column_front + 110, z], [side * w + 26, column_back - 110, z + 360], 20);
    between([-90, column_front - 1, -960], [90, column_front + 50, column_top - 60]);
  }
  // Ball screw of the head, within its recess.
  translate([0, column_front + 26, -900]) cylinder(r = 18, h = 1500, $fn = 32);
}

module base() { bed(); column(); }

module z_rails() {
  for (side = [-1, 1])
    between([side * z_rail_x - rail_w / 2, column_front - rail_h, -430],
            [side * z_rail_x + rail_w / 2, column_front + 1, column_top - 30]);
}

// ---------------------------------------------------------------------------------------------------------- enclosure
module side_panel(x0, x1, outside) {
  difference() {
    chamfered([x0, enclosure_front - wall, enclosure_bottom], [x1, enclosure_back, enclosure_top], 8);
    for (y = [-500, 240])
      chamfered([outside - 7, y, enclosure_bottom + 120], [outside + 7, y + 640, enclosure_top - 120], 6);
  }
}

module enclosure_left() { side_panel(-enclosure_half_width - wall, -enclosure_half_width, -enclosure_half_width - wall); }
module enclosure_right() { side_panel(enclosure_half_width, enclosure_half_width + wall, enclosure_half_width + wall); }

module enclosure_back_panel() {
  w = cabinet_half_width;
  difference() {
    chamfered([-w, cabinet_front, floor_z + 40], [w, cabinet_back, cabinet_top], 16);
    for (x = [-w + 40, 20])
      chamfered([x, cabinet_back - 8, floor_z + 120], [x + w - 60, cabinet_back + 8, cabinet_top - 60], 7);
    for (i = [0:9]) between([-w - 1, cabinet_front + 80, -200 + 30 * i], [-w + 6, cabinet_back - 80, -188 + 30 * i]);
  }
}

module window_pair(y0, y1, grow) {
  for (side = [-1, 1])
    chamfered([side * 242 - 170 - grow, y0, -640 - grow], [side * 242 + 170 + grow, y1, 140 + grow], 6);
}

module enclosure_front_panel() {
  y1 = enclosure_front;
  y0 = enclosure_front - wall;
  w = enclosure_half_width;
  difference() {
    chamfered([-w, y0, enclosure_bottom], [w, y1, front_top], 8);
    between([-door_half_width, y0 - 1, -880], [door_half_width, y1 + 1, front_top - 90]);
    for (x = [-740, 520]) chamfered([x, y0 - 7, -760], [x + 220, y0 + 7, front_top - 60], 6);
  }
  difference() {
    for (side = [-1, 1])
      chamfered([side * 242 - 244, y0 - 12, -900], [side * 242 + 244, y1 - 4, front_top - 70], 10);
    window_pair(y0 - 30, y1 + 30, 0);
  }
  // Handles.
  for (side = [-1, 1]) {
    hull() for (z = [-460, -180]) translate([side * 34, y0 - 44, z]) sphere(r = 10, $fn = 12);
    for (z = [-460, -180]) translate([side * 34, 0, z]) y_cylinder(8, y0 - 44, y0 - 5, 12);
  }
  // Sill below the doors.
  hull() {
    between([-w + 60, y0 - 60, -940], [w - 60, y0 + 10, -900]);
    between([-w + 60, y0 - 5, -1020], [w - 60, y0 + 10, -900]);
  }
}

module enclosure_glass() { window_pair(enclosure_front - wall + 10, enclosure_front - 12, 8); }

// The operator's panel: screen, keys, machine control panel.
module panel() {
  y0 = enclosure_front - wall;
  translate([720, y0 - 130, -100]) rotate([0, 0, 14]) {
    chamfered([-180, -50, -360], [180, 60, 290], 14);
    hull() {
      between([-180, -100, -440], [180, 10, -400]);
      between([-180, -60, -400], [180, 20, -340]);
    }
    for (i = [0:8], j = [0:3])
      between([-150 + 34 * i, -54, -200 + 34 * j], [-124 + 34 * i, -46, -174 + 34 * j]);
    translate([-120, -50, -300]) rotate([90, 0, 0]) cylinder(r = 34, h = 12, $fn = 32);
    translate([110, -50, -300]) rotate([90, 0, 0]) cylinder(r = 22, h = 20, $fn = 32);
  }
  hull() {
    between([690, y0 - 110, 150], [770, y0 - 80, 190]);
    between([690, y0 - 10, 150], [770, y0 - 1, 230]);
  }
}

module panel_screen() {
  translate([720, enclosure_front - wall - 130, -100]) rotate([0, 0, 14])
    between([-150, -54, -20], [150, -46, 250]);
}

module tool_changer() {
  translate(carousel) {
    difference() {
      union() {
        cylinder(r = carousel_r - 18, h = carousel_height - 12, $fn = fine);
        cylinder(r = 80, h = 250, $fn = 64);
        for (i = [0:pockets - 1]) rotate([0, 0, 360 * i / pockets]) translate([pocket_circle_r, 0, 0]) {
          translate([0, 0, -pocket_drop]) cylinder(r = 34, h = pocket_drop + 20, $fn = 32);
          between([-30, -26, -20], [38, 26, carousel_height - 4]);
        }
      }
      // Where the taper hangs, and lightening holes.
      for (i = [0:pockets - 1]) rotate([0, 0, 360 * i / pockets]) translate([pocket_circle_r, 0, -pocket_drop - 1])
        cylinder(r1 = 24, r2 = 16, h = pocket_drop, $fn = 24);
      for (i = [0:7]) rotate([0, 0, 45 * i]) translate([130, 0, carousel_height - 30]) cylinder(r = 24, h = 31, $fn = 24);
    }
    between([-46, 0, 154], [46, 596, 232]);
    between([-46, 524, 114], [-carousel.x - column_half_width + 10, 596, 272]);
  }
}

// ------------------------------------------------------------------------------------------------- y_saddle, x_table
module saddle() {
  difference() {
    chamfered([-saddle_half_width, saddle_front, saddle_bottom], [saddle_half_width, saddle_back, saddle_top], 10);
    for (y = [saddle_front, saddle_back])
      chamfered([-180, y - 30, saddle_bottom + 22], [180, y + 30, saddle_top - 22], 14);
  }
  for (x = [-240, 240], y = [saddle_front + 10, saddle_back - 110])
    between([x - 34, y, bed_top + 4], [x + 34, y + 100, saddle_bottom + 1]);
}

module x_rails() {
  for (y = x_rail_y)
    between([-saddle_half_width + 10, y - rail_w / 2, saddle_top - 8], [saddle_half_width - 10, y + rail_w / 2, saddle_top]);
}

module table() {
  w = table_size.x / 2;
  middle = table_front + table_size.y / 2;
  difference() {
    chamfered([-w, table_front, table_top - table_thickness], [w, table_front + table_size.y, table_top], 4);
    for (y = table_slots) {
      between([-w - 1, middle + y - table_slot_width / 2, table_top - 22], [w + 1, middle + y + table_slot_width / 2, table_top + 1]);
      between([-w - 1, middle + y - 12, table_top - 22], [w + 1, middle + y + 12, table_top - 12]);
    }
  }
  for (x = [-250, 160], y = x_rail_y)
    between([x, y - 34, saddle_top + 3], [x + 90, y + 34, table_top - table_thickness + 1]);
}

module support(r, y0, y1) {
  difference() {
    hull() {
      translate([0, 0, pivot_z]) y_cylinder(r - 6, y0, y1, fine);
      translate([0, 0, pivot_z]) y_cylinder(r, y0 + 6, y1 - 6, fine);
      between([-support_foot_half, y0, table_top], [support_foot_half, y1, table_top + 30]);
    }
    // Bores for the hub.
    translate([0, 0, pivot_z]) y_cylinder(flange_r + 4, y0 < 0 ? y1 - 10 : y0 - 10, y0 < 0 ? y1 + 10 : y0 + 10, 48);
  }
}

module supports() {
  difference() {
    support(front_support_r, -front_support_end, -support_start);
    translate([0, -front_support_end + 5, pivot_z]) rotate([90, 0, 0])
      bolt_circle(50, 8, 22.5) cylinder(r = 6, h = 20, $fn = 12);
    for (side = [-1, 1])
      translate([side * 92, -front_support_end - 1, table_top + 14]) y_cylinder(9, 0, 18, 16);
  }
  difference() {
    support(rear_support_r, support_start, rear_support_end);
    translate([0, rear_support_end + 10, pivot_z]) rotate([90, 0, 0])
      bolt_circle(74, 10) cylinder(r = 7, h = 18, $fn = 12);
  }
  between([-support_foot_half + 20, table_front + table_size.y, table_top - 26],
          [support_foot_half - 20, rear_support_end - 20, table_top + 1]);
}

// ------------------------------------------------------------------------------------------------ b_cradle, c_platter
module cradle() {
  difference() {
    union() {
      along_y([[-cradle_half_bottom, cradle_bottom], [cradle_half_bottom, cradle_bottom],
               [cradle_half_top, cradle_top - 20], [cradle_half_top, cradle_top], [-cradle_half_top, cradle_top],
               [-cradle_half_top, cradle_top - 20]], -arm_inner - 1, arm_inner + 1);
      for (side = [-1, 1]) {
        y0 = side < 0 ? -arm_outer : arm_inner;
        y1 = side < 0 ? -arm_inner : arm_outer;
        hull() {
          y_cylinder(arm_hub_r, y0, y1, fine);
          between([-arm_half_width, y0, cradle_bottom + 30], [arm_half_width, y1, cradle_top]);
        }
        hull() {
          between([-arm_half_width, y0, cradle_bottom + 30], [arm_half_width, y1, cradle_top]);
          between([-cradle_half_bottom, y0, cradle_bottom], [cradle_half_bottom, y1, cradle_bottom + 8]);
        }
        y_cylinder(flange_r, side < 0 ? -flange_end : arm_outer - 1, side < 0 ? -arm_outer + 1 : flange_end, 64);
      }
      translate([0, 0, c_motor_bottom]) cylinder(r = c_motor_r, h = cradle_bottom - c_motor_bottom + 1, $fn = 64);
    }
    for (side = [-1, 1], y = [-100, 16])
      chamfered([side * 86 - 22, y, cradle_bottom + 12], [side * 86 + 22, y + 84, cradle_top - 24], 10);
    for (i = [0:3]) translate([0, 0, c_motor_bottom + 8 + 9 * i]) difference() {
      cylinder(r = c_motor_r + 1, h = 4, $fn = 64);
      translate([0, 0, -1]) cylinder(r = c_motor_r - 4, h = 6, $fn = 64);
    }
  }
}

module t_slot() {
  between([0, -slot_width / 2, -slot_depth], [platter_d, slot_width / 2, 1]);
  between([0, -slot_foot_width / 2, -slot_depth], [platter_d, slot_foot_width / 2, -slot_depth + slot_foot_height]);
}

module platter() {
  r = platter_d / 2;
  difference() {
    rotate_extrude($fn = 2 * fine)
      polygon([[0, 0], [r - 2, 0], [r, -2], [r, -platter_thickness + 10], [r - 8, -platter_thickness],
               [neck_r, -platter_thickness], [neck_r, -platter_thickness - neck_height],
               [0, -platter_thickness - neck_height]]);
    for (i = [0:5]) rotate([0, 0, 60 * i]) translate([42, 0, 0]) t_slot();
    translate([0, 0, -20]) cylinder(r = platter_bore_d / 2, h = 25, $fn = 48);
    for (radius = [60, 85]) translate([0, 0, -0.6]) difference() {
      cylinder(r = radius + 0.5, h = 1, $fn = fine);
      translate([0, 0, -1]) cylinder(r = radius - 0.5, h = 3, $fn = fine);
    }
  }
}

// ------------------------------------------------------------------------------------------------------ z_head, spindle
module nose(first, last) {
  rotate_extrude($fn = fine) polygon(concat([[0, nose_heights[first]]],
    [for (i = [first:last]) [nose_radii[i] - nose_slack, nose_heights[i]]], [[0, nose_heights[last]]]));
}

module head() {
  h = head_half;
  difference() {
    union() {
      nose(1, 3);
      hull() {
        chamfered([-h, head_front, head_bottom + 60], [h, head_back, head_top - 60], 16);
        chamfered([-h + 24, head_front + 24, head_bottom], [h - 24, head_back - 10, head_bottom + 10], 4);
        chamfered([-h + 20, head_front + 30, head_top - 10], [h - 20, head_back - 10, head_top], 4);
      }
      chamfered([-190, head_back - 60, head_bottom + 20], [190, head_back, head_top], 8);
    }
    // Cover joints and vents.
    for (z = [head_bottom + 190, head_top - 150])
      difference() {
        between([-h - 1, head_front - 1, z], [h + 1, head_back - 80, z + 4]);
        between([-h + 4, head_front + 4, z - 1], [h - 4, head_back, z + 5]);
      }
    for (side = [-1, 1], i = [0:6])
      between([side * h - 4, -40, head_top - 120 + 12 * i], [side * h + 4, 120, head_top - 115 + 12 * i]);
  }
  for (side = [-1, 1], z = [head_bottom + 30, head_top - 130])
    between([side * z_rail_x - 34, head_back - 1, z], [side * z_rail_x + 34, column_front - 5, z + 100]);
  // Spindle motor and drawbar cylinder.
  translate([0, 0, head_top - 1]) cylinder(r = head_motor_half - 5, h = 200, $fn = 64);
  translate([0, 0, head_top + 190]) cylinder(r = 62, h = head_motor_top - head_top - 190, $fn = 64);
}

module spindle() {
  difference() {
    union() {
      rotate_extrude($fn = fine) polygon([[0, 0], [spindle_face_r, 0], [spindle_face_r, 6],
        [nose_radii[0] - nose_slack, 6], [nose_radii[1] - nose_slack, 20], [0, 20]]);
    }
    translate([0, 0, -0.01]) cylinder(r1 = taper_d / 2, r2 = taper_d / 2 - 18 * 7 / 48, h = 18, $fn = 48);
    translate([0, 0, -1]) for (a = [0, 180]) rotate([0, 0, a]) between([24, -8.1, 0], [spindle_face_r + 2, 8.1, 5]);
    translate([0, 0, 5.5]) bolt_circle(54, 6) cylinder(r = 3.5, h = 5, $fn = 12);
  }
}

if (part == "base") base();
else if (part == "z_rails") z_rails();
else if (part == "enclosure_left") enclosure_left();
else if (part == "enclosure_right") enclosure_right();
else if (part == "enclosure_back") enclosure_back_panel();
else if (part == "enclosure_front") enclosure_front_panel();
else if (part == "enclosure_glass") enclosure_glass();
else if (part == "panel") panel();
else if (part == "panel_screen") panel_screen();
else if (part == "tool_changer") tool_changer();
else if (part == "saddle") saddle();
else if (part == "x_rails") x_rails();
else if (part == "table") table();
else if (part == "supports") supports();
else if (part == "cradle") cradle();
else if (part == "platter") platter();
else if (part == "head") head();
else if (part == "spindle") spindle();
else assert(false, str("no such part: ", part));
