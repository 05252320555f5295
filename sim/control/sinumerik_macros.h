// SPDX-License-Identifier: BSD-3-Clause
// DEFINE name AS text: the text stands for the name in the blocks of its program (NC programming
// 12/2019, "Macro technique"). Macros do not nest, so that one pass is all.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/control/program_files.h"

namespace ncsim::control {

class SinumerikMacros {
 public:
  /// A program: its text and where it begins there (an archive holds more).
  using Scope = std::pair<const ProgramText*, std::size_t>;
  /// `line` is the DEFINE block, `name` a part of it. False: it is known by its name alone, as its
  /// text takes part in what is looked up in the program's own text (labels, control structures,
  /// definitions), or holds a macro.
  bool Define(Scope scope, std::string_view line, std::string_view name);
  /// Whether a name that means nothing else is one of those that Define() has not taken.
  bool IsNamedOnly(std::string_view name) const;

  struct Expanded {
    std::string line;
    std::vector<int> columns;  ///< Of each of its characters in the line as written, from 1.
  };
  /// nullopt: there is none in `line`.
  std::optional<Expanded> Expand(Scope scope, std::string_view line) const;

 private:
  using Key = std::pair<Scope, std::string>;
  std::map<Key, std::string> bodies_;  ///< By program and name in upper case.
  std::set<std::string> named_;        ///< Known by name alone.
};

}  // namespace ncsim::control
