// SPDX-License-Identifier: BSD-3-Clause
// The families of planted cases. Each makes a case from the state of `random`, a hit or a near
// miss; nullopt where the draw cannot be had (draw again).
#pragma once

#include <optional>

#include "tests/planted/planted_case.h"

namespace ncsim::planted {

std::optional<Case> ThinWall(Random* random, bool hit);
std::optional<Case> PinThroughSlot(Random* random, bool hit);
std::optional<Case> Grazing(Random* random, bool hit);
std::optional<Case> Contained(Random* random, bool hit);
std::optional<Case> LongRapid(Random* random, bool hit);
std::optional<Case> DogLegPolyline(Random* random, bool hit);
std::optional<Case> DogLegAccelerated(Random* random, bool hit);
std::optional<Case> TcpDip(Random* random, bool hit);
std::optional<Case> FarRotation(Random* random, bool hit);
std::optional<Case> HolderInPocket(Random* random, bool hit);
std::optional<Case> HeadOverTable(Random* random, bool hit);
std::optional<Case> WrapAt360(Random* random, bool hit);

}  // namespace ncsim::planted
