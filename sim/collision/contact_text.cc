// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/contact_text.h"

#include "sim/base/text.h"
#include "sim/base/units.h"

namespace ncsim::collision {

std::string Spoken(const std::string& body) {
  const std::size_t dot = body.find('.');
  const bool tool = body.size() > 1 && body[0] == 'T' && dot != std::string::npos &&
                    body.find_first_not_of("0123456789", 1) == dot;
  return tool ? body.substr(dot + 1) + " of " + body.substr(0, dot) : body;
}

std::vector<std::pair<char, double>> AxisValues(const machine::Machine& machine,
                                                const motion::JointVector& q) {
  std::vector<std::pair<char, double>> values;
  for (const machine::Axis& axis : machine.axes) {
    values.emplace_back(axis.letter, axis.rotary ? Degrees(q[axis.joint]) : q[axis.joint]);
  }
  return values;
}

std::string Spoken(const std::vector<std::pair<char, double>>& axes) {
  std::string text;
  for (const auto& [letter, value] : axes) {
    if (!text.empty()) text += ' ';
    text += letter + Fixed(value, 3);
  }
  return text;
}

std::string DescribeContact(const Pair& pair, const ContactWords& words, const std::string& where) {
  const std::string a = Spoken(pair.names.front());
  const std::string b = Spoken(pair.names.back());
  const bool deep = words.has_depth && words.depth >= 0.005;
  const std::string depth = Short(words.depth, 2) + " mm";
  const std::string at =
      " at " + where + (words.only_lag ? " (with the machine's acceleration)" : "");
  switch (words.rule) {
    case Rule::kRapidContact:
      return "rapid takes " + a + " " + depth + " into " + b + " (tolerance " +
             Short(words.tolerance, 3) + " mm)" + at;
    case Rule::kGouge:
      return a + " cut " + depth + " into " + b + " (tolerance " + Short(words.tolerance, 3) +
             " mm)" + at;
    case Rule::kSpindleStopped:
      return "feed takes " + a + " into " + b + " with the spindle stopped" + at;
    case Rule::kStockContact:
      if (words.severity == Severity::kWarning) {
        return a + " goes" + (deep ? " " + depth : "") + " into the initial blank " + b +
               ", and removal of stock is not simulated" + at;
      }
      return a + " hits the uncut blank " + b + (deep ? " " + depth + " deep" : "") + at;
    default:
      if (words.has_depth && !deep) return a + " touches " + b + at;
      return a + " hits " + b + (deep ? " " + depth + " deep" : "") + at;
  }
}

}  // namespace ncsim::collision
