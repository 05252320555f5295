// SPDX-License-Identifier: BSD-3-Clause
// Dome on a tapered wall, in program coordinates (G54): zero at the top of the dome. generate.py has the same numbers.
sphere_r = 60;
dome_angle = 35;      // polar angle where the dome ends
lean = 15;            // of the wall, from the vertical
wall_bottom = -45;
base_bottom = -65;
base_d = 120;

rim_r = sphere_r * sin(dome_angle);
rim_z = sphere_r * cos(dome_angle) - sphere_r;
foot_r = rim_r + tan(lean) * (rim_z - wall_bottom);

rotate_extrude($fn = 120) polygon(concat(
  [for (a = [0:2.5:dome_angle]) [sphere_r * sin(a), sphere_r * cos(a) - sphere_r]],
  [[foot_r, wall_bottom], [base_d / 2, wall_bottom], [base_d / 2, base_bottom], [0, base_bottom]]));
