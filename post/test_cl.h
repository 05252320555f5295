// SPDX-License-Identifier: BSD-3-Clause
// For tests: the events of a cutter-location text.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "post/cl_path.h"

namespace ncsim::post {

struct ClRun {
  std::vector<ClEvent> events;
  Diagnostics diagnostics;

  /// What happened of one kind, in order.
  template <class What>
  std::vector<What> All() const {
    std::vector<What> all;
    for (const ClEvent& event : events) {
      if (const What* what = std::get_if<What>(&event.what)) all.push_back(*what);
    }
    return all;
  }
  std::vector<ClMotion> motions() const { return All<ClMotion>(); }
  std::vector<ClHole> holes() const { return All<ClHole>(); }
  /// "12:3: message" of each error; of warnings with "warning: ".
  std::vector<std::string> messages() const {
    std::vector<std::string> texts;
    for (const Diagnostic& each : diagnostics.all()) {
      texts.push_back(std::to_string(each.line) + ":" + std::to_string(each.column) + ": " +
                      (each.level == Diagnostic::Level::kWarning ? "warning: " : "") +
                      each.message);
    }
    return texts;
  }
};

inline ClRun RunCl(std::string text, const ClOptions& options) {
  ClRun run;
  const auto program = nc::Program::FromText("test.cls", std::move(text));
  ClPath path(program, 0, options, &run.diagnostics);
  for (ClEvent event; path.Next(&event);) run.events.push_back(std::move(event));
  return run;
}

/// A text in mm whose tool does not matter.
inline ClRun RunCl(std::string text, ClFlavour flavour) {
  ClOptions options;
  options.flavour = flavour;
  options.unit = ClUnit::kMillimetre;
  options.need_tool = false;
  return RunCl(std::move(text), options);
}

/// `body` as one operation of NX, from line 2.
inline ClRun RunNx(const std::string& body) {
  return RunCl("TOOL PATH/OP,TOOL,T\n" + body + "END-OF-PATH\n", ClFlavour::kNx);
}
inline ClRun RunCreo(const std::string& body) {
  return RunCl("PARTNO / P\n" + body + "FINI\n", ClFlavour::kCreo);
}
inline ClRun RunSolidWorks(const std::string& body) {
  return RunCl("PARTNO/P\n" + body + "FINI\n", ClFlavour::kSolidWorksCam);
}

}  // namespace ncsim::post
