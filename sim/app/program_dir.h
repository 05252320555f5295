// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ncsim::app {

/// Folder of the running executable, for models that are installed beside it; "" where the system
/// does not say.
std::string ProgramDir();

}  // namespace ncsim::app
