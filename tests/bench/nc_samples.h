// SPDX-License-Identifier: BSD-3-Clause
// Programs made for benchmarks and memory tests; the same bytes every time.
#pragma once

#include <string>

namespace ncsim::bench {

/// A three-axis program in mm of `blocks` numbered feed blocks (short moves on a wavy surface),
/// which a Haas and LinuxCNC's rs274 both take.
std::string WavySurface(int blocks);

}  // namespace ncsim::bench
