// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/explain.h"

#include <vector>

#include "sim/app/app.h"
#include "sim/base/finding.h"
#include "sim/base/text.h"

namespace ncsim::app {

std::string_view FindingsEntry(std::string_view rule) {
  const std::string_view text = FindingsText();
  const std::string heading = "\n## " + std::string(rule) + "\n";
  const std::size_t begin = text.find(heading);
  if (begin == std::string_view::npos) return "";
  const std::size_t end = text.find("\n## ", begin + heading.size());
  std::string_view entry = text.substr(begin + 1, end - begin - 1);
  while (entry.ends_with('\n')) entry.remove_suffix(1);
  return entry;
}

int Explain(const std::string& rule, std::ostream& out, std::ostream& err) {
  if (rule.empty()) {
    for (const RuleInfo& info : Rules()) {
      out << info.id << " (" << ToString(info.severity) << "): " << info.summary << "\n";
    }
    return kExitPass;
  }
  const std::string_view entry = FindingsEntry(rule);
  if (entry.empty()) {
    std::vector<std::string> known;
    for (const RuleInfo& info : Rules()) known.emplace_back(info.id);
    err << "ncsim: there is no rule '" << rule << "'" << DidYouMean(rule, known)
        << "; ncsim explain lists them\n";
    return kExitBadInput;
  }
  out << entry << "\n";
  return kExitPass;
}

}  // namespace ncsim::app
