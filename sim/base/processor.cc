// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/processor.h"

#if defined(__x86_64__)
// The header is the C library's and for C.
#define _Bool bool
#include <sys/platform/x86.h>
#undef _Bool
#endif

namespace ncsim {

#if defined(__x86_64__)
bool HasAvx2() { return CPU_FEATURE_ACTIVE(AVX2); }
bool HasFma() { return CPU_FEATURE_ACTIVE(FMA); }
#else
bool HasAvx2() { return false; }
bool HasFma() { return false; }
#endif

}  // namespace ncsim
