// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/machine/machine.h"

namespace ncsim::machine {

/// What is wrong with a SINUMERIK's MD24100 (TRAFO_TYPE_1) on this machine; "" where it names the
/// machine's own chain, or (72) leaves it to a tool carrier. The URDF stays the one chain: this
/// only holds the two together.
std::string TrafoTypeFault(const Machine& machine, int type);

}  // namespace ncsim::machine
