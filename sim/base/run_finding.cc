// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/run_finding.h"

#include <string>

namespace ncsim {

namespace {

bool SameBlock(const SourcePosition& a, const SourcePosition& b) {
  return a.line == b.line && a.file == b.file;
}

}  // namespace

void RunFinding::Add(const SourcePosition& where) {
  if (blocks_ == 0) first_ = where;
  if (blocks_ == 0 || !SameBlock(where, last_)) ++blocks_;
  last_ = where;
}

void RunFinding::Append(const RunFinding& next) {
  blocks_ += next.blocks_ - (SameBlock(next.first_, last_) ? 1 : 0);
  last_ = next.last_;
}

Finding RunFinding::Take() {
  if (blocks_ > 1) {
    finding_.message += " (" + std::to_string(blocks_) + " blocks, the last is line " +
                        std::to_string(last_.line) + ")";
  }
  Finding finding = std::move(finding_);
  *this = RunFinding();
  return finding;
}

void RunFinding::Close(std::vector<Finding>* findings) {
  if (open()) findings->push_back(Take());
}

}  // namespace ncsim
