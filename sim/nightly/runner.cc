// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/runner.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "sim/base/digest.h"
#include "sim/base/file.h"
#include "sim/nightly/child.h"
#include "sim/report/printable.h"

namespace ncsim::nightly {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxOutput = std::uint64_t{1} << 30U;
constexpr std::size_t kMaxTroubleLines = 20;

std::string ReadOr(const std::string& path, const std::string& otherwise) {
  std::string reason;
  return ReadFile(path, kMaxOutput, &reason).value_or(otherwise);
}

/// The last lines of what a check has said on standard error.
std::string LastWords(const std::string& path) {
  const std::vector<std::string> lines = report::PrintableLines(ReadOr(path, ""));
  std::string text;
  for (std::size_t i = lines.size() - std::min(kMaxTroubleLines, lines.size()); i < lines.size();
       ++i) {
    text += (text.empty() ? "" : "\n") + lines[i];
  }
  return text;
}

/// Lines as an editor counts them: they end at LF, CR LF or CR.
std::vector<std::string_view> LinesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    const bool two = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (two ? 2 : 1), text.size()));
  }
  return lines;
}

/// Gives each finding the text of its line.
void AddSources(const std::string& root, std::vector<ReportFinding>* findings) {
  std::map<std::string, std::pair<std::string, std::vector<std::string_view>>> files;
  for (ReportFinding& finding : *findings) {
    if (finding.line <= 0) continue;
    const auto [it, is_new] = files.try_emplace(finding.file);
    auto& [text, lines] = it->second;
    if (is_new) {
      text = ReadOr((fs::path(root) / finding.file).string(), "");
      lines = LinesOf(text);
    }
    const auto line = static_cast<std::size_t>(finding.line);
    if (line > lines.size()) continue;
    constexpr std::string_view kBlank = " \t";
    std::string source = report::Printable(lines[line - 1].substr(0, 200));
    source.erase(0, std::min(source.find_first_not_of(kBlank), source.size()));
    source.erase(source.find_last_not_of(kBlank) + 1);
    finding.source = std::move(source);
  }
}

class Runner {
 public:
  explicit Runner(const RunOptions& options) : options_(options) {}

  Result Check(const Entry& entry, std::size_t number) const {
    const std::string base = options_.scratch + "/" + std::to_string(number);
    const std::string json = base + ".json", inputs = base + ".inputs", err = base + ".err";
    const std::string page = base + ".html";
    std::vector<std::string> command = {options_.executable};
    for (std::string& word : entry.Words()) command.push_back(std::move(word));
    command.insert(command.end(), {"--format", "json", "--out", json, "--inputs", inputs});
    if (options_.threads > 0) {
      command.insert(command.end(), {"--jobs", std::to_string(options_.threads)});
    }
    if (!options_.pages.empty()) command.insert(command.end(), {"--report", page});
    const ChildRun run = RunChild(command, options_.root, base + ".out", err, entry.timeout);
    Result result;
    result.name = entry.name;
    result.key = KeyOf(entry, options_.build);
    Judge(run, command.at(2), ReadOr(json, ""), LastWords(err), &result);
    if (result.report) {
      AddSources(options_.root, &result.report->findings);
      result.inputs = ReadInputs(ReadOr(inputs, "")).value_or(std::vector<Input>());
      const std::string html = ReadOr(page, "");
      if (!html.empty()) WriteWhole(options_.pages + "/" + PageName(result), html);
    }
    for (const char* suffix : {".json", ".inputs", ".err", ".out", ".html"}) {
      std::error_code error;
      fs::remove(base + suffix, error);
    }
    return result;
  }

 private:
  /// A report counts only if it is of this program, and with the exit code of its verdict.
  static void Judge(const ChildRun& run, const std::string& program, const std::string& json,
                    const std::string& words, Result* result) {
    const std::string tail = words.empty() ? "" : "\n" + words;
    if (!run.trouble.empty()) {
      result->trouble = run.trouble + tail;
    } else if (run.exit_code == 3) {
      result->bad_input = true;
      result->trouble = words.empty() ? "bad input" : words;
    } else if (run.exit_code > 3) {
      result->trouble = "internal error (exit code " + std::to_string(run.exit_code) + ")" + tail;
    } else {
      std::optional<Report> report = ReadReport(json);
      const char* verdict = run.exit_code == 0 ? "pass" : run.exit_code == 1 ? "fail" : "unproven";
      if (report && report->verdict == verdict && report->program == program) {
        result->report = std::move(report);
      } else {
        result->trouble = std::string("the report is not what a check writes that ends with ") +
                          "exit code " + std::to_string(run.exit_code) + tail;
      }
    }
  }

  const RunOptions& options_;
};

}  // namespace

std::string KeyOf(const Entry& entry, const std::string& build) {
  std::string all = build;
  for (const std::string& word : entry.Words()) all.append(1, '\0').append(word);
  return ToString(DigestOf(all));
}

std::vector<Result> RunChecks(const std::vector<Entry>& entries, const RunOptions& options,
                              const std::function<std::optional<Result>(const Entry&)>& known,
                              const Progress& progress) {
  std::vector<Result> results(entries.size());
  std::mutex mutex;
  std::vector<std::size_t> open;
  const auto has_page = [&](const Result& result) {
    return options.pages.empty() || fs::exists(options.pages + "/" + PageName(result));
  };
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::optional<Result> old = known(entries[i]);
    if (old && old->StillHolds(KeyOf(entries[i], options.build), options.root) && has_page(*old)) {
      results[i] = std::move(*old);
      progress(results[i], false);
    } else {
      open.push_back(i);
    }
  }
  const Runner runner(options);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < open.size(); k = next++) {
      const std::size_t i = open[k];
      results[i] = runner.Check(entries[i], i);
      const std::lock_guard lock(mutex);
      progress(results[i], true);
    }
  };
  {
    std::vector<std::jthread> pool;
    for (int i = 1; i < options.jobs; ++i) pool.emplace_back(work);
    work();
  }
  return results;
}

bool WriteWhole(const std::string& path, const std::string& text) {
  // Another machine may write the same file.
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string temporary = path + "." + host.data() + "." + std::to_string(getpid()) + ".new";
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(temporary, path, error);
  if (file && !error) return true;
  fs::remove(temporary, error);
  return false;
}

}  // namespace ncsim::nightly
