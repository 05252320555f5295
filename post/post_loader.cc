// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "post/post_data.h"
#include "post/toml_text.h"
#include "sim/base/text.h"
#include "sim/base/toml_reader.h"
#include "sim/base/units.h"

namespace ncsim::post {
namespace {

using cl::Text;

const std::vector<std::pair<std::string, Text::Kind>>& TextKinds() {
  static const std::vector<std::pair<std::string, Text::Kind>> kinds = {
      {"partno", Text::Kind::kPartNo}, {"insert", Text::Kind::kInsert},
      {"pprint", Text::Kind::kPrint},  {"remark", Text::Kind::kRemark},
      {"letter", Text::Kind::kLetter}, {"comment", Text::Kind::kComment},
      {"data", Text::Kind::kData},
  };
  return kinds;
}

class PostLoader {
 public:
  PostLoader(const std::string& text, const std::string& file, const PostSettings& settings,
             Diagnostics* diagnostics)
      : source_(text), file_(file), settings_(settings), diagnostics_(diagnostics) {}

  std::optional<PostData> Run() {
    const std::optional<TomlValue> root = ParseToml(source_, file_, diagnostics_);
    if (!root) return std::nullopt;
    const std::size_t before = diagnostics_->all().size();
    TomlTable table(*root, file_, diagnostics_);
    LoadHead(&table);
    LoadFormats(&table);
    LoadWords(&table);
    LoadCodes(&table);
    LoadStyle(&table);
    LoadConstants(&table);
    if (std::optional<TomlTable> blocks = table.Table("blocks")) {
      LoadBlocks(&*blocks, &data_.blocks);
    }
    LoadModes(&table);
    LoadCycles(&table);
    LoadTexts(&table);
    table.Finish();
    if (diagnostics_->all().size() == before) CheckBlocks(table);
    const auto& all = diagnostics_->all();
    const bool wrong =
        std::any_of(all.begin() + static_cast<std::ptrdiff_t>(before), all.end(),
                    [](const Diagnostic& d) { return d.level == Diagnostic::Level::kError; });
    if (wrong) return std::nullopt;
    return std::move(data_);
  }

 private:
  void LoadHead(TomlTable* table) {
    if (const auto schema = table->Integer("schema", 1, 1); !schema) {
      if (table->value().Find("schema") == nullptr) table->Require("schema");
    }
    data_.name = table->RequiredString("name").value_or("");
    data_.dialect = table->RequiredString("dialect").value_or("");
    data_.extension = table->RequiredString("extension").value_or("");
    const std::string unit = table->Word("unit", {"mm", "inch"}).value_or("mm");
    data_.unit = unit == "inch" ? ClUnit::kInch : ClUnit::kMillimetre;
    if (settings_.unit) data_.unit = *settings_.unit;
    data_.modal_call = table->Boolean("modal_call").value_or(false);
  }

  /// A number, or one for each unit: { mm = 3, inch = 4 }.
  int Decimals(TomlTable* table) {
    const TomlValue* value = table->Get("decimals");
    if (value != nullptr && value->kind == TomlValue::Kind::kTable) {
      TomlTable units(*value, file_, diagnostics_);
      const auto mm = units.Integer("mm", 0, 9), inch = units.Integer("inch", 0, 9);
      units.Finish();
      if (!mm || !inch) table->ErrorAt(*value, "'decimals' needs mm and inch");
      const auto& one = data_.unit == ClUnit::kInch ? inch : mm;
      return static_cast<int>(one.value_or(0));
    }
    if (value == nullptr) table->Require("decimals");
    return static_cast<int>(table->Integer("decimals", 0, 9).value_or(0));
  }

  void LoadFormats(TomlTable* table) {
    const TomlValue* formats = table->Require("formats");
    std::optional<TomlTable> all = formats ? table->AsTable(*formats, "formats") : std::nullopt;
    if (!all) return;
    for (const TomlValue& child : formats->children) {
      std::optional<TomlTable> one = all->AsTable(child, child.key);
      all->Get(child.key);
      if (!one) continue;
      NumberFormat format;
      format.name = child.key;
      format.decimals = Decimals(&*one);
      format.digits = static_cast<int>(one->Integer("digits", 0, 8).value_or(1));
      format.trailing = static_cast<int>(one->Integer("trailing", 0, 6).value_or(0));
      format.point = one->Boolean("point").value_or(true);
      format.plus = one->Boolean("plus").value_or(false);
      format.highest = one->Number("highest", NumberRule::kPositive);
      one->Finish();
      data_.formats.push_back(format);
    }
  }

