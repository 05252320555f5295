// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string_view>

#include "sim/nightly/night.h"
#include "sim/report/printable.h"
#include "sim/report/result.h"

namespace ncsim::nightly {
namespace {

/// Lines of one kind below a row.
constexpr std::size_t kMaxLines = 5;

using Cells = std::array<std::string, 7>;

/// Columns on a terminal of UTF-8 text.
std::size_t Width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

Cells CellsOf(const Row& row) {
  Cells cells = {row.verdict, report::Printable(row.name), "",       "",
                 "",          LeastClearance(row),         News(row)};
  if (row.report) {
    cells[2] = report::Printable(row.report->model);
    cells[3] = std::to_string(row.report->blocks);
    cells[4] = report::Duration(row.report->time);
  }
  return cells;
}

void WriteCells(const Cells& cells, const std::array<std::size_t, 7>& widths, std::ostream& out) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string pad(widths.at(i) - Width(cells.at(i)), ' ');
    const bool number = i == 3 || i == 4;
    line += number ? pad + cells.at(i) : cells.at(i) + pad;
    line += "  ";
  }
  out << line.substr(0, line.find_last_not_of(' ') + 1) << "\n";
}

void WriteLines(const char* what, const std::vector<std::string>& lines, std::ostream& out) {
  for (std::size_t i = 0; i < std::min(kMaxLines, lines.size()); ++i) {
    out << "  " << what << lines[i] << "\n";
  }
  if (lines.size() > kMaxLines) {
    out << "  " << what << "... and " << lines.size() - kMaxLines << " more\n";
  }
}

void WriteDetails(const Row& row, std::ostream& out) {
  WriteLines("", report::PrintableLines(row.trouble), out);
  std::vector<std::string> fresh, fixed, falls;
  const JudgedFinding* worst = nullptr;  // Of those that were there before.
  std::size_t stopping = 0;
  for (const JudgedFinding& judged : row.findings) {
    if (judged.is_new) {
      fresh.push_back(InALine(judged.finding));
    } else if (judged.counts() && judged.rank() < 2) {
      if (worst == nullptr || judged.rank() < worst->rank()) worst = &judged;
      ++stopping;
    }
  }
  if (worst != nullptr) {
    out << "  " << InALine(worst->finding);
    out << (stopping > 1 ? " and " + std::to_string(stopping - 1) + " more\n" : "\n");
  }
  for (const ReportFinding& finding : row.fixed) fixed.push_back(InALine(finding));
  for (const Fall& fall : row.falls) falls.push_back(InALine(fall));
  WriteLines("new: ", fresh, out);
  WriteLines("fixed: ", fixed, out);
  WriteLines("closer: ", falls, out);
}

}  // namespace

void WriteTable(const Night& night, std::ostream& out) {
  const Cells header = {"verdict", "program",         "machine", "blocks",
                        "time",    "least clearance", "news"};
  std::vector<Cells> rows;
  std::array<std::size_t, 7> widths{};
  for (std::size_t i = 0; i < header.size(); ++i) widths.at(i) = header.at(i).size();
  for (const Row& row : night.rows) {
    rows.push_back(CellsOf(row));
    for (std::size_t i = 0; i < header.size(); ++i) {
      widths.at(i) = std::max(widths.at(i), Width(rows.back().at(i)));
    }
  }
  WriteCells(header, widths, out);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    WriteCells(rows[i], widths, out);
    WriteDetails(night.rows[i], out);
  }
  for (const std::string& name : night.gone) {
    out << "gone: " << report::Printable(name) << "\n";
  }
  for (const AcceptanceState& state : night.baseline) out << "baseline: " << InALine(state) << "\n";
  for (const std::string& note : night.notes) out << "note: " << report::Printable(note) << "\n";
  out << night.day
      << (night.before.empty() ? ", no night before" : ", compared with " + night.before) << "; "
      << CountVerdicts(night) << "\n";
}

}  // namespace ncsim::nightly
