// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/nc_samples.h"

#include <cmath>

#include "sim/base/text.h"

namespace ncsim::bench {

std::string WavySurface(int blocks) {
  std::string text = "%\nO00001 (WAVY SURFACE)\nG21 G90 G17 G94 G40 G80\nT1 M06\nG54\nS8000 M03\n";
  text += "G00 X0. Y0.\nG43 H01 Z50.\nG01 F2000.\n";
  for (int i = 0; i < blocks; ++i) {
    const double x = 0.3 * (i % 600);
    const double y = 0.5 * ((i / 600) % 300);
    const double z = 4.0 * std::sin(0.05 * x) * std::cos(0.07 * y) - 1e-4 * (i % 7);
    text += "N" + std::to_string(1 + i % 99999) + " X" + Fixed(x, 3) + " Y" + Fixed(y, 3) + " Z" +
            Fixed(z, 4) + "\n";
  }
  return text + "G00 Z50.\nM30\n%\n";
}

}  // namespace ncsim::bench
