// SPDX-License-Identifier: BSD-3-Clause
// What a run looks at outside itself: contents of files, whether they are there, names in folders,
// environment. While all of it is as it was, the run would say the same again.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace ncsim {

struct Input {
  enum class Kind { kContent, kPlace, kListing, kVariable };
  Kind kind = Kind::kContent;
  std::string name;   ///< Path, as the run used it, or name of the variable.
  std::string state;  ///< What was there, as StateNow() says it.

  auto operator<=>(const Input&) const = default;
};

/// Of what can never be trusted to be the same: StateNow() says it of nothing.
inline constexpr std::string_view kUnsteady = "unsteady";

/// From now on all that is looked at is kept, by all threads of this process.
void StartInputLog();
/// What was looked at since, each once, in order. What was seen in two states is kUnsteady.
std::vector<Input> LoggedInputs();

/// The state of an input as it is now. Is not logged.
std::string StateNow(Input::Kind kind, const std::string& name);

/// For what looks at files: sim/base/file.h, and nc::Program, which maps them.
void LogContent(const std::string& path, std::string_view bytes);
void LogInput(Input::Kind kind, const std::string& name, std::string state);
void LogAsItIs(Input::Kind kind, const std::string& name);

}  // namespace ncsim