  std::optional<int> FormatNamed(std::string_view name) const {
    for (std::size_t i = 0; i < data_.formats.size(); ++i) {
      if (data_.formats[i].name == name) return static_cast<int>(i);
    }
    return std::nullopt;
  }

  std::vector<std::string> FormatNames() const {
    std::vector<std::string> names;
    for (const NumberFormat& format : data_.formats) names.push_back(format.name);
    return names;
  }

  void LoadWords(TomlTable* table) {
    const TomlValue* words = table->Require("words");
    std::optional<TomlTable> all = words ? table->AsTable(*words, "words") : std::nullopt;
    if (!all) return;
    for (const TomlValue& child : words->children) {
      std::optional<TomlTable> one = all->AsTable(child, child.key);
      all->Get(child.key);
      if (one) LoadWord(child, &*one);
    }
    for (const Value needed : {Value::kX, Value::kY, Value::kZ}) {
      if (data_.FindWord(needed) == nullptr) {
        all->ErrorAt(*words, "no word has the value '" + std::string(Info(needed).name) + "'");
      }
    }
  }

  void LoadWord(const TomlValue& child, TomlTable* one) {
    WordFormat word;
    word.name = child.key;
    word.address = one->String("address").value_or(child.key);
    word.suffix = one->String("suffix").value_or("");
    word.modal = one->Boolean("modal").value_or(true);
    word.wrap = one->Boolean("wrap").value_or(false);
    word.together = one->String("together").value_or("");
    const std::string name = one->RequiredString("value").value_or("");
    const std::optional<Value> value = ValueFromName(name);
    if (!value || Info(*value).kind == ValueKind::kText) {
      if (const TomlValue* at = one->value().Find("value")) {
        one->ErrorAt(
            *at, "'" + name + "' is no number that a block has" + DidYouMean(name, ValueNames()));
      }
    } else {
      word.value = *value;
    }
    const std::string format = one->RequiredString("format").value_or("");
    const std::optional<int> index = FormatNamed(format);
    if (index) {
      word.format = *index;
    } else if (const TomlValue* at = one->value().Find("format")) {
      one->ErrorAt(*at, "no format '" + format + "'" + DidYouMean(format, FormatNames()));
    }
    one->Finish();
    data_.words.push_back(std::move(word));
  }

  static std::vector<std::string> ValueNames() {
    std::vector<std::string> names;
    for (const ValueInfo& info : ValueTable()) names.emplace_back(info.name);
    return names;
  }

  void LoadCodes(TomlTable* table) {
    std::optional<TomlTable> all = table->Table("codes");
    if (!all) table->Require("codes");
    for (int g = 0; g < kGroups; ++g) {
      const GroupInfo& info = GroupTable()[static_cast<std::size_t>(g)];
      auto& codes = data_.codes[static_cast<std::size_t>(g)];
      codes.resize(info.keys.size());
      std::optional<TomlTable> group = all ? all->Table(info.name) : std::nullopt;
      if (!group) continue;
      for (std::size_t k = 0; k < info.keys.size(); ++k) codes[k] = group->String(info.keys[k]);
      group->Finish();
    }
    if (all) all->Finish();
  }

  void LoadStyle(TomlTable* table) {
    if (std::optional<TomlTable> comments = table->Table("comments")) {
      CommentStyle& style = data_.comments;
      style.open = comments->RequiredString("open").value_or("");
      style.close = comments->String("close").value_or("");
      style.characters = comments->String("characters").value_or("");
      style.upper = comments->Boolean("upper").value_or(false);
      style.length = static_cast<int>(comments->Integer("length", 1, 500).value_or(0));
      comments->Finish();
    } else {
      table->Require("comments");
    }
    if (std::optional<TomlTable> numbers = table->Table("line_numbers")) {
      LineNumbers& lines = data_.numbers;
      lines.prefix = numbers->RequiredString("prefix").value_or("");
      lines.start = static_cast<int>(numbers->Integer("start", 0, 99999999).value_or(10));
      lines.step = static_cast<int>(numbers->Integer("step", 1, 1000).value_or(10));
      lines.highest = static_cast<int>(numbers->Integer("highest", 1, 99999999).value_or(99999));
      lines.without = numbers->Strings("without");
      numbers->Finish();
    }
  }

