// SPDX-License-Identifier: BSD-3-Clause
// Contacts in words.
#pragma once

#include <string>

#include "sim/base/finding.h"
#include "sim/collision/pairs.h"

namespace ncsim::collision {

/// "holder of T3" for "T3.holder"; other names as they are.
std::string Spoken(const std::string& body);

/// `one` or `many`: the flutes of a tool are many.
std::string Verb(const std::string& body, const char* one, const char* many);

/// What a message about a contact needs to know.
struct ContactWords {
  Rule rule = Rule::kCollision;
  Severity severity = Severity::kError;
  double depth = 0.0;  ///< mm; below 0.005: "touches".
  bool has_depth = true;
  bool only_lag = false;   ///< Not on the polyline of infinite acceleration.
  double tolerance = 0.0;  ///< mm, of the rule.
};

/// "holder of T3 hits vise_jaw 1.4 mm deep at X...", by rule.
std::string DescribeContact(const Pair& pair, const ContactWords& words, const std::string& where);

}  // namespace ncsim::collision
