// SPDX-License-Identifier: BSD-3-Clause
#include "post/block_printer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace ncsim::post {
namespace {

constexpr double kTurnDegrees = 360.0;

/// Texts outside of comments: names and numbers, nothing that could be read as something else.
bool IsPlain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' ||
           c == '+';
  });
}
bool IsPrintable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}
/// Texts that the file itself has for the program.
bool IsVerbatim(Value value) { return value >= Value::kText; }

}  // namespace

struct BlockPrinter::Line {
  std::string text;
  bool has_names = false;
  bool printed = false;  ///< One of them.
  bool stays = false;    ///< One that counts.
  std::string missing;   ///< The name of a value that a text is written around.
  bool swallow = false;  ///< The blank behind a name that printed nothing goes with it.
};

/// One printing of one block.
class BlockPrinter::Run {
 public:
  Run(BlockPrinter* printer, const Values& values, const WantedCodes& codes, Counts counts,
      std::vector<std::string>* problems)
      : printer_(*printer), values_(values), codes_(codes), counts_(counts), problems_(problems) {}

  std::vector<std::string> Lines(const BlockTemplate& block) {
    StartLine();
    for (const TemplateNode& node : block.nodes) {
      if (node.kind == TemplateNode::Kind::kNewLine) {
        EndLine();
        StartLine();
      } else {
        Add(node);
      }
    }
    EndLine();
    return std::move(lines_);
  }

 private:
  void StartLine() {
    line_ = {};
    before_ = printer_.memory_;
    for (std::size_t i = 0; i < printer_.data_.words.size(); ++i) {
      const WordFormat& word = printer_.data_.words[i];
      if (!word.together.empty() && printer_.TextOf(word, values_) != before_.words[i]) {
        together_.push_back(word.together);
      }
    }
  }

  void EndLine() {
    together_.clear();
    if (line_.has_names && !line_.stays) {
      printer_.memory_ = before_;
      return;
    }
    if (!line_.missing.empty()) {
      problems_->push_back("'" + line_.missing + "' has no value here, in the line '" + line_.text +
                           "' (in {? } it could vanish)");
    }
    while (!line_.text.empty() && line_.text.back() == ' ') line_.text.pop_back();
    lines_.push_back(std::move(line_.text));
  }

  void Add(const TemplateNode& node) {
    switch (node.kind) {
      case TemplateNode::Kind::kLiteral:
        AddLiteral(node);
        break;
      case TemplateNode::Kind::kWord:
        AddWord(node);
        break;
      case TemplateNode::Kind::kGroup:
        AddGroup(node);
        break;
      case TemplateNode::Kind::kValue:
        AddValue(node);
        break;
      case TemplateNode::Kind::kOptional:
        AddOptional(node);
        break;
      case TemplateNode::Kind::kNewLine:
        break;
    }
  }

  bool AtGap() const { return line_.text.empty() || line_.text.back() == ' '; }

  void AddLiteral(const TemplateNode& node) {
    std::string_view text = node.text;
    if (line_.swallow && !text.empty() && text.front() == ' ' && AtGap()) text.remove_prefix(1);
    line_.swallow = false;
    line_.text += text;
    for (const WrittenWord& word : node.written) printer_.Note(word);
  }

  void Nothing() {
    line_.has_names = true;
    line_.swallow = true;
  }
  /// Fine where the line or the optional part vanishes, or where something else stands for it.
  void NoValue(Value value) {
    Nothing();
    if (!optional_) line_.missing = Info(value).name;
  }
  void Printed(std::string_view text, bool counts) {
    line_.has_names = true;
    line_.swallow = false;
    line_.text += text;
    line_.printed = true;
    line_.stays = line_.stays || counts;
  }

