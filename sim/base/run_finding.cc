// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/run_finding.h"

#include <string>

namespace ncsim {

void RunFinding::Add(const SourcePosition& where) {
  const bool same_block = where.line == last_.line && where.file == last_.file;
  if (blocks_ == 0 || !same_block) ++blocks_;
  last_ = where;
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
