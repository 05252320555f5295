// SPDX-License-Identifier: BSD-3-Clause
// Detailed shapes, each in the frame of its link: base and carriage, ram and head as they stand at machine zero in the
// machine frame, the trunnion about the pivot, the platter about the centre of its face.
include <dimensions.scad>
use <../../tools/shapes.scad>
part = "platter";
fine = 96;

module at_pivot_xy() { translate([pivot.x, 0, 0]) children(); }

// ---------------------------------------------------------------------------------------------------------- base_link
module bed() {
  w = base_half_width;
  difference() {
    along_y([[-w, floor_z + 60], [-w + 40, floor_z + 20], [w - 40, floor_z + 20], [w, floor_z + 60],
             [w, bed_shoulder], [w - 40, bed_shoulder], [trough_half, bed_top], [-trough_half, bed_top],
             [-w + 40, bed_shoulder], [-w, bed_shoulder]], bed_front, rear_base_front + 20);
    // Chip augers, left and right of the trough.
    for (side = [-1, 1])
      translate([side * 470, 0, -815]) y_cylinder(62, bed_front - 1, rear_base_front - 40, 40);
    // Lightening pockets in the front face.
    for (x = [-480, 0, 480])
      chamfered([x - 190, bed_front - 60, floor_z + 110], [x + 190, bed_front + 40, -960], 30);
  }
  for (x = [-620, 0, 620], y = [bed_front + 110, 60, 880])
    translate([x, y, floor_z]) cylinder(r = 55, h = 40, $fn = 32);
}

module rear_base() {
  w = base_half_width - 10;
  difference() {
    along_x([[rear_base_front, floor_z + 20], [rear_base_back, floor_z + 20], [rear_base_back, rear_base_top],
             [rear_base_front + 70, rear_base_top], [rear_base_front, rear_base_top - 90]], -w, w);
    for (side = [-1, 1]) {
      chamfered([side * 560 - 130, rear_base_front - 60, -620], [side * 560 + 130, rear_base_front + 50, -300], 30);
      chamfered([side * w - 50, rear_base_front + 120, -1200], [side * w + 50, rear_base_back - 120, -320], 30);
    }
  }
}

module front_pedestal() {
  difference() {
    union() {
      hull() {
        translate([0, pivot.y, pivot.z]) y_cylinder(bearing_housing_r, -bearing_housing_end + 16,
                                                    -bearing_housing_start, fine);
        between([-250, pivot.y - bearing_housing_end + 16, bed_top - 20],
                [250, pivot.y - bearing_housing_start, bed_top + 20]);
      }
      hull() {
        between([-290, pivot.y - bearing_housing_end - 40, bed_top - 20],
                [290, pivot.y - bearing_housing_start, bed_top + 30]);
        between([-250, pivot.y - bearing_housing_end + 10, bed_top - 20],
                [250, pivot.y - bearing_housing_start, bed_top + 90]);
      }
      translate([0, pivot.y, pivot.z]) y_cylinder(108, -bearing_housing_end, -bearing_housing_start - 50, fine);
    }
    translate([0, pivot.y - bearing_housing_end + 6, pivot.z]) rotate([90, 0, 0])
      bolt_circle(90, 8, 22.5) cylinder(r = 8, h = 30, $fn = 12);
    chamfered([-130, pivot.y - bearing_housing_end - 10, bed_top + 130],
              [130, pivot.y - bearing_housing_end + 60, pivot.z - 190], 25);
  }
}

module drive_housing() {
  y0 = pivot.y + drive_housing_start;
  hull() {
    translate([0, 0, pivot.z]) y_cylinder(drive_housing_r - 12, y0, y0 + 12, fine);
    translate([0, 0, pivot.z]) y_cylinder(drive_housing_r, y0 + 12, rear_base_front + 30, fine);
    between([-320, y0 + 20, bed_top - 20], [320, rear_base_front + 30, bed_top + 60]);
  }
  for (side = [-1, 1])
    along_x([[rear_base_front + 10, bed_top - 40], [y0 + 60, bed_top - 40], [rear_base_front + 10, -560]],
            side * 370 - 20, side * 370 + 20);
}

module base() { at_pivot_xy() { bed(); rear_base(); front_pedestal(); drive_housing(); } }

