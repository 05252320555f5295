// SPDX-License-Identifier: BSD-3-Clause
#include "post/line_map.h"

#include <algorithm>
#include <sstream>

namespace ncsim::post {
namespace {

constexpr std::string_view kFirstLine = "ncsim lines 1\n";

}  // namespace

void LineMap::Add(int line, int cl_line) {
  if (steps_.empty() || steps_.back().second != cl_line) steps_.emplace_back(line, cl_line);
}

int LineMap::At(int line) const {
  const auto after =
      std::upper_bound(steps_.begin(), steps_.end(), line,
                       [](int wanted, const auto& step) { return wanted < step.first; });
  return after == steps_.begin() ? 0 : std::prev(after)->second;
}

std::string WriteLineMap(const LineMapFile& file) {
  std::string text(kFirstLine);
  text += "program " + file.program + "\ncl " + file.cl + " " + file.cl_name + "\n";
  for (const auto& [line, cl_line] : file.map.steps()) {
    text += std::to_string(line) + " " + std::to_string(cl_line) + "\n";
  }
  return text + "end\n";
}

std::optional<LineMapFile> ReadLineMap(std::string_view text) {
  if (!text.starts_with(kFirstLine)) return std::nullopt;
  LineMapFile file;
  std::istringstream in(std::string(text.substr(kFirstLine.size())));
  std::string word;
  in >> word >> file.program >> word >> file.cl;
  in.get();
  std::getline(in, file.cl_name);
  for (int last = 0, line = 0, cl_line = 0; in >> line >> cl_line; last = line) {
    if (line <= last || cl_line < 1) return std::nullopt;
    file.map.Add(line, cl_line);
  }
  // What is cut short, or otherwise not as it should be, is not what would be written.
  if (WriteLineMap(file) != text) return std::nullopt;
  return file;
}

}  // namespace ncsim::post
