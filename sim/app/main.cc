// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "sim/app/app.h"

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  return ncsim::app::Run({argv + 1, argv + argc}, std::cout, std::cerr);
}
