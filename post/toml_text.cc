// SPDX-License-Identifier: BSD-3-Clause
#include "post/toml_text.h"

#include <algorithm>

namespace ncsim::post {
namespace {

/// Goes through the source, counting lines and columns (a column a character of UTF-8).
class Cursor {
 public:
  Cursor(std::string_view source, TextPosition to) : source_(source) {
    while (at_ < source_.size() && (place_.line < to.line || place_.column < to.column)) Step();
  }
  void Step() {
    if (at_ >= source_.size()) return;
    const char c = source_[at_++];
    if (c == '\n') {
      place_ = {place_.line + 1, 1};
    } else if (at_ >= source_.size() || (source_[at_] & 0xC0) != 0x80) {
      ++place_.column;
    }
  }
  void Step(std::size_t n) {
    for (; n > 0; --n) Step();
  }
  bool Sees(std::string_view text) const { return source_.substr(at_, text.size()) == text; }
  TextPosition place() const { return place_; }

 private:
  std::string_view source_;
  std::size_t at_ = 0;
  TextPosition place_{1, 1};
};

/// Source bytes of the escape at the cursor, and the bytes of the value that it stands for.
struct Escape {
  std::size_t length;
  std::size_t value;
};
Escape EscapeAt(const Cursor& cursor) {
  // A code point above ASCII is more than one byte of the value; posts write NC text.
  if (cursor.Sees("\\u")) return {6, 1};
  if (cursor.Sees("\\U")) return {10, 1};
  return {2, 1};
}

bool SkipsLineEnd(const Cursor& cursor) {
  return cursor.Sees("\\\n") || cursor.Sees("\\\r\n") || cursor.Sees("\\ ");
}

}  // namespace

TextPosition PositionInString(std::string_view source, TextPosition string, std::size_t offset) {
  Cursor cursor(source, string);
  const bool basic = cursor.Sees("\"");
  const bool long_string = cursor.Sees("\"\"\"") || cursor.Sees("'''");
  cursor.Step(long_string ? 3 : 1);
  // The line end behind the quotes is no part of the value.
  if (long_string && cursor.Sees("\r\n")) cursor.Step();
  if (long_string && cursor.Sees("\n")) cursor.Step();
  while (offset > 0) {
    if (basic && SkipsLineEnd(cursor)) {
      cursor.Step();
      while (cursor.Sees(" ") || cursor.Sees("\t") || cursor.Sees("\r") || cursor.Sees("\n")) {
        cursor.Step();
      }
      continue;
    }
    const Escape step = basic && cursor.Sees("\\") ? EscapeAt(cursor) : Escape{1, 1};
    cursor.Step(step.length);
    offset -= std::min(offset, step.value);
  }
  return cursor.place();
}

}  // namespace ncsim::post
