// SPDX-License-Identifier: BSD-3-Clause
// Where in a TOML file a character of a string's value stands.
#pragma once

#include <cstddef>
#include <string_view>

namespace ncsim::post {

struct TextPosition {
  int line = 0;
  int column = 0;
};
/// `string` is where the string begins (its first quote), `offset` counts in its value. Knows the
/// four kinds of strings and their escapes.
TextPosition PositionInString(std::string_view source, TextPosition string, std::size_t offset);

}  // namespace ncsim::post
