// SPDX-License-Identifier: BSD-3-Clause
// Every dimension of the model, mm. What is PUBLISHED, and where, and what is NOMINAL: see ../README.md.
//
// Machine frame: the origin is where the gauge point stands with all axes at machine zero, so that a point's coordinates
// are the machine values that bring the gauge point there. X right, Y to the column, Z up, seen from the operator.

// --- PUBLISHED -------------------------------------------------------------------------------------------------------
travel_min = [-762, -508, -444.5];
travel_max = [0, 0, 63.5];
platter_drop = 50.8;               // B axis to platter face
platter_d = 500;
slot_count = 7;
slot_pitch = 63;
slot_width = 16;

// --- NOMINAL: rotary centre ------------------------------------------------------------------------------------------
pivot = [-381, -254, -495.7];      // where the B and C axes meet (settings 255-257): each machine has its own

// --- NOMINAL: table --------------------------------------------------------------------------------------------------
// Heights from the B axis, y from the pivot.
slot_depth = 24;
slot_foot_width = 28;
slot_foot_height = 11;
platter_thickness = 50;
platter_bore_d = 50;
hub_gap_r = 172;                   // neck between platter and cradle
neck_height = 18;
c_housing_r = 178;
c_motor_r = 105;
c_motor_bottom = -272;
cradle_top = -124;
cradle_bottom = -240;
cradle_half_top = 190;
cradle_half_bottom = 130;
arm_inner = 262;
arm_outer = 322;
arm_hub_r = 115;
arm_half_width = 150;
disc_r = 180;                      // rotary drive, rear
disc_end = 372;
shaft_r = 80;                      // support bearing, front
shaft_end = 352;

// --- NOMINAL: base ---------------------------------------------------------------------------------------------------
floor_z = -1480;
base_half_width = 750;             // from the pivot's x
bed_front = -810;
bed_top = -850;                    // bottom of the trough
bed_shoulder = -745;
trough_half = 300;
rear_base_front = 306;
rear_base_back = 1000;
rear_base_top = -150;
drive_housing_r = 205;
drive_housing_start = 382;         // from the pivot
bearing_housing_r = 135;
bearing_housing_start = 356;
bearing_housing_end = 476;
rail_w = 46;
rail_h = 32;
x_rail_y = [440, 910];

// --- NOMINAL: column carriage (X), ram (Y), head (Z), at machine zero -------------------------------------------------
column_half_width = 325;
column_front = 352;
column_back = 990;
column_bottom = -116;
column_deck = 262;                 // the ram's rails stand here
column_top = 800;
cheek_thickness = 85;
ram_half_width = 205;
ram_bottom = 305;
ram_top = 730;
ram_front = 262;
ram_back = 1505;
ram_plate_half_width = 226;
ram_plate_bottom = 292;
ram_plate_top = 770;
ram_plate_thickness = 60;
z_motor_top = 960;

// Head, heights above the gauge line. Radii of the nose: the most that the collision shape takes; the visual lies inside.
nose_heights = [0, 25, 50, 100, 150];
nose_radii = [100, 128, 145, 162, 182];
nose_slack = 3;                    // visual within the collision shape
head_half = 150;                   // octagon of the lower head
head_corner = 92;
head_lower_top = 430;
head_upper_bottom = 530;
head_upper_half = 185;
head_back = 226;
head_back_bottom = 262;
head_top = 1150;
head_rail_h = 17;
spindle_taper_d = 44.45;           // 7/24 taper no. 40 at the gauge line
spindle_face_r = 52;

// --- NOMINAL: enclosure and tool changer ------------------------------------------------------------------------------
wall = 40;
enclosure_half_width = 900;        // inside, from the pivot's x
enclosure_front = -1020;           // inside
enclosure_back = 1000;
enclosure_bottom = -1400;
enclosure_top = 760;
front_top = 420;
door_half_width = 520;
cabinet_front = 1110;
cabinet_back = 1500;
cabinet_top = 120;
carousel_x = [-1262, -1140];
carousel_y = -60;
carousel_z = 330;
carousel_r = 330;
pockets = 40;
