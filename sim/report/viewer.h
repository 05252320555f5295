// SPDX-License-Identifier: BSD-3-Clause
// The files of sim/report/viewer, and three.js, as they were when this was built.
#pragma once

#include <string_view>

namespace ncsim::report {

std::string_view ViewerIndex();
std::string_view ViewerStyle();
/// All scripts of the viewer, one behind the other.
std::string_view ViewerScript();
std::string_view ViewerThree();

}  // namespace ncsim::report
