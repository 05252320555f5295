// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/window.h"

#include <cstdint>
#include <utility>

#include "sim/base/digest.h"

namespace ncsim::motion {

namespace {

constexpr std::uint64_t kMarkedEvery = 1024;

bool Marked(const JointVector& q) {
  const auto bytes = static_cast<std::size_t>(q.size()) * sizeof(double);
  return DigestOf({reinterpret_cast<const char*>(q.data()), bytes}).words[0] % kMarkedEvery == 0;
}

}  // namespace

WindowCutter::WindowCutter() { window_.motions.reserve(kWindowSize); }

bool WindowCutter::EndsBefore(const Motion& motion) const {
  const std::vector<Motion>& motions = window_.motions;
  if (motions.empty()) return false;
  if (motions.back().facts.tool != motion.facts.tool || motions.size() >= kWindowSize) return true;
  return motions.size() >= kShortest && Marked(motions.back().q1());
}

Window WindowCutter::Add(const Motion& motion) {
  Window full;
  if (EndsBefore(motion)) full = Take();
  window_.motions.push_back(motion);
  return full;
}

Window WindowCutter::Take() {
  Window window = std::exchange(window_, {});
  window_.motions.reserve(kWindowSize);
  return window;
}

}  // namespace ncsim::motion
