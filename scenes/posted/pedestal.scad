// SPDX-License-Identifier: BSD-3-Clause
// A pedestal on the middle of either table; the part sits on it, held from below.
$fn = 48;
union() {
  cylinder(d = 150, h = 20);
  cylinder(d = 80, h = 140);
}
