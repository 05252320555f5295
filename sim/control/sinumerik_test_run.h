// SPDX-License-Identifier: BSD-3-Clause
// For tests: runs a SINUMERIK text and writes down what is handed out.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/text.h"
#include "sim/control/sinumerik_flow.h"

namespace ncsim::control {

/// Axes X Y Z A B C X1; system variables are remembered as "$NAME[1,X,TR]" -> value.
class SinumerikTestSystem : public SinumerikSystem {
 public:
  bool IsAxis(std::string_view name) const override {
    return name == "X1" ||
           (name.size() == 1 && std::string_view("XYZABC").find(name[0]) != std::string_view::npos);
  }
  Access Read(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
              nc::SinumerikValue* value, std::string*) override {
    const auto found = values.find(Key(name, indices));
    if (found == values.end()) return Access::kUnknown;
    *value = found->second;
    return Access::kDone;
  }
  Access Write(std::string_view name, const std::vector<nc::SinumerikValue>& indices,
               const nc::SinumerikValue& value, std::string*) override {
    if (name == "$AN_NO") return Access::kUnknown;
    values[Key(name, indices)] = value;
    return Access::kDone;
  }
  void AssumeZero(const std::string& name) override { assumed += name + " "; }

  static std::string Key(std::string_view name, const std::vector<nc::SinumerikValue>& indices) {
    std::string key(name);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      key += (i == 0 ? "[" : ",") + nc::ToText(indices[i]);
    }
    return indices.empty() ? key : key + "]";
  }

  std::map<std::string, nc::SinumerikValue> values;
  std::string assumed;
};

/// A run of `text` to its end, its stop, or `max_blocks`.
class SinumerikTestRun {
 public:
  explicit SinumerikTestRun(std::string text, SinumerikFlowOptions options = {},
                            std::string name = "t.mpf")
      : flow(nc::Program::FromText(std::move(name), std::move(text)), Bounded(std::move(options)),
             &system, &files, [this](Finding finding) { findings.push_back(std::move(finding)); }) {
    SinumerikStep step;
    while (true) {
      last = flow.Next(&step);
      if (last == SinumerikEvent::kEnd || last == SinumerikEvent::kStopped) return;
      if (last == SinumerikEvent::kSave) trace += "<save>";
      if (last == SinumerikEvent::kRestore) trace += "<restore>";
      if (last != SinumerikEvent::kStep) continue;
      Write(step);
      const SinumerikItem* x = step.Find('X');
      const SinumerikModalCall* modal = x != nullptr ? flow.PathMotionDone() : nullptr;
      if (modal != nullptr) trace += "<" + modal->name + Arguments(modal->arguments) + ">";
    }
  }

  /// "3:5 12080" of the first finding; "" for none.
  std::string First() const {
    if (findings.empty()) return "";
    const Finding& finding = findings.front();
    const std::size_t at = finding.message.rfind("(alarm ");
    const std::string alarm = at == std::string::npos ? std::string(Info(finding.rule).id)
                                                      : finding.message.substr(at + 7, 5);
    return std::to_string(finding.where.line) + ":" + std::to_string(finding.where.column) + " " +
           alarm;
  }
  double Value(std::string_view name) {
    nc::SinumerikValue value;
    return flow.ReadVariable(name, &value) ? value.number : -999.0;
  }
  std::string Text(std::string_view name) {
    nc::SinumerikValue value;
    return flow.ReadVariable(name, &value) ? nc::ToText(value) : "?";
  }

  SinumerikTestSystem system;
  SourceFiles files;
  std::vector<Finding> findings;
  std::string trace;  ///< Blocks, a '|' behind each.
  SinumerikEvent last = SinumerikEvent::kEnd;
  SinumerikFlow flow;

 private:
  static SinumerikFlowOptions Bounded(SinumerikFlowOptions options) {
    if (options.max_blocks > 100'000) options.max_blocks = 100'000;
    return options;
  }
  static std::string Arguments(const std::vector<nc::SinumerikValue>& values) {
    std::string text = "(";
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) text += ",";
      if (!values[i].omitted) text += nc::ToText(values[i]);
    }
    return text + ")";
  }
  void Write(const SinumerikStep& step) {
    bool first = true;
    for (const SinumerikItem& item : step.items) {
      if (!first) trace += " ";
      first = false;
      trace += item.name;
      if (item.kind == SinumerikItemKind::kCall) {
        trace += Arguments(
            {step.values.begin() + static_cast<long>(item.first_value),
             step.values.begin() + static_cast<long>(item.first_value + item.value_count)});
      } else if (item.kind == SinumerikItemKind::kWord && item.extension < 0 && item.letter != 0 &&
                 item.name.size() > 1) {
        continue;  // The name is the whole word.
      } else if (item.kind == SinumerikItemKind::kWord) {
        trace += "=" + (item.is_text ? nc::ToText(step.text(item)) : Short(item.value));
      }
    }
    trace += "|";
  }
};

}  // namespace ncsim::control
