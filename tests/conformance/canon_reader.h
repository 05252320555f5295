// SPDX-License-Identifier: BSD-3-Clause
// Canonical machining calls as LinuxCNC's `rs274 -g` prints them, applied in order to a plain
// machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/conformance/canon_step.h"

namespace ncsim::conformance {

struct Canon {
  std::vector<Step> steps;
  bool ends = false;  ///< PROGRAM_END was reached.
  std::string
      unknown_call;  ///< The first call that this reader has no rule for; then `steps` stop there.
};

/// Reads the text of a `.canon` or `expected` file: one call a line, behind a block number and
/// perhaps a line number. Offsets, rotation, tool length, plane and units are applied: the steps
/// are in machine coordinates.
Canon ReadCanon(std::string_view text);

/// The text of a file, unpacked where its name ends in .gz; nullopt if it cannot be read.
std::optional<std::string> ReadText(const std::string& path);

}  // namespace ncsim::conformance
