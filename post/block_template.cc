// SPDX-License-Identifier: BSD-3-Clause
#include "post/block_template.h"

#include <algorithm>
#include <utility>

#include "sim/base/text.h"

namespace ncsim::post {
namespace {

bool IsNameLetter(char c) { return IsLetter(c) || c == '_'; }
bool IsGap(char c) { return c == ' ' || c == '\t'; }

/// "G00" is "G0".
std::string CodeOf(std::string_view word) {
  std::string code = Upper(word);
  if (code.size() > 1 && IsLetter(code[0]) && IsDigit(code[1])) {
    while (code.size() > 2 && code[1] == '0' && IsDigit(code[2])) code.erase(1, 1);
  }
  return code;
}

class WordScanner {
 public:
  WordScanner(std::string_view text, std::string_view open, std::string_view close)
      : text_(text), open_(open), close_(close) {}

  std::vector<WrittenWord> Run() {
    while (at_ < text_.size()) {
      if (!open_.empty() && text_.substr(at_, open_.size()) == open_) {
        SkipTo(close_.empty() ? "\n" : close_);
      } else if (text_[at_] == '"') {
        ++at_;
        SkipTo("\"");
      } else if (text_[at_] == '(') {
        SkipTo(")");
      } else if (IsNameLetter(text_[at_])) {
        ReadWord();
      } else {
        ++at_;
      }
    }
    return std::move(words_);
  }

 private:
  void SkipTo(std::string_view end) {
    at_ = std::min(text_.find(end, at_), text_.size());
    at_ = std::min(at_ + end.size(), text_.size());
  }
  char Peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void ReadWord() {
    const std::size_t begin = at_;
    while (IsNameLetter(Peek())) ++at_;
    const bool one_letter = at_ == begin + 1;
    while (IsDigit(Peek()) || (!one_letter && IsNameLetter(Peek()))) ++at_;
    const std::string name = Upper(text_.substr(begin, at_ - begin));
    std::size_t equals = at_;
    while (equals < text_.size() && IsGap(text_[equals])) ++equals;
    if (equals < text_.size() && text_[equals] == '=') {
      at_ = equals + 1;
      SkipValue();
      words_.push_back({name + "=", ""});
      // Z=_Z_HOME is a Z all the same.
      if (name.size() == 1) words_.push_back({name, ""});
    } else if (one_letter) {
      SkipNumber();
      words_.push_back({name.substr(0, 1), CodeOf(text_.substr(begin, at_ - begin))});
    } else {
      words_.push_back({"", name});
    }
  }
  void SkipNumber() {
    while (Peek() == '-' || Peek() == '+') ++at_;
    while (IsDigit(Peek()) || Peek() == '.') ++at_;
  }
  void SkipValue() {
    while (at_ < text_.size() && !IsGap(text_[at_]) && text_[at_] != '\n') ++at_;
  }

  std::string_view text_, open_, close_;
  std::size_t at_ = 0;
  std::vector<WrittenWord> words_;
};

class TemplateParser {
 public:
  TemplateParser(std::string_view text, const TemplateContext& context,
                 std::vector<TemplateError>* errors)
      : text_(text), context_(context), errors_(errors) {}

  BlockTemplate Run() {
    block_.nodes = ReadNodes(/*optional=*/false);
    // The end of the last line is no further line.
    if (!block_.nodes.empty() && block_.nodes.back().kind == TemplateNode::Kind::kNewLine) {
      block_.nodes.pop_back();
    }
    return std::move(block_);
  }

 private:
  void Error(std::size_t offset, std::string message) {
    errors_->push_back({offset, std::move(message)});
  }

  std::vector<TemplateNode> ReadNodes(bool optional) {
    std::vector<TemplateNode> nodes;
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '}' && optional) {
        ++at_;
        return nodes;
      }
      if (c == '}') {
        Error(at_++, "'}' without '{'");
      } else if (c == '\n') {
        ReadNewLine(optional, &nodes);
      } else if (c == '{' && text_.substr(at_, 2) == "{?") {
        at_ += 2;
        TemplateNode node;
        node.kind = TemplateNode::Kind::kOptional;
        node.children = ReadNodes(/*optional=*/true);
        nodes.push_back(std::move(node));
      } else if (c == '{') {
        ReadName(&nodes);
      } else {
        ReadLiteral(&nodes);
      }
    }
    if (optional) Error(begin - 2, "'{?' without '}'");
    return nodes;
  }