  void LoadConstants(TomlTable* table) {
    if (std::optional<TomlTable> constants = table->Table("constants")) {
      for (const TomlValue& child : constants->value().children) {
        if (const auto text = constants->String(child.key)) data_.constants[child.key] = *text;
      }
    }
    for (const auto& [name, text] : settings_.constants) {
      if (data_.constants.count(name) == 0) {
        diagnostics_->Error(
            file_, 0, 0,
            "the post has no constant '" + name + "'" + DidYouMean(name, ConstantNames()));
      }
      data_.constants[name] = text;
    }
  }

  std::vector<std::string> ConstantNames() const {
    std::vector<std::string> names;
    for (const auto& constant : data_.constants) names.push_back(constant.first);
    return names;
  }

  void LoadBlocks(TomlTable* table, Blocks* blocks) {
    for (int b = 0; b < kBlocks; ++b) {
      const BlockInfo& info = BlockTable()[static_cast<std::size_t>(b)];
      (*blocks)[static_cast<std::size_t>(b)] = Template(table, info.name, info.scopes);
    }
    table->Finish();
  }

  std::optional<BlockTemplate> Template(TomlTable* table, std::string_view key, unsigned scopes) {
    const std::optional<std::string> text = table->String(key);
    if (!text) return std::nullopt;
    const TomlValue* value = table->value().Find(key);
    TemplateContext context;
    context.comment_open = data_.comments.open;
    context.comment_close = data_.comments.close;
    context.resolve = [&](std::string_view name, std::string_view format, std::string* message) {
      return Resolve(name, format, scopes, message);
    };
    std::vector<TemplateError> errors;
    BlockTemplate block = ParseTemplate(*text, context, &errors);
    for (const TemplateError& error : errors) {
      const TextPosition at = PositionInString(source_, {value->line, value->column}, error.offset);
      diagnostics_->Error(file_, at.line, at.column, error.message);
    }
    return block;
  }

  std::optional<TemplateName> Resolve(std::string_view name, std::string_view format,
                                      unsigned scopes, std::string* message) const {
    TemplateName found;
    unsigned has = kAll;
    std::optional<ValueKind> kind;
    if (const auto constant = data_.constants.find(std::string(name));
        constant != data_.constants.end()) {
      found.kind = TemplateNode::Kind::kLiteral;
      found.text = constant->second;
    } else if (const auto group = GroupNamed(name)) {
      found.kind = TemplateNode::Kind::kGroup;
      found.index = *group;
      has = GroupTable()[static_cast<std::size_t>(*group)].scopes;
    } else if (const auto word = WordNamed(name)) {
      found.kind = TemplateNode::Kind::kWord;
      found.index = *word;
      found.value = data_.words[static_cast<std::size_t>(*word)].value;
      has = Info(*found.value).scopes;
    } else if (const auto value = ValueFromName(name)) {
      found.index = static_cast<int>(*value);
      found.value = value;
      has = Info(*value).scopes;
      kind = Info(*value).kind;
    } else {
      *message = "unknown name '" + std::string(name) + "'" + DidYouMean(name, AllNames());
      return std::nullopt;
    }
    if ((has & scopes) == 0) {
      *message = "'" + std::string(name) + "' has no value in this block";
      return std::nullopt;
    }
    if (!SetFormat(format, kind, &found, message)) return std::nullopt;
    return found;
  }

  bool SetFormat(std::string_view format, std::optional<ValueKind> kind, TemplateName* found,
                 std::string* message) const {
    if (!kind || *kind == ValueKind::kText) {
      if (!format.empty()) *message = "only a number takes a format";
      return format.empty();
    }
    const std::string_view wanted = format.empty() ? DefaultFormat(*kind) : format;
    if (wanted.empty()) return true;
    const std::optional<int> index = FormatNamed(wanted);
    if (index) {
      found->format = *index;
    } else {
      *message = "no format '" + std::string(wanted) + "'" + DidYouMean(wanted, FormatNames());
    }
    return index.has_value();
  }

