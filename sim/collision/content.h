// SPDX-License-Identifier: BSD-3-Clause
// What the outcome of a pair over a run of motions depends on, as digests. Equal digests, equal
// outcomes; nothing of where the run stands in the program is in them.
#pragma once

#include <cstdint>

#include "sim/base/digest.h"
#include "sim/machine/scene.h"
#include "sim/machine/tool.h"
#include "sim/motion/travel.h"

namespace ncsim {
class ByteWriter;
}

namespace ncsim::collision {

struct BlankState;
struct PairCarry;
struct PairSetup;
struct ToolBody;

void PutDigest(const Digest& digest, ByteWriter* out);

Digest ContentOf(const machine::SceneBody& body);
Digest ContentOf(const ToolBody& body, const machine::Profile& profile);
/// The pair, its machine and its settings.
Digest ContentOf(const PairSetup& setup);

/// A run of motions in its program: what numbers in it are counted from.
struct RunPlace {
  std::uint64_t number = 0;  ///< Of the first motion.
  std::size_t size = 0;      ///< Motions.
  int cycle = 0;             ///< Facts::cycle of the first motion that has one.
};
RunPlace PlaceOf(const motion::Travel& run, std::uint64_t number);
Digest ContentOf(const motion::Travel& run, const RunPlace& place);

/// What passes from the runs before to this one. `blank` may be null.
Digest ContentOf(const PairCarry& carry, const BlankState* blank, const RunPlace& place);

}  // namespace ncsim::collision
