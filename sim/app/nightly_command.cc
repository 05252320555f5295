// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/nightly_command.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/app/app.h"
#include "sim/base/digest.h"
#include "sim/base/file.h"
#include "sim/collision/threads.h"
#include "sim/nightly/night.h"
#include "sim/nightly/runner.h"
#include "sim/nightly/scratch.h"

namespace ncsim::app {
namespace {

namespace fs = std::filesystem;
using nightly::Entry;
using nightly::Result;

constexpr std::uint64_t kMaxShardBytes = std::uint64_t{1} << 32U;

std::string Today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 11> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &local);
  return text.data();
}

class NightlyRun {
 public:
  NightlyRun(const NightlyOptions& options, std::ostream& out, std::ostream& err)
      : options_(options), out_(out), err_(err) {}

  int Run() {
    if (!Prepare()) return kExitBadInput;
    if (options_.shard_count > 0) return RunShard();
    std::string reason;
    history_ = nightly::History::Open(HistoryPath(), &reason);
    if (history_ == nullptr) return Complain(HistoryPath(), reason);
    std::optional<std::vector<Result>> results =
        options_.merge ? Merge() : Check(manifest_.entries);
    return results ? Close(*results) : kExitBadInput;
  }

 private:
  int Complain(const std::string& where, const std::string& what) {
    err_ << where << ": error: " << what << "\n";
    return kExitBadInput;
  }

  std::string HistoryPath() const { return options_.out + "/history.sqlite"; }
  std::string ShardPath(int index, int count) const {
    return options_.out + "/shards/" + std::to_string(index) + "-of-" + std::to_string(count) +
           ".json";
  }
  std::string PagesFolder() const { return options_.out + "/reports"; }

  bool Prepare() {
    Diagnostics diagnostics;
    const nightly::EntryDefaults defaults{options_.model, options_.assume, options_.strict,
                                          options_.timeout};
    auto manifest = IsFolder(options_.what)
                        ? nightly::FindPrograms(options_.what, defaults, &diagnostics)
                        : nightly::ReadManifest(options_.what, defaults, &diagnostics);
    if (!options_.baseline.empty()) {
      auto baseline = nightly::ReadBaseline(options_.baseline, &diagnostics);
      if (baseline) baseline_ = std::move(*baseline);
    }
    for (const Diagnostic& diagnostic : diagnostics.all()) err_ << ToString(diagnostic) << "\n";
    if (!manifest || diagnostics.has_errors()) return false;
    manifest_ = std::move(*manifest);
    day_ = options_.today.empty() ? Today() : options_.today;
    std::error_code error;
    fs::create_directories(options_.out + "/shards", error);
    if (!error && options_.reports) fs::create_directories(PagesFolder(), error);
    if (error) Complain(options_.out, "cannot be made: " + error.message());
    return !error && FindBuild();
  }

  bool FindBuild() {
    std::error_code error;
    executable_ = options_.executable.empty() ? fs::read_symlink("/proc/self/exe", error).string()
                                              : options_.executable;
    std::optional<Digest> build = DigestOfThisProgram();
    if (!options_.executable.empty()) {
      std::string reason;
      const auto bytes = ReadFile(executable_, std::numeric_limits<std::uint32_t>::max(), &reason);
      build = bytes ? std::optional(DigestOf(*bytes)) : std::nullopt;
    }
    // Models are looked for beside the program, packages above the folder: a copy that lies
    // elsewhere may find others.
    if (build) {
      build_ = ToString(*build) + '\n' + executable_ + '\n' +
               fs::weakly_canonical(manifest_.root, error).string();
    }
    if (!build) Complain(executable_, "this program cannot read its own files");
    return build.has_value();
  }

  /// Of all that shards must agree about.
  std::string Plan() const {
    std::ostringstream text;
    for (const Entry& entry : manifest_.entries) {
      text << entry.name << '\n' << entry.cost << '\n' << nightly::KeyOf(entry, build_) << '\n';
    }
    return ToString(DigestOf(text.view()));
  }

  /// nullopt (said) where there is nowhere to work in.
  std::optional<std::vector<Result>> Check(const std::vector<Entry>& entries) {
    std::error_code error;
    const std::string folder = fs::temp_directory_path(error).string();
    std::string reason = error.message();
    const auto scratch = error ? nullptr : nightly::Scratch::Make(folder, &reason);
    if (scratch == nullptr) {
      Complain(folder, "there is no folder to work in: " + reason);
      return std::nullopt;
    }
    nightly::RunOptions run{executable_,
                            build_,
                            manifest_.root,
                            scratch->path(),
                            options_.jobs,
                            0,
                            options_.reports ? PagesFolder() : ""};
    if (run.jobs > 1) run.threads = std::max(1, collision::DefaultThreads() / run.jobs);
    std::size_t done = 0, checked = 0;
    const auto known = [&](const Entry& entry) {
      return options_.all || history_ == nullptr ? std::nullopt : history_->Known(entry.name);
    };
    const auto progress = [&](const Result& result, bool is_checked) {
      ++done;
      if (!is_checked) return;
      ++checked;
      err_ << "[" << done << "/" << entries.size() << "] " << result.name << ": "
           << (result.report ? result.report->verdict
                             : result.trouble.substr(0, result.trouble.find('\n')))
           << std::endl;  // NOLINT(performance-avoid-endl): somebody waits for it.
      if (result.report && options_.shard_count == 0 && !history_->Remember(result)) {
        err_ << HistoryPath() << ": warning: cannot be written: " << history_->trouble() << "\n";
      }
    };
    auto results = nightly::RunChecks(entries, run, known, progress);
    for (const Result& result : results) {
      if (!options_.reports || !result.report) continue;
      const std::string page = PagesFolder() + "/" + nightly::PageName(result);
      if (!IsFile(page)) err_ << page << ": warning: could not be written\n";
    }
    err_ << checked << " of " << entries.size()
         << " programs were checked, the others are as they were\n";
    return results;
  }