module x_rails() {
  w = base_half_width - 20;
  at_pivot_xy() {
    for (y = x_rail_y)
      difference() {
        along_x([[y - rail_w / 2, rear_base_top - 2], [y + rail_w / 2, rear_base_top - 2],
                 [y + rail_w / 2, rear_base_top + 8], [y + 12, rear_base_top + 15], [y + rail_w / 2, rear_base_top + 24],
                 [y + rail_w / 2, rear_base_top + rail_h], [y - rail_w / 2, rear_base_top + rail_h],
                 [y - rail_w / 2, rear_base_top + 24], [y - 12, rear_base_top + 15],
                 [y - rail_w / 2, rear_base_top + 8]], -w, w);
        for (x = [-w + 40:120:w - 30]) translate([x, y, rear_base_top + 20]) cylinder(r = 8, h = 30, $fn = 12);
      }
    translate([0, 675, rear_base_top + 10]) x_cylinder(20, -w, w, 24);
    for (x = [-w, w - 60]) between([x, 620, rear_base_top - 2], [x + 60, 730, rear_base_top + 34]);
  }
}

// ---------------------------------------------------------------------------------------------------------- enclosure
module side_panel(x0, x1, outside) {
  difference() {
    chamfered([x0, enclosure_front - wall, enclosure_bottom], [x1, enclosure_back, enclosure_top], 8);
    for (y = [-900, -260, 380])
      chamfered([outside - 8, y, enclosure_bottom + 120], [outside + 8, y + 560, enclosure_top - 120], 7);
  }
}

// Closes the gap between the base and the side panel.
module back_post(x) {
  between([x - 77, enclosure_back - 30, enclosure_bottom + 10], [x + 77, enclosure_back - 5, rear_base_top - 150]);
}

module enclosure_left() {
  x = pivot.x - enclosure_half_width;
  side_panel(x - wall, x, x - wall);
  back_post(x + 70);
}

module enclosure_right() {
  x = pivot.x + enclosure_half_width;
  side_panel(x, x + wall, x + wall);
  back_post(x - 70);
}

module enclosure_back_panel() {
  at_pivot_xy() {
    difference() {
      chamfered([-700, cabinet_front, floor_z + 60], [700, cabinet_back, cabinet_top], 18);
      for (x = [-660, 20])
        chamfered([x, cabinet_back - 8, floor_z + 120], [x + 640, cabinet_back + 8, cabinet_top - 60], 7);
    }
  }
}

module window_pair(y0, y1, grow) {
  for (side = [-1, 1])
    chamfered([side * 262 - 190 - grow, y0, -560 - grow], [side * 262 + 190 + grow, y1, 180 + grow], 6);
}

module enclosure_front_panel() {
  y1 = enclosure_front;
  y0 = enclosure_front - wall;
  w = enclosure_half_width;
  at_pivot_xy() {
    difference() {
      chamfered([-w, y0, enclosure_bottom], [w, y1, front_top], 8);
      between([-door_half_width, y0 - 1, -780], [door_half_width, y1 + 1, front_top - 90]);
      for (x = [-850, 570]) chamfered([x, y0 - 8, -700], [x + 280, y0 + 8, front_top - 60], 7);
    }
    // Two sliding doors.
    difference() {
      for (side = [-1, 1])
        chamfered([side * 262 - 264, y0 - 12, -800], [side * 262 + 264, y1 - 4, front_top - 70], 10);
      window_pair(y0 - 30, y1 + 30, 0);
    }
    for (side = [-1, 1]) hull() for (z = [-420, -120])
      translate([side * 35, y0 - 46, z]) sphere(r = 11, $fn = 12);
    for (side = [-1, 1], z = [-420, -120])
      translate([side * 35, 0, z]) y_cylinder(9, y0 - 46, y0 - 5, 12);
    // Sill below the doors.
    hull() {
      between([-w + 60, y0 - 70, -840], [w - 60, y0 + 10, -800]);
      between([-w + 60, y0 - 5, -930], [w - 60, y0 + 10, -800]);
    }
  }
}

module enclosure_glass() {
  at_pivot_xy() window_pair(enclosure_front - wall + 10, enclosure_front - 12, 8);
}

