// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/assumptions.h"

#include <algorithm>
#include <utility>

namespace ncsim::app {
namespace {

bool SameName(const std::string& a, const std::string& b) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

void Assume(Assumption assumption, std::vector<Assumption>* assumptions) {
  for (Assumption& known : *assumptions) {
    if (!SameName(known.name, assumption.name)) continue;
    if (assumption.places_metal && !known.places_metal) known = std::move(assumption);
    return;
  }
  assumptions->push_back(std::move(assumption));
}

std::vector<std::string> Accept(const std::vector<std::string>& names,
                                std::vector<Assumption>* assumptions) {
  std::vector<std::string> unused;
  for (const std::string& name : names) {
    const bool all = SameName(name, "all");
    bool used = all;
    for (Assumption& assumption : *assumptions) {
      if (!all && !SameName(name, assumption.name)) continue;
      assumption.accepted = true;
      used = true;
    }
    if (!used) unused.push_back(name);
  }
  return unused;
}

std::vector<Finding> OpenAssumptions(const std::vector<Assumption>& assumptions, bool strict) {
  std::vector<Finding> findings;
  for (const Assumption& assumption : assumptions) {
    if (assumption.accepted || !(assumption.places_metal || strict)) continue;
    findings.push_back(MakeFinding(Rule::kAssumed, {},
                                   assumption.name + " is assumed: " + assumption.text +
                                       "; state it in the job, or accept it with --assume \"" +
                                       assumption.name + "\""));
  }
  return findings;
}

}  // namespace ncsim::app
