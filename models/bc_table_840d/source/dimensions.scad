// SPDX-License-Identifier: BSD-3-Clause
// Every dimension of the model, mm. What is PUBLISHED and what is NOMINAL: see ../README.md.
//
// Machine frame: the origin is where the gauge point stands with all axes at machine zero. X right, Y to the column, Z up,
// seen from the operator. What the table carries is drawn where it stands at X0 Y0.

// --- PUBLISHED -------------------------------------------------------------------------------------------------------
table_size = [700, 420];
pockets = 16;
travel = [500, 300, 500];

// --- NOMINAL: how the travels lie ------------------------------------------------------------------------------------
travel_min = [-250, -150, -500];
travel_max = [250, 150, 0];

// --- NOMINAL: B and C ------------------------------------------------------------------------------------------------
// Heights from the B axis, which stands so low that nothing on the table comes up to the lowest gauge line.
pivot_z = -650;                    // where the B and C axes meet, over X0 Y0
platter_drop = 25;                 // B axis to platter face
platter_d = 220;
platter_thickness = 40;
platter_bore_d = 40;
slot_width = 12;
slot_foot_width = 20;
slot_foot_height = 8;
slot_depth = 18;
neck_r = 75;
neck_height = 15;
cradle_top = -85;
cradle_bottom = -145;
cradle_half_top = 92;
cradle_half_bottom = 70;
c_motor_r = 58;
c_motor_bottom = -190;
arm_inner = 124;
arm_outer = 162;
arm_hub_r = 62;
arm_half_width = 72;
flange_end = 170;                  // of the hub, at the supports
flange_r = 50;

// --- NOMINAL: table (X) and saddle (Y) -------------------------------------------------------------------------------
table_top = -880;
table_thickness = 60;
table_front = -232;                // so that the supports stand on it
table_slots = [-120, 0, 120];      // y of the T-slots, from the middle of the table
table_slot_width = 14;
support_start = 172;               // from the B axis' middle, both sides
front_support_end = 226;
front_support_r = 72;
rear_support_end = 300;
rear_support_r = 98;
support_foot_half = 130;
saddle_top = -962;
saddle_bottom = -1062;
saddle_half_width = 320;
saddle_front = -240;
saddle_back = 200;
rail_w = 34;
rail_h = 24;
x_rail_y = [-150, 110];

// --- NOMINAL: base and column ----------------------------------------------------------------------------------------
floor_z = -1560;
bed_top = -1088;                   // the saddle's rails stand here
bed_half_width = 420;
bed_front = -440;
bed_back = 1020;
column_half_width = 270;
column_front = 500;
column_back = 1000;
column_top = 760;
z_rail_x = 150;

// --- NOMINAL: head, heights above the gauge line ---------------------------------------------------------------------
nose_heights = [0, 20, 60, 120];
nose_radii = [64, 74, 96, 120];    // the most that the collision shape takes; the visual lies inside
nose_slack = 3;
head_half = 130;
head_front = -130;
head_bottom = 118;
head_top = 640;
head_back = 470;
head_motor_half = 95;
head_motor_top = 960;
taper_d = 44.45;                   // 7/24 taper no. 40 at the gauge line
spindle_face_r = 46;

// --- NOMINAL: tool changer and enclosure -----------------------------------------------------------------------------
carousel = [-480, 20, 210];        // centre of the disc's lower face; pockets hang from it
carousel_r = 236;
carousel_height = 60;
pocket_circle_r = 204;
pocket_drop = 42;
wall = 36;
enclosure_half_width = 780;        // inside
enclosure_front = -580;            // inside
enclosure_back = 1000;
enclosure_bottom = -1500;
enclosure_top = 640;
front_top = 420;
door_half_width = 480;
cabinet_back = 1380;
cabinet_front = 1060;
cabinet_half_width = 620;
cabinet_top = 300;