module pendant() {
  y0 = enclosure_front - wall;
  at_pivot_xy() {
    translate([760, y0 - 165, -70]) rotate([0, 0, 18]) {
      chamfered([-190, -70, -420], [190, 70, 250], 16);
      hull() {
        between([-190, -150, -330], [190, -60, -300]);
        between([-190, -60, -350], [190, -50, -240]);
      }
    }
    hull() {
      between([700, y0 - 140, 170], [820, y0 - 100, 220]);
      between([740, y0 - 10, 170], [830, y0 + 10, 260]);
    }
  }
}

module pendant_screen() {
  at_pivot_xy() translate([760, enclosure_front - wall - 165, -70]) rotate([0, 0, 18])
    between([-160, -74, -40], [160, -66, 215]);
}

module tool_changer() {
  translate([0, carousel_y, carousel_z]) {
    difference() {
      union() {
        x_cylinder(carousel_r - 44, carousel_x[0] + 30, carousel_x[1] - 38, fine);
        x_cylinder(90, carousel_x[0], carousel_x[1] - 16, 48);
        for (i = [0:pockets - 1]) rotate([360 * i / pockets, 0, 0]) translate([0, 0, carousel_r - 22])
          x_cylinder(21, carousel_x[0] + 12, carousel_x[1], 16);
        for (i = [0:pockets - 1]) rotate([360 * i / pockets, 0, 0])
          between([carousel_x[0] + 30, -8, carousel_r - 60], [carousel_x[1] - 38, 8, carousel_r - 30]);
      }
      for (i = [0:7]) rotate([45 * i, 0, 0]) translate([0, 0, 190])
        x_cylinder(52, carousel_x[0] - 10, carousel_x[1] + 10, 32);
    }
    between([carousel_x[0] - 15, -110, -110], [carousel_x[0] + 34, 110, 110]);
  }
}

// --------------------------------------------------------------------------------------- x_carriage, y_ram, z_head
module column() {
  w = column_half_width;
  difference() {
    union() {
      // Foot over the rails, stem, deck.
      hull() {
        chamfered([-w, column_front, column_bottom], [w, column_back, column_bottom + 70], 10);
        chamfered([-w + 30, column_front + 20, column_bottom + 60], [w - 30, column_back - 20, column_bottom + 110], 10);
      }
      chamfered([-w + 30, column_front + 20, column_bottom + 40], [w - 30, column_back - 20, column_deck], 12);
      // Cheeks that hold the ram, and the bridge above it.
      for (side = [-1, 1])
        along_x([[column_front + 20, column_deck - 20], [column_back - 20, column_deck - 20],
                 [column_back - 20, column_top - 190], [column_back - 150, column_top],
                 [column_front + 110, column_top], [column_front + 20, column_top - 120]],
                side > 0 ? w - cheek_thickness - 8 : -w + 8, side > 0 ? w - 8 : -w + cheek_thickness + 8);
      chamfered([-w + 8, column_front + 110, column_top - 62], [w - 8, column_back - 150, column_top], 10);
    }
    // Openings in the front of the stem and in the cheeks.
    chamfered([-190, column_front - 60, column_bottom + 130], [190, column_front + 60, column_deck - 60], 25);
    for (side = [-1, 1])
      chamfered([side * w - 40, column_front + 150, column_deck + 90], [side * w + 40, column_back - 180,
                                                                        column_top - 170], 25);
    for (y = x_rail_y) between([-w - 1, y - 42, column_bottom - 1], [w + 1, y + 42, column_bottom + 12]);
  }
  for (y = x_rail_y, x = [-w + 20, w - 140])
    between([x, y - 40, column_bottom - 26], [x + 120, y + 40, column_bottom + 30]);
}

module y_rails() {
  for (x = [-150, 150])
    between([x - rail_w / 2, column_front + 30, column_deck - 2], [x + rail_w / 2, column_back - 30, column_deck + 30]);
}

module ram() {
  difference() {
    union() {
      chamfered([-ram_half_width, ram_front + 20, ram_bottom], [ram_half_width, ram_back, ram_top], 22);
      chamfered([-ram_plate_half_width, ram_front, ram_plate_bottom],
                [ram_plate_half_width, ram_front + ram_plate_thickness, ram_plate_top], 12);
      hull() {
        between([-120, ram_front + 12, ram_top - 30], [120, ram_front + 120, ram_plate_top + 20]);
        between([-70, ram_front + 12, ram_plate_top], [70, ram_front + 100, ram_plate_top + 60]);
      }
      translate([0, ram_front + 62, ram_plate_top + 40]) cylinder(r = 52, h = z_motor_top - ram_plate_top - 40, $fn = 48);
    }
    for (side = [-1, 1], y = [ram_front + 330, ram_front + 640, ram_front + 950])
      chamfered([side * ram_half_width - 14, y - 130, ram_bottom + 90], [side * ram_half_width + 14, y + 130,
                                                                         ram_top - 90], 13);
  }
  // Trucks for the head's rails.
  for (side = [-1, 1], z = [ram_plate_bottom + 50, ram_plate_top - 180])
    between([side * 120 - 46, ram_front - 24, z], [side * 120 + 46, ram_front + 5, z + 130]);
}

