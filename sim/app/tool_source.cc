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

/// What the blocks of a SINUMERIK program say.
struct SinumerikTools {
  std::set<int> numbers;  ///< `T5`, `T=5`.
  double unit = 0.0;      ///< mm, by the first of G70, G71, G700, G710; 0 without one.
};

double UnitOf(const nc::SinumerikPart& part) {
  if (part.letter != 'G' || part.kind != nc::SinumerikPartKind::kWord) return 0.0;
  if (part.value == 70.0 || part.value == 700.0) return kMmPerInch;
  return part.value == 71.0 || part.value == 710.0 ? 1.0 : 0.0;
}

SinumerikTools FindSinumerikTools(const nc::Program& program) {
  SinumerikTools tools;
  nc::SinumerikBlock block;
  int line = 1;
  for (std::size_t at = program.begin(); at < program.text().size(); ++line) {
    nc::ParseSinumerikBlock(program, at, line, &block);
    at = block.next;
    for (const nc::SinumerikPart& part : block.parts) {
      if (tools.unit == 0.0) tools.unit = UnitOf(part);
      if (part.letter != 'T') continue;
      double value = part.value;
      if (part.kind == nc::SinumerikPartKind::kAssign) {
        const auto [first, end] = std::pair(part.expression.begin, part.expression.end);
        const bool number = end == first + 1 && block.code[first].op == nc::SinumerikOp::kInteger;
        value = number ? block.code[first].number : 0.0;
      }
      const bool whole = value >= 1.0 && value <= kMaxToolNumber && value == std::floor(value);
      if (whole) tools.numbers.insert(static_cast<int>(value));
    }
  }
  return tools;
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
  const bool sinumerik = machine.control.dialect == control::kSinumerik840d;
  const SinumerikTools called = sinumerik ? FindSinumerikTools(program) : SinumerikTools();
  const double unit = !sinumerik           ? ProgramUnit(machine, job, program)
                      : called.unit == 0.0 ? 1.0
                                           : called.unit;
  std::map<int, machine::Tool> tools;
  for (const nc::HeaderTool& header :
       sinumerik ? nc::ReadSinumerikHeaderTools(program) : nc::ReadHeaderTools(program)) {
    machine::Tool tool = machine::AssumeTool(header.number, header.name, unit * header.diameter,
                                             unit * header.corner_radius, 0.0, interface);
    tool.assumed +=
        " (diameter from the program's comment at line " + std::to_string(header.line) + ")";
    tools.emplace(header.number, std::move(tool));
  }
  for (const int number : sinumerik ? called.numbers : ToolNumbers(program)) {
    if (tools.count(number) == 0) {
      tools.emplace(number, machine::AssumeTool(number, "", 0.0, 0.0, 0.0, interface));
    }
  }
  machine::ToolTable table;
  for (auto& [number, tool] : tools) table.tools.push_back(std::move(tool));
  return table;
}

}  // namespace ncsim::app
