// SPDX-License-Identifier: BSD-3-Clause
// The language of a post's blocks: NC text with names in braces.
//
//   {X}        a word or a code: prints where it has a value and that is not the one last printed
//   {X!}       prints though it has not changed
//   {tool.number}, {tool.number:two}   a value; with a format of [formats]
//   {?H{tool.register} Z5.}   vanishes where none of its names prints
//
// A line that has names, of which none prints, vanishes. There are no conditions: what differs has
// a block of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "post/values.h"

namespace ncsim::post {

/// A word of NC text that stands in a template as it is, for what the control then has.
struct WrittenWord {
  std::string address;  ///< "Z", "A3="
  std::string code;     ///< "G0", "TRAORI": upper case, without leading zeros.
};
/// The words of `text`, without what stands in comments, strings and arguments. A letter at its end
/// is an address, its value being what a name prints.
std::vector<WrittenWord> WordsOf(std::string_view text, std::string_view comment_open,
                                 std::string_view comment_close);

struct TemplateNode {
  enum class Kind : std::uint8_t { kLiteral, kNewLine, kWord, kGroup, kValue, kOptional };
  Kind kind = Kind::kLiteral;
  std::string text;                  ///< kLiteral.
  std::vector<WrittenWord> written;  ///< kLiteral: its words.
  int index = 0;            ///< kWord: of the post's words; kGroup, kValue: the enumerator.
  int format = -1;          ///< kValue: of the post's formats; -1: as it is.
  bool forced = false;      ///< kWord, kGroup.
  bool in_comment = false;  ///< kValue.
  std::vector<TemplateNode> children;  ///< kOptional.
};

struct BlockTemplate {
  std::vector<TemplateNode> nodes;
  /// Whether it prints `value`, by name or by a word.
  bool Uses(Value value) const;
  std::vector<Value> values;  ///< That it prints.
};

struct TemplateName {
  TemplateNode::Kind kind = TemplateNode::Kind::kValue;  ///< kWord, kGroup, kValue; kLiteral: text.
  int index = 0;
  int format = -1;
  std::optional<Value> value;  ///< Of kWord and kValue.
  std::string text;            ///< kLiteral: a constant.
};
struct TemplateError {
  std::size_t offset = 0;  ///< In the text.
  std::string message;
};
struct TemplateContext {
  /// What `name` with `format` ("" for none) is; an empty optional and a message otherwise.
  std::function<std::optional<TemplateName>(std::string_view name, std::string_view format,
                                            std::string* message)>
      resolve;
  std::string comment_open, comment_close;
};
BlockTemplate ParseTemplate(std::string_view text, const TemplateContext& context,
                            std::vector<TemplateError>* errors);

}  // namespace ncsim::post