  std::optional<int> WordNamed(std::string_view name) const {
    for (std::size_t i = 0; i < data_.words.size(); ++i) {
      if (data_.words[i].name == name) return static_cast<int>(i);
    }
    return std::nullopt;
  }
  static std::optional<int> GroupNamed(std::string_view name) {
    for (int g = 0; g < kGroups; ++g) {
      if (GroupTable()[static_cast<std::size_t>(g)].name == name) return g;
    }
    return std::nullopt;
  }
  std::vector<std::string> AllNames() const {
    std::vector<std::string> names = ValueNames();
    for (const GroupInfo& group : GroupTable()) names.emplace_back(group.name);
    for (const WordFormat& word : data_.words) names.push_back(word.name);
    for (const auto& constant : data_.constants) names.push_back(constant.first);
    return names;
  }

  void LoadModes(TomlTable* table) {
    std::vector<TomlTable> modes = table->Tables("mode");
    if (modes.empty()) table->Require("mode");
    for (TomlTable& one : modes) {
      PostMode mode;
      mode.name = one.RequiredString("name").value_or("");
      const std::string kind = one.Word("kind", {"tcp", "indexed", "axes"}).value_or("");
      if (kind.empty()) one.Require("kind");
      mode.kind = kind == "tcp"       ? PlanMode::kTcp
                  : kind == "indexed" ? PlanMode::kIndexed
                                      : PlanMode::kAxes;
      const std::string frame = one.Word("frame", {"fixed", "turned", "plane"}).value_or("turned");
      mode.frame = frame == "fixed"    ? PostMode::Frame::kFixed
                   : frame == "turned" ? PostMode::Frame::kTurned
                                       : PostMode::Frame::kPlane;
      mode.great_circle = one.Boolean("great_circle").value_or(false);
      mode.pole_limit = Radians(one.Number("pole_limit", NumberRule::kNotNegative).value_or(0.0));
      mode.compensation = one.Boolean("compensation").value_or(false);
      mode.rate_alarm = one.Boolean("rate_alarm").value_or(false);
      LoadArcPlanes(&one, &mode);
      mode.helices = one.Boolean("helices").value_or(false);
      mode.cycles = one.Boolean("cycles").value_or(false);
      mode.inverse_time = one.Boolean("inverse_time").value_or(false);
      mode.per_revolution = one.Boolean("per_revolution").value_or(false);
      mode.split_rapids = one.Boolean("split_rapids").value_or(false);
      if (std::optional<TomlTable> blocks = one.Table("blocks")) {
        LoadBlocks(&*blocks, &mode.blocks);
      }
      one.Finish();
      if (data_.ModeNamed(mode.name) != nullptr) {
        one.ErrorAt(one.value(), "a second mode '" + mode.name + "'");
      }
      data_.modes.push_back(std::move(mode));
    }
  }

  static void LoadArcPlanes(TomlTable* one, PostMode* mode) {
    const TomlValue* list = one->Get("arcs");
    for (const std::string& plane : one->Strings("arcs")) {
      if (plane == "xy") {
        mode->arc_planes.push_back(PlanPlane::kXY);
      } else if (plane == "zx") {
        mode->arc_planes.push_back(PlanPlane::kZX);
      } else if (plane == "yz") {
        mode->arc_planes.push_back(PlanPlane::kYZ);
      } else {
        one->ErrorAt(*list, "'" + plane + "' is no plane: xy, zx, yz");
      }
    }
  }

  void LoadCycles(TomlTable* table) {
    std::optional<TomlTable> cycles = table->Table("cycles");
    if (!cycles) return;
    for (int k = 0; k <= static_cast<int>(ClCycleKind::kThru); ++k) {
      const std::string name(ToString(static_cast<ClCycleKind>(k)));
      for (const std::string& key : {name, name + "_dwell", name + "_left"}) {
        if (auto block = Template(&*cycles, key, kHole)) data_.cycles[key] = std::move(*block);
      }
    }
    cycles->Finish();
  }