// The nose of the head, `slack` inside the collision shape.
module nose(h0, h1, slack) {
  rotate_extrude($fn = fine) polygon(concat([[0, h0]],
    [for (i = [0:len(nose_heights) - 1]) if (nose_heights[i] >= h0 && nose_heights[i] <= h1)
       [nose_radii[i] - slack, nose_heights[i]]], [[0, h1]]));
}

module octagon(half, corner, z0, z1) {
  translate([0, 0, z0]) linear_extrude(z1 - z0)
    polygon([[half, -corner], [half, corner], [corner, half], [-corner, half], [-half, corner], [-half, -corner],
             [-corner, -half], [corner, -half]]);
}

module head() {
  u = head_upper_half;
  difference() {
    union() {
      difference() {
        nose(25, 150, nose_slack);
        translate([0, 0, 25]) bolt_circle(106, 12) translate([0, 0, -1]) cylinder(r = 5, h = 8, $fn = 12);
      }
      octagon(head_half, head_corner, 149, head_lower_top + 1);
      hull() {
        octagon(head_half, head_corner, head_lower_top, head_lower_top + 1);
        chamfered([-u, -u, head_upper_bottom], [u, head_back, head_upper_bottom + 60], 14);
      }
      chamfered([-u, -u, head_upper_bottom], [u, head_back, head_top - 160], 18);
      hull() {
        chamfered([-u + 6, -u + 6, head_top - 200], [u - 6, head_back - 6, head_top - 150], 14);
        chamfered([-u + 60, -u + 70, head_top - 60], [u - 60, head_back - 60, head_top], 14);
      }
      chamfered([-head_half, 60, head_back_bottom], [head_half, head_back, head_upper_bottom + 40], 10);
    }
    // Panel joints and vents of the cover.
    for (z = [head_upper_bottom + 150, head_top - 300])
      difference() {
        between([-u - 1, -u - 1, z], [u + 1, head_back - 40, z + 5]);
        between([-u + 4, -u + 4, z - 1], [u - 4, head_back, z + 6]);
      }
    for (side = [-1, 1], i = [0:5])
      between([side * u - 5, -60, head_top - 280 + 16 * i], [side * u + 5, 110, head_top - 272 + 16 * i]);
  }
}

module head_rails() {
  for (side = [-1, 1])
    between([side * 120 - rail_w / 2, head_back - 2, head_back_bottom + 10],
            [side * 120 + rail_w / 2, head_back + head_rail_h, head_top - 170]);
}

module spindle() {
  difference() {
    union() {
      nose(0.0, 25, nose_slack + 36);
      translate([0, 0, 8]) cylinder(r1 = nose_radii[0] - 4, r2 = nose_radii[1] - nose_slack - 4, h = 17, $fn = fine);
    }
    translate([0, 0, -0.01]) cylinder(r1 = spindle_taper_d / 2, r2 = spindle_taper_d / 2 - 24 * 7 / 48, h = 24, $fn = 48);
    // Coolant nozzles.
    translate([0, 0, 7]) bolt_circle(86, 8, 22.5) cylinder(r = 6, h = 8, $fn = 12);
    translate([0, 0, -1]) for (a = [0, 180]) rotate([0, 0, a]) between([24, -8.2, 0], [48, 8.2, 6]);
  }
}

// ------------------------------------------------------------------------------------------- b_trunnion, c_platter
module cradle_arm(y0, y1) {
  hull() {
    y_cylinder(arm_hub_r, y0, y1, fine);
    between([-arm_half_width, y0, cradle_top - 30], [arm_half_width, y1, cradle_top]);
  }
  hull() {
    between([-arm_half_width, y0, cradle_top - 30], [arm_half_width, y1, cradle_top]);
    between([-cradle_half_bottom, y0, cradle_bottom], [cradle_half_bottom, y1, cradle_bottom + 10]);
  }
}