  int RunShard() {
    const std::string path = ShardPath(options_.shard, options_.shard_count);
    std::error_code error;
    fs::remove(path, error);  // What an earlier night has left is no result of this one.
    std::string reason;
    if (fs::exists(HistoryPath(), error)) history_ = nightly::History::Open(HistoryPath(), &reason);
    auto results = Check(nightly::Shard(manifest_.entries, options_.shard, options_.shard_count));
    if (!results) return kExitBadInput;
    const nightly::ShardFile shard{Plan(), options_.shard, options_.shard_count,
                                   std::move(*results)};
    if (!nightly::WriteWhole(path, nightly::WriteShard(shard))) {
      return Complain(path, "cannot be written");
    }
    return kExitPass;
  }

  /// How many shards there are, by the names of the files that are left; 0 (said) where they do not
  /// agree or there are none.
  int CountShards() {
    const std::regex pattern(R"((\d{1,6})-of-(\d{1,6})\.json)");
    std::set<int> counts;
    for (const std::string& name : NamesIn(options_.out + "/shards")) {
      std::smatch match;
      if (std::regex_match(name, match, pattern)) counts.insert(std::stoi(match[2]));
    }
    if (counts.size() == 1 && *counts.begin() > 0) return *counts.begin();
    Complain(options_.out + "/shards",
             counts.empty() ? "there is no shard to merge"
                            : "there are shards of different counts: remove those of other nights");
    return 0;
  }

  std::optional<std::vector<Result>> Merge() {
    const int count = CountShards();
    if (count == 0) return std::nullopt;
    const std::string plan = Plan();
    std::map<std::string, Result> found;
    std::map<std::string, std::string> missing;
    for (int index = 0; index < count; ++index) {
      std::string reason;
      const auto text = ReadFile(ShardPath(index, count), kMaxShardBytes, &reason);
      auto shard = text ? nightly::ReadShard(*text) : std::nullopt;
      const std::string why = !text    ? "left nothing"
                              : !shard ? "cannot be read"
                              : shard->plan != plan
                                  ? "is of another list of programs or another build"
                                  : "";
      const std::string name = "shard " + std::to_string(index) + "/" + std::to_string(count);
      if (!why.empty()) err_ << "ncsim: error: " << name << " " << why << "\n";
      for (const Entry& entry : nightly::Shard(manifest_.entries, index, count)) {
        missing[entry.name] = name + " " + (why.empty() ? "does not have it" : why);
      }
      if (!why.empty()) continue;
      for (Result& result : shard->results) found[result.name] = std::move(result);
    }
    return Collect(found, missing);
  }

  std::vector<Result> Collect(std::map<std::string, Result>& found,
                              const std::map<std::string, std::string>& missing) {
    std::vector<Result> results;
    for (const Entry& entry : manifest_.entries) {
      Result result;
      result.name = entry.name;
      const auto it = found.find(entry.name);
      if (it == found.end()) {
        result.trouble = missing.at(entry.name);
      } else if (it->second.report &&
                 !it->second.StillHolds(nightly::KeyOf(entry, build_), manifest_.root)) {
        result.trouble = "what it was checked with has changed since";
      } else {
        result = std::move(it->second);
        if (result.report) history_->Remember(result);
      }
      results.push_back(std::move(result));
    }
    return results;
  }

  /// Pages of results that are no more are removed.
  void LinkPages(const std::vector<Result>& results, nightly::Night* night) {
    std::set<std::string> linked;
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!results[i].report) continue;
      const std::string page = nightly::PageName(results[i]);
      if (IsFile(PagesFolder() + "/" + page)) {
        night->rows[i].page = "reports/" + page;
        linked.insert(page);
      }
    }
    const std::regex pattern(".*-[0-9a-f]{32}\\.html");
    std::error_code ignored;
    for (const std::string& name : NamesIn(PagesFolder())) {
      const bool ours = std::regex_match(name, pattern);
      if (ours && linked.count(name) == 0) fs::remove(PagesFolder() + "/" + name, ignored);
    }
  }

  int Close(const std::vector<Result>& results) {
    nightly::Night night = nightly::JudgeNight(day_, manifest_, results, baseline_, history_.get());
    LinkPages(results, &night);
    std::vector<int> codes;
    for (const nightly::Row& row : night.rows) codes.push_back(row.exit_code());
    const auto write = [&](const char* name, void (*writer)(const nightly::Night&, std::ostream&)) {
      std::ostringstream text;
      writer(night, text);
      const std::string path = options_.out + "/" + name;
      if (!nightly::WriteWhole(path, text.str()))
        codes.push_back(Complain(path, "cannot be written"));
    };
    write("nightly.json", nightly::WriteNightJson);
    write("nightly.xml", nightly::WriteNightJunit);
    write("index.html", nightly::WriteNightPage);
    nightly::WriteTable(night, out_);
    if (!history_->Record(day_, nightly::PastRows(night))) {
      codes.push_back(Complain(HistoryPath(), "cannot be written: " + history_->trouble()));
    }
    return CombinedExit(codes);
  }

  const NightlyOptions& options_;
  std::ostream& out_;
  std::ostream& err_;
  nightly::Manifest manifest_;
  nightly::Baseline baseline_;
  std::string day_, executable_, build_;
  std::unique_ptr<nightly::History> history_;
};

}  // namespace

int Nightly(const NightlyOptions& options, std::ostream& out, std::ostream& err) {
  return NightlyRun(options, out, err).Run();
}

}  // namespace ncsim::app