  void AddWord(const TemplateNode& node) {
    const auto index = static_cast<std::size_t>(node.index);
    const WordFormat& word = printer_.data_.words[index];
    const std::string text = printer_.TextOf(word, values_);
    std::string& last = printer_.memory_.words[index];
    const bool with_others = !word.together.empty() && std::find(together_.begin(), together_.end(),
                                                                 word.together) != together_.end();
    if (text.empty() || (word.modal && !node.forced && !with_others && text == last)) {
      Nothing();
      return;
    }
    // Another word of the same address is what the control then has.
    for (std::size_t i = 0; i < printer_.data_.words.size(); ++i) {
      if (printer_.data_.words[i].address == word.address) printer_.memory_.words[i].clear();
    }
    last = text;
    Printed(text, counts_ == Counts::kAnything || IsPosition(word.value));
  }

  void AddGroup(const TemplateNode& node) {
    const auto index = static_cast<std::size_t>(node.index);
    const std::string* code = codes_[index];
    std::string& last = printer_.memory_.codes[index];
    if (code == nullptr || (!node.forced && *code == last)) {
      Nothing();
      return;
    }
    last = *code;
    if (index == static_cast<std::size_t>(Group::kFeedMode)) printer_.ForgetFeeds();
    Printed(*code, counts_ == Counts::kAnything);
  }

  void AddValue(const TemplateNode& node) {
    const auto value = static_cast<Value>(node.index);
    if (Info(value).kind == ValueKind::kText) {
      AddText(value, node.in_comment);
      return;
    }
    const std::optional<double>& number = values_.number(value);
    if (!number) {
      NoValue(value);
    } else if (node.format < 0) {
      NumberFormat plain;
      plain.decimals = 4;
      plain.point = false;
      Printed(post::Print(plain, *number).text, true);
    } else {
      const NumberFormat& format = printer_.data_.formats[static_cast<std::size_t>(node.format)];
      Printed(post::Print(format, *number).text, true);
    }
  }

  void AddText(Value value, bool in_comment) {
    const std::string& text = values_.text(value);
    if (text.empty()) {
      NoValue(value);
      return;
    }
    if (in_comment) {
      Printed(printer_.Comment(text), true);
      return;
    }
    if (IsVerbatim(value) ? !IsPrintable(text) : !IsPlain(text)) {
      problems_->push_back(std::string(Info(value).name) + " '" + text +
                           "' cannot stand in a program");
    }
    printer_.Written(text);
    Printed(text, true);
  }

  void AddOptional(const TemplateNode& node) {
    const Line outer = line_;
    const Memory memory = printer_.memory_;
    line_.has_names = line_.printed = false;
    const bool nested = std::exchange(optional_, true);
    for (const TemplateNode& child : node.children) Add(child);
    optional_ = nested;
    const bool vanishes = line_.has_names && !line_.printed;
    if (vanishes) {
      printer_.memory_ = memory;
      line_ = outer;
      Nothing();
    } else {
      line_.has_names = true;
      line_.printed = line_.printed || outer.printed;
    }
  }

  BlockPrinter& printer_;
  const Values& values_;
  const WantedCodes& codes_;
  Counts counts_;
  std::vector<std::string>* problems_;
  Line line_;
  Memory before_;
  bool optional_ = false;
  std::vector<std::string> together_;
  std::vector<std::string> lines_;
};

BlockPrinter::BlockPrinter(const PostData& data) : data_(data) {
  memory_.words.resize(data.words.size());
  for (std::size_t g = 0; g < kGroups; ++g) {
    for (const std::optional<std::string>& code : data.codes[g]) {
      if (!code) continue;
      for (const WrittenWord& word : WordsOf(*code, data.comments.open, data.comments.close)) {
        known_codes_.push_back({word.code, {g, *code}});
      }
    }
  }
}

std::vector<std::string> BlockPrinter::Print(const BlockTemplate& block, const Values& values,
                                             const WantedCodes& codes, Counts counts,
                                             std::vector<std::string>* problems) {
  return Run(this, values, codes, counts, problems).Lines(block);
}