module cradle() {
  difference() {
    union() {
      along_y([[-cradle_half_bottom, cradle_bottom], [cradle_half_bottom, cradle_bottom],
               [cradle_half_top, cradle_top - 30], [cradle_half_top, cradle_top], [-cradle_half_top, cradle_top],
               [-cradle_half_top, cradle_top - 30]], -arm_inner - 1, arm_inner + 1);
      cradle_arm(-arm_outer, -arm_inner);
      cradle_arm(arm_inner, arm_outer);
      // Ribs between floor and arms.
      for (side = [-1, 1], x = [-110, 86]) along_x(
        [[side * arm_inner + side, cradle_top - 5], [side * (arm_inner - 34), cradle_top - 5],
         [side * arm_inner + side, cradle_top + 14]], x, x + 24);
      translate([0, 0, cradle_top - 2]) cylinder(r = c_housing_r, h = 5, $fn = fine);
      translate([0, 0, c_motor_bottom]) cylinder(r = c_motor_r, h = 60, $fn = 64);
    }
    for (side = [-1, 1]) {
      translate([0, side * (arm_outer - 14), 0]) rotate([-90 * side, 0, 0])
        bolt_circle(92, 10) cylinder(r = 7, h = 30, $fn = 12);
      for (y = [-170, 30])
        chamfered([side * 165 - 40, y, cradle_bottom + 20], [side * 165 + 40 , y + 140, cradle_top - 40], 15);
    }
    for (side = [-1, 1]) difference() {
      y_cylinder(76, side > 0 ? arm_inner - 1 : -arm_inner - 8, side > 0 ? arm_inner + 8 : -arm_inner + 1, 64);
      y_cylinder(40, -arm_outer, arm_outer, 48);
    }
  }
}

module drive_disc() {
  difference() {
    union() {
      y_cylinder(disc_r - 8, arm_outer, arm_outer + 8, fine);
      y_cylinder(disc_r, arm_outer + 7, disc_end, fine);
    }
    translate([0, arm_outer + 12, 0]) rotate([90, 0, 0]) bolt_circle(150, 16) cylinder(r = 8, h = 20, $fn = 12);
  }
  y_cylinder(shaft_r, -shaft_end, -arm_outer, 64);
}

module t_slot(x) {
  between([x - slot_width / 2, -platter_d, -slot_depth], [x + slot_width / 2, platter_d, 1]);
  between([x - slot_foot_width / 2, -platter_d, -slot_depth], [x + slot_foot_width / 2, platter_d,
                                                               -slot_depth + slot_foot_height]);
}

module platter() {
  r = platter_d / 2;
  difference() {
    rotate_extrude($fn = 2 * fine)
      polygon([[0, 0], [r - 3, 0], [r, -3], [r, -platter_thickness + 16], [r - 10, -platter_thickness],
               [hub_gap_r, -platter_thickness], [hub_gap_r, -platter_thickness - neck_height],
               [0, -platter_thickness - neck_height]]);
    rotate([0, 0, 90])
      for (i = [0:slot_count - 1]) t_slot((i - (slot_count - 1) / 2) * slot_pitch);
    translate([0, 0, -15]) cylinder(r = platter_bore_d / 2, h = 20, $fn = 48);
    // Edge mark at C0.
    between([r - 4, -1.5, -9], [r + 4, 1.5, 1]);
  }
}

if (part == "base") base();
else if (part == "x_rails") x_rails();
else if (part == "enclosure_left") enclosure_left();
else if (part == "enclosure_right") enclosure_right();
else if (part == "enclosure_back") enclosure_back_panel();
else if (part == "enclosure_front") enclosure_front_panel();
else if (part == "enclosure_glass") enclosure_glass();
else if (part == "pendant") pendant();
else if (part == "pendant_screen") pendant_screen();
else if (part == "tool_changer") tool_changer();
else if (part == "column") column();
else if (part == "y_rails") y_rails();
else if (part == "ram") ram();
else if (part == "head") head();
else if (part == "head_rails") head_rails();
else if (part == "spindle") spindle();
else if (part == "cradle") cradle();
else if (part == "drive_disc") drive_disc();
else if (part == "platter") platter();
else assert(false, str("no such part: ", part));
