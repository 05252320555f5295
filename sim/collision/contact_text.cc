// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/contact_text.h"

#include "sim/base/text.h"

namespace ncsim::collision {

std::string Spoken(const std::string& body) {
  const std::size_t dot = body.find('.');
  const bool tool = body.size() > 1 && body[0] == 'T' && dot != std::string::npos &&
                    body.find_first_not_of("0123456789", 1) == dot;
  return tool ? body.substr(dot + 1) + " of " + body.substr(0, dot) : body;
}

std::string Verb(const std::string& body, const char* one, const char* many) {
  return Spoken(body) != body && body.ends_with(".flutes") ? many : one;
}

std::string DescribeContact(const Pair& pair, const ContactWords& words, const std::string& where) {
  const std::string a = Spoken(pair.names.front());
  const std::string b = Spoken(pair.names.back());
  const auto a_does = [&](const char* one, const char* many) {
    return a + " " + Verb(pair.names.front(), one, many);
  };
  const bool deep = words.has_depth && words.depth >= 0.005;
  const std::string depth = Short(words.depth, 2) + " mm";
  const std::string at =
      " at " + where + (words.only_lag ? " (with the machine's acceleration)" : "");
  switch (words.rule) {
    case Rule::kRapidContact:
      return "rapid takes " + a + " " + depth + " into " + b + " (tolerance " +
             Short(words.tolerance, 3) + " mm)" + at;
    case Rule::kGouge:
      return a_does("cuts", "cut") + " " + depth + " into " + b + " (tolerance " +
             Short(words.tolerance, 3) + " mm)" + at;
    case Rule::kSpindleStopped:
      return "feed takes " + a + " into " + b + " with the spindle stopped" + at;
    case Rule::kStockContact:
      if (words.severity == Severity::kWarning) {
        return a_does("goes", "go") + (deep ? " " + depth : "") + " into the initial blank " + b +
               ", and removal of stock is not simulated" + at;
      }
      return a_does("hits", "hit") + " the uncut blank " + b + (deep ? " " + depth + " deep" : "") +
             at;
    default:
      if (words.has_depth && !deep) return a_does("touches", "touch") + " " + b + at;
      return a_does("hits", "hit") + " " + b + (deep ? " " + depth + " deep" : "") + at;
  }
}

}  // namespace ncsim::collision
