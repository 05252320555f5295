// SPDX-License-Identifier: BSD-3-Clause
// Small helpers over tinyxml2, for the two readers that use it (URDF and SRDF). Not included by
// anything else.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <vector>

#include "sim/base/diagnostics.h"

namespace ncsim::machine::xml {

/// Numbers as URDF writes them: separated by blanks, without a locale, finite. nullopt where the
/// text is anything else.
std::optional<std::vector<double>> ParseNumbers(const char* text);

/// An XML file being read: reports with its name and the element's line.
class Reader {
 public:
  Reader(std::string file, Diagnostics* diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  /// Parses; the root must be <robot>. nullptr (reported) otherwise. xacro is refused with a hint.
  const tinyxml2::XMLElement* Parse(const std::string& text);

  void Error(const tinyxml2::XMLElement& at, std::string message) const;
  void Warning(const tinyxml2::XMLElement& at, std::string message) const;
  /// Errors reported so far.
  int errors() const { return errors_; }

  /// The attribute, which must be there and not empty; "" (reported) otherwise.
  std::string Name(const tinyxml2::XMLElement& element, const char* attribute) const;
  /// `count` finite numbers; nullopt and an error otherwise. An absent attribute is an error if
  /// `required`.
  std::optional<std::vector<double>> Numbers(const tinyxml2::XMLElement& element,
                                             const char* attribute, std::size_t count,
                                             bool required) const;
  /// Warns of every child that is not in `known`; an error where it looks like one of them
  /// misspelt. Elements of other programs (with a prefix that is not ncsim) are theirs.
  void CheckChildren(const tinyxml2::XMLElement& element,
                     const std::vector<std::string>& known) const;

 private:
  std::string file_;
  Diagnostics* diagnostics_;
  mutable int errors_ = 0;
  tinyxml2::XMLDocument document_;
};

}  // namespace ncsim::machine::xml
