// SPDX-License-Identifier: BSD-3-Clause
// Contacts in words.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/base/finding.h"
#include "sim/collision/pairs.h"
#include "sim/machine/machine.h"
#include "sim/motion/motion.h"

namespace ncsim::collision {

/// "holder of T3" for "T3.holder"; other names as they are.
std::string Spoken(const std::string& body);

/// Axis letters and NC values (mm, deg) at q.
std::vector<std::pair<char, double>> AxisValues(const machine::Machine& machine,
                                                const motion::JointVector& q);

/// "X-81.280 Y0.000 Z-312.400 B-20.000 C45.000"
std::string Spoken(const std::vector<std::pair<char, double>>& axes);

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
