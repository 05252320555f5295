// SPDX-License-Identifier: BSD-3-Clause
// What the check of a pair over a run of motions leaves, as bytes and back. Whatever counts from
// the start of the program is kept as counted from the start of the run.
#pragma once

#include <string>
#include <string_view>

#include "sim/collision/content.h"
#include "sim/collision/pair_check.h"

namespace ncsim::collision {

/// The outcome; but for PairCarry::least, which follows from it, what is carried on; and `blank`,
/// the pair's, if it has one.
std::string PackOutcome(const PairOutcome& outcome, const PairCarry& carry, const BlankState* blank,
                        const RunPlace& place);

/// With `carry` and `blank` as they were before the check. False, and nothing changed, for bytes
/// that are no such thing.
bool UnpackOutcome(std::string_view bytes, const RunPlace& place, PairOutcome* outcome,
                   PairCarry* carry, BlankState* blank);

}  // namespace ncsim::collision