  void ReadNewLine(bool optional, std::vector<TemplateNode>* nodes) {
    if (optional) Error(at_, "a part in '{?' and '}' ends in its line");
    if (context_.comment_close.empty()) in_comment_ = false;
    ++at_;
    TemplateNode node;
    node.kind = TemplateNode::Kind::kNewLine;
    nodes->push_back(node);
  }

  void ReadLiteral(std::vector<TemplateNode>* nodes) {
    const std::size_t end = std::min(text_.find_first_of("{}\n", at_), text_.size());
    AddLiteral(text_.substr(at_, end - at_), nodes);
    at_ = end;
  }

  void AddLiteral(std::string_view text, std::vector<TemplateNode>* nodes) {
    TemplateNode node;
    node.text = std::string(text);
    if (in_comment_) {
      // What is left of the comment has no words.
      const std::size_t close = text.find(context_.comment_close);
      const bool closes = !context_.comment_close.empty() && close != text.npos;
      if (closes) {
        node.written =
            WordsOf(text.substr(close + 1), context_.comment_open, context_.comment_close);
      }
    } else {
      node.written = WordsOf(text, context_.comment_open, context_.comment_close);
    }
    FollowComments(text);
    nodes->push_back(std::move(node));
  }

  void FollowComments(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (in_comment_) {
        in_comment_ = context_.comment_close.empty() ||
                      text.substr(i, context_.comment_close.size()) != context_.comment_close;
      } else {
        in_comment_ = !context_.comment_open.empty() &&
                      text.substr(i, context_.comment_open.size()) == context_.comment_open;
      }
    }
  }

  void ReadName(std::vector<TemplateNode>* nodes) {
    const std::size_t begin = at_;
    const std::size_t end = text_.find_first_of("{}\n", at_ + 1);
    if (end == text_.npos || text_[end] != '}') {
      Error(begin, "'{' without '}'");
      at_ = std::min(end, text_.size());
      return;
    }
    std::string_view name = text_.substr(begin + 1, end - begin - 1);
    at_ = end + 1;
    TemplateNode node;
    if (!name.empty() && name.back() == '!') {
      node.forced = true;
      name.remove_suffix(1);
    }
    std::string_view format;
    if (const std::size_t colon = name.find(':'); colon != name.npos) {
      format = name.substr(colon + 1);
      name = name.substr(0, colon);
    }
    std::string message;
    const std::optional<TemplateName> found = context_.resolve(name, format, &message);
    if (!found) {
      Error(begin + 1, message);
      return;
    }
    if (found->kind == TemplateNode::Kind::kLiteral) {
      AddLiteral(found->text, nodes);
      return;
    }
    if (node.forced && found->kind == TemplateNode::Kind::kValue) {
      Error(begin + 1, "'!' is for words and codes: '" + std::string(name) + "' always prints");
    }
    node.kind = found->kind;
    node.index = found->index;
    node.format = found->format;
    node.in_comment = in_comment_;
    if (found->value) block_.values.push_back(*found->value);
    nodes->push_back(std::move(node));
  }

  std::string_view text_;
  const TemplateContext& context_;
  std::vector<TemplateError>* errors_;
  std::size_t at_ = 0;
  bool in_comment_ = false;
  BlockTemplate block_;
};

}  // namespace

std::vector<WrittenWord> WordsOf(std::string_view text, std::string_view comment_open,
                                 std::string_view comment_close) {
  return WordScanner(text, comment_open, comment_close).Run();
}

bool BlockTemplate::Uses(Value value) const {
  return std::find(values.begin(), values.end(), value) != values.end();
}

BlockTemplate ParseTemplate(std::string_view text, const TemplateContext& context,
                            std::vector<TemplateError>* errors) {
  return TemplateParser(text, context, errors).Run();
}

}  // namespace ncsim::post
