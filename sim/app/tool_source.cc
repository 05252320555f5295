// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/tool_source.h"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "sim/base/units.h"
#include "sim/control/haas_settings.h"
#include "sim/control/setting_source.h"
#include "sim/control/sinumerik_840d.h"
#include "sim/machine/tool_library.h"
#include "sim/nc/header_tools.h"
#include "sim/nc/sinumerik_block.h"

namespace ncsim::app {
namespace {

/// No magazine holds more; a larger number is a mistake that the control reports.
constexpr double kMaxToolNumber = 999.0;

/// T numbers that stand in the blocks of a SINUMERIK program: `T5`, `T=5`.
std::set<int> SinumerikToolNumbers(const nc::Program& program) {
  std::set<int> numbers;
  nc::SinumerikBlock block;
  int line = 1;
  for (std::size_t at = program.begin(); at < program.text().size(); ++line) {
    nc::ParseSinumerikBlock(program, at, line, &block);
    at = block.next;
    for (const nc::SinumerikPart& part : block.parts) {
      if (part.letter != 'T') continue;
      double value = part.value;
      if (part.kind == nc::SinumerikPartKind::kAssign) {
        const auto [first, end] = std::pair(part.expression.begin, part.expression.end);
        const bool number = end == first + 1 && block.code[first].op == nc::SinumerikOp::kInteger;
        value = number ? block.code[first].number : 0.0;
      }
      const bool whole = value >= 1.0 && value <= kMaxToolNumber && value == std::floor(value);
      if (whole) numbers.insert(static_cast<int>(value));
    }
  }
  return numbers;
}

/// T numbers that stand in the blocks.
std::set<int> ToolNumbers(const nc::Program& program) {
  std::set<int> numbers;
  nc::Block block;
  int line = 1;
  for (std::size_t at = program.begin(); at < program.text().size(); ++line) {
    const std::string_view text = program.Line(at);
    nc::ParseBlock(program, at, line, &block);
    at = block.next;
    if (text.find_first_of("Tt") == std::string_view::npos) continue;
    for (const nc::Word& word : block.words) {
      const bool number = word.address == 'T' && word.has_value && !word.is_expression;
      if (!number || !(word.value >= 1.0) || !(word.value <= kMaxToolNumber)) continue;
      if (word.value == std::floor(word.value)) numbers.insert(static_cast<int>(word.value));
    }
  }
  return numbers;
}

}  // namespace

double ProgramUnit(const machine::Machine& machine, const machine::Job& job,
                   const nc::Program& program) {
  const int code = control::FirstUnitCode(program.text());
  if (code != 0) return code == 21 ? 1.0 : kMmPerInch;
  const std::optional<std::string> setting = control::SettingSource(machine, job).Text("setting 9");
  return setting && *setting != "inch" ? 1.0 : kMmPerInch;
}

machine::ToolTable FindTools(const machine::Machine& machine, const machine::Job& job,
                             const nc::Program& program) {
  const std::string& interface = machine.control.spindle_interface;
  if (job.has_tools) {
    machine::ToolTable table{job.tools};
    for (machine::Tool& tool : table.tools) machine::ChangeAssumedHolder(interface, &tool);
    return table;
  }
  const double unit = ProgramUnit(machine, job, program);
  std::map<int, machine::Tool> tools;
  for (const nc::HeaderTool& header : nc::ReadHeaderTools(program)) {
    machine::Tool tool = machine::AssumeTool(header.number, header.name, unit * header.diameter,
                                             unit * header.corner_radius, 0.0, interface);
    tool.assumed +=
        " (diameter from the program's comment at line " + std::to_string(header.line) + ")";
    tools.emplace(header.number, std::move(tool));
  }
  const bool sinumerik = machine.control.dialect == control::kSinumerik840d;
  for (const int number : sinumerik ? SinumerikToolNumbers(program) : ToolNumbers(program)) {
    if (tools.count(number) == 0) {
      tools.emplace(number, machine::AssumeTool(number, "", 0.0, 0.0, 0.0, interface));
    }
  }
  machine::ToolTable table;
  for (auto& [number, tool] : tools) table.tools.push_back(std::move(tool));
  return table;
}

}  // namespace ncsim::app
