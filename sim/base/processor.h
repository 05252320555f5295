// SPDX-License-Identifier: BSD-3-Clause
// What this processor has, as the C library sees it: GLIBC_TUNABLES can make a program run as on an
// older one. False on other processors than x86-64.
#pragma once

namespace ncsim {

bool HasAvx2();
bool HasFma();

}  // namespace ncsim