void BlockPrinter::Written(std::string_view text) {
  for (const WrittenWord& word : WordsOf(text, data_.comments.open, data_.comments.close)) {
    Note(word);
  }
}

void BlockPrinter::Note(const WrittenWord& word) {
  if (!word.address.empty()) {
    for (std::size_t i = 0; i < data_.words.size(); ++i) {
      const std::string& address = data_.words[i].address;
      // "C=DC(" begins as "C=" does.
      if (address == word.address ||
          (word.address.back() == '=' && address.rfind(word.address, 0) == 0)) {
        memory_.words[i].clear();
      }
    }
  }
  if (word.code.empty()) return;
  for (const auto& [code, group] : known_codes_) {
    if (code != word.code) continue;
    memory_.codes[group.first] = group.second;
    if (group.first == static_cast<std::size_t>(Group::kFeedMode)) ForgetFeeds();
  }
}

std::string BlockPrinter::TextOf(const WordFormat& word, const Values& values) const {
  const std::optional<double>& number = values.number(word.value);
  if (!number) return "";
  const NumberFormat& format = data_.formats[static_cast<std::size_t>(word.format)];
  PrintedNumber printed = post::Print(format, *number);
  if (word.wrap) {
    // Of the rounded value: 359.9999 is 0.
    printed = post::Print(format,
                          printed.value - kTurnDegrees * std::floor(printed.value / kTurnDegrees));
    if (printed.value >= kTurnDegrees) printed = post::Print(format, 0.0);
  }
  return word.address + printed.text + word.suffix;
}

std::string BlockPrinter::Comment(std::string_view text) const {
  const CommentStyle& style = data_.comments;
  std::string out;
  for (char c : text) {
    if ((c & 0xC0) == 0x80) continue;  // the rest of a character of UTF-8
    if (style.upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const bool ends = !style.close.empty() && style.close.find(c) != std::string::npos;
    const bool known = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ' ||
                       style.characters.find(c) != std::string::npos;
    out += known && !ends && c >= ' ' && c <= '~' ? c : '-';
    if (style.length > 0 && out.size() >= static_cast<std::size_t>(style.length)) break;
  }
  return out;
}

void BlockPrinter::ForgetAll() {
  for (std::string& word : memory_.words) word.clear();
  for (std::string& code : memory_.codes) code.clear();
}

void BlockPrinter::ForgetPositions() {
  for (std::size_t i = 0; i < data_.words.size(); ++i) {
    if (IsPosition(data_.words[i].value)) memory_.words[i].clear();
  }
}

void BlockPrinter::ForgetFeeds() {
  Forget(Value::kFeedPerMinute);
  Forget(Value::kFeedPerRevolution);
  Forget(Value::kFeedInverse);
}

void BlockPrinter::Forget(Value value) {
  for (std::size_t i = 0; i < data_.words.size(); ++i) {
    if (data_.words[i].value == value) memory_.words[i].clear();
  }
}

void BlockPrinter::Forget(Group group) { memory_.codes[static_cast<std::size_t>(group)].clear(); }

void BlockPrinter::AxisIs(const Values& values) {
  for (std::size_t i = 0; i < data_.words.size(); ++i) {
    const WordFormat& word = data_.words[i];
    if (word.value >= Value::kRotary1 && word.value <= Value::kAxisZ) {
      memory_.words[i] = TextOf(word, values);
    }
  }
}

void BlockPrinter::SwitchedOff() {
  Forget(Value::kSpeed);
  for (const Group group : {Group::kSpindle, Group::kCoolant}) {
    const auto g = static_cast<std::size_t>(group);
    memory_.codes[g] = data_.codes[g].front().value_or("");  // "off"
  }
}

bool BlockPrinter::Has(Group group, const WantedCodes& codes) const {
  const std::string* code = codes[static_cast<std::size_t>(group)];
  return code == nullptr || *code == memory_.codes[static_cast<std::size_t>(group)];
}

}  // namespace ncsim::post
