// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/check_command.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <thread>
#include <vector>

#include "sim/app/app.h"
#include "sim/app/cache_folder.h"
#include "sim/app/check_program.h"
#include "sim/app/program_input.h"
#include "sim/app/version.h"
#include "sim/base/input_log.h"
#include "sim/collision/threads.h"
#include "sim/nightly/result.h"
#include "sim/report/batch.h"

namespace ncsim::app {
namespace {

/// An internal error of one program must not take the others' results with it.
ProgramOutcome CheckCatching(const CheckOptions& options, const std::string& program,
                             const ProgressReport& progress, const collision::OutcomeCache* cache) {
  ProgramOutcome outcome;
  try {
    return CheckProgram(options, program, progress, cache);
  } catch (const std::exception& error) {
    outcome.messages = program + ": internal error: " + error.what() + "\n";
  } catch (...) {
    outcome.messages = program + ": internal error\n";
  }
  outcome.exit_code = kExitInternalError;
  return outcome;
}

/// `cache` may be null; `terminal`: where to show how far it is, or null.
std::vector<ProgramOutcome> CheckAll(const CheckOptions& options,
                                     const collision::OutcomeCache* cache, std::ostream* terminal) {
  std::vector<ProgramOutcome> outcomes(options.programs.size());
  ProgressBar bar(options.programs, terminal);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < outcomes.size(); i = next++) {
      outcomes[i] = CheckCatching(options, options.programs[i], bar.ReportOf(i), cache);
      bar.Finish(i);
    }
  };
  const int jobs = options.jobs > 0 ? options.jobs : collision::DefaultThreads();
  const auto threads = std::min(static_cast<std::size_t>(jobs), options.programs.size());
  // A thread for each program; those that are left help with their collisions.
  const collision::ThreadLimit limit(jobs - static_cast<int>(threads) + 1);
  if (threads <= 1) {
    work();
    return outcomes;
  }
  std::vector<std::jthread> pool;
  for (std::size_t i = 0; i < threads; ++i) pool.emplace_back(work);
  pool.clear();  // Joins.
  return outcomes;
}

/// In a format that has all programs in one document.
void WriteBatch(const CheckOptions& options, const std::vector<ProgramOutcome>& outcomes,
                std::ostream& out) {
  std::deque<SourceLines> lines;  // A deque: the reports refer to them.
  std::vector<report::ProgramReport> programs;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const ProgramOutcome& outcome = outcomes[i];
    report::ProgramReport program{options.programs[i], nullptr, nullptr, {}, outcome.messages};
    if (outcome.result) {
      program.result = &*outcome.result;
      program.files = &outcome.files;
      program.line_text = std::ref(lines.emplace_back(outcome.files));
    }
    programs.push_back(std::move(program));
  }
  switch (options.format) {
    case Format::kSarif:
      return report::WriteSarif(programs, kVersion, out);
    case Format::kJunit:
      return report::WriteJunit(programs, out);
    case Format::kGithub:
      return report::WriteGithub(programs, out);
    case Format::kText:
    case Format::kJson:
      break;
  }
}

void WriteReports(const CheckOptions& options, const std::vector<ProgramOutcome>& outcomes,
                  std::ostream& out) {
  if (options.format != Format::kText && options.format != Format::kJson) {
    return WriteBatch(options, outcomes, out);
  }
  const bool array = options.format == Format::kJson && options.programs.size() > 1;
  bool first = true;
  if (array) out << "[\n";
  for (const ProgramOutcome& outcome : outcomes) {
    if (outcome.report.empty()) continue;
    if (!first) out << (array ? ",\n" : "\n");
    first = false;
    out << outcome.report;
  }
  if (array) out << "]\n";
}

/// `--inputs`. A list that cannot be written is no list: nobody relies on what is not there.
void WriteInputs(const CheckOptions& options) {
  if (options.inputs.empty()) return;
  std::ofstream(options.inputs, std::ios::binary | std::ios::trunc)
      << nightly::WriteInputs(LoggedInputs());
}

}  // namespace

int Check(const CheckOptions& options, std::ostream& out, std::ostream& err) {
  if (!options.inputs.empty()) StartInputLog();
  std::ofstream file;
  if (!options.out.empty()) {
    file.open(options.out, std::ios::binary | std::ios::trunc);
    if (!file) {
      err << options.out << ": error: cannot be written\n";
      return kExitBadInput;
    }
  }
  std::optional<CacheFolder> cache;
  if (!options.cache.empty()) {
    cache = CacheFolder::Open(options.cache, err);
    if (!cache) return kExitBadInput;
  }
  const bool progress = &err == &std::cerr && StderrShowsProgress();
  const std::vector<ProgramOutcome> outcomes =
      CheckAll(options, cache ? cache->outcomes() : nullptr, progress ? &err : nullptr);
  WriteInputs(options);
  std::vector<int> codes;
  std::uint64_t all = 0;
  std::uint64_t recalled = 0;
  for (const ProgramOutcome& outcome : outcomes) {
    err << outcome.messages;
    codes.push_back(outcome.exit_code);
    all += outcome.outcomes;
    recalled += outcome.recalled;
  }
  if (cache) cache->Finish(recalled, all, err);
  if (options.out.empty()) {
    WriteReports(options, outcomes, out);
    return CombinedExit(codes);
  }
  WriteReports(options, outcomes, file);
  file.close();
  for (const ProgramOutcome& outcome : outcomes) {
    if (!outcome.summary.empty()) out << outcome.summary << "\n";
  }
  if (!file) {
    err << options.out << ": error: could not be written to its end\n";
    codes.push_back(kExitBadInput);
  }
  return CombinedExit(codes);
}

}  // namespace ncsim::app