  PostText LoadText(TomlTable* table, const std::string& key, unsigned scopes) {
    PostText text;
    const TomlValue* value = table->value().Find(key);
    if (value->kind == TomlValue::Kind::kString && value->text == "ignore") {
      table->Get(key);
    } else if (value->kind == TomlValue::Kind::kString && value->text == "comment") {
      table->Get(key);
      text.what = PostText::What::kComment;
    } else if (value->kind == TomlValue::Kind::kString && value->text == "words" &&
               scopes == kTextBlock) {
      table->Get(key);
      text.what = PostText::What::kWords;
    } else if (auto block = Template(table, key, scopes)) {
      text.what = PostText::What::kBlock;
      text.block = std::move(*block);
    }
    return text;
  }

  void LoadTexts(TomlTable* table) {
    if (std::optional<TomlTable> texts = table->Table("texts")) {
      for (const auto& [key, kind] : TextKinds()) {
        if (texts->value().Find(key) != nullptr) {
          data_.texts[kind] = LoadText(&*texts, key, kTextBlock);
        }
      }
      texts->Finish();
    }
    if (std::optional<TomlTable> functions = table->Table("functions")) {
      for (const TomlValue& child : functions->value().children) {
        data_.functions[child.key] = LoadText(&*functions, child.key, kFunction);
      }
    }
  }

  /// Codes that every program needs, and those without which others never end.
  void CheckCodes(const TomlTable& table) const {
    const auto need = [&](Group group, std::string_view key) {
      const GroupInfo& info = GroupTable()[static_cast<std::size_t>(group)];
      const auto at = std::find(info.keys.begin(), info.keys.end(), key) - info.keys.begin();
      const auto& codes = data_.codes[static_cast<std::size_t>(group)];
      if (!codes[static_cast<std::size_t>(at)]) {
        table.ErrorAt(table.value(),
                      "no code 'codes." + std::string(info.name) + "." + std::string(key) + "'");
      }
    };
    need(Group::kMotion, "rapid");
    need(Group::kMotion, "line");
    need(Group::kFeedMode, "per_minute");
    need(Group::kSpindle, "off");
    need(Group::kSpindle, "clockwise");
    need(Group::kCoolant, "off");
    need(Group::kUnit, data_.unit == ClUnit::kInch ? "inch" : "mm");
    const auto& comp = data_.codes[static_cast<std::size_t>(Group::kComp)];
    if (comp[1] || comp[2]) need(Group::kComp, "off");
  }

  /// The writer takes tool and rotary axes to be where an index was to bring them.
  void CheckIndex(const TomlTable& table, const PostMode& mode) const {
    for (const Block block : {Block::kIndex, Block::kRewind}) {
      const BlockTemplate* found = data_.Find(block, &mode);
      if (found == nullptr) continue;
      const bool turns = found->Uses(Value::kRotary1) || found->Uses(Value::kPlaneXyzX) ||
                         data_.FindWord(Value::kRotary1) == nullptr;
      const bool moves = found->Uses(Value::kX) && found->Uses(Value::kY) && found->Uses(Value::kZ);
      if (turns && moves) continue;
      const BlockInfo& info = BlockTable()[static_cast<std::size_t>(block)];
      table.ErrorAt(table.value(), "block '" + std::string(info.name) + "' of mode '" + mode.name +
                                       "' prints not all of x, y, z and the rotary axes");
    }
  }

  void CheckBlocks(const TomlTable& table) {
    CheckCodes(table);
    for (const PostMode& mode : data_.modes) {
      CheckIndex(table, mode);
      for (int b = 0; b < kBlocks; ++b) {
        const BlockInfo& info = BlockTable()[static_cast<std::size_t>(b)];
        const bool needed = info.required || (info.name == "arc" && !mode.arc_planes.empty()) ||
                            (mode.cycles && (info.name == "hole" || info.name == "cycle_end"));
        if (needed && data_.Find(static_cast<Block>(b), &mode) == nullptr) {
          table.ErrorAt(table.value(),
                        "no block '" + std::string(info.name) + "' for mode '" + mode.name + "'");
        }
      }
    }
  }

  const std::string& source_;
  const std::string& file_;
  const PostSettings& settings_;
  Diagnostics* diagnostics_;
  PostData data_;
};

}  // namespace

std::optional<PostData> LoadPost(const std::string& text, const std::string& file,
                                 const PostSettings& settings, Diagnostics* diagnostics) {
  return PostLoader(text, file, settings, diagnostics).Run();
}

}  // namespace ncsim::post
