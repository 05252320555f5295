// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/manifest.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/base/toml_reader.h"

namespace ncsim::nightly {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxManifestBytes = 1 << 26;
constexpr std::string_view kJobSuffix = ".job.toml";
constexpr std::array<std::string_view, 8> kProgramExtensions = {".nc",  ".mpf", ".tap", ".ngc",
                                                                ".cnc", ".eia", ".min", ".iso"};
constexpr double kLongestTimeout = 1e6;  // s

bool IsProgram(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::find(kProgramExtensions.begin(), kProgramExtensions.end(), extension) !=
         kProgramExtensions.end();
}

/// All files below `folder`, relative to it, in order of names; no hidden folders.
std::vector<std::string> FilesBelow(const std::string& folder, Diagnostics* diagnostics) {
  std::vector<std::string> files;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, error);
  for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    if (it->is_directory(gone) && it->path().filename().string().starts_with(".")) {
      it.disable_recursion_pending();
    }
    if (it->is_regular_file(gone)) {
      files.push_back(it->path().lexically_relative(folder).generic_string());
    }
  }
  if (error) diagnostics->Error(folder, 0, 0, "cannot be searched: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

double BytesOf(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  return error ? 0.0 : static_cast<double>(bytes);
}

Entry MakeEntry(const std::string& program, const std::string& root,
                const EntryDefaults& defaults) {
  Entry entry;
  entry.name = entry.program = program;
  entry.model = defaults.model;
  entry.assume = defaults.assume;
  entry.strict = defaults.strict;
  entry.timeout = defaults.timeout;
  entry.cost = BytesOf(fs::path(root) / program);
  return entry;
}

/// A path of the command line as it is from `root`.
std::string SeenFrom(const std::string& root, const std::string& path) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return path;  // A model that ships, by its name.
  return fs::relative(path, root, error).generic_string();
}

std::string NotChecked(const std::vector<std::string>& names, const std::string& why) {
  constexpr std::size_t kNamed = 5;
  std::string text = std::to_string(names.size()) + why;
  for (std::size_t i = 0; i < std::min(kNamed, names.size()); ++i) {
    text += (i == 0 ? ": " : ", ") + names[i];
  }
  return text + (names.size() > kNamed ? ", ..." : "");
}

class ManifestReader {
 public:
  ManifestReader(const std::string& path, TomlTable file, EntryDefaults defaults)
      : file_(std::move(file)), defaults_(std::move(defaults)) {
    manifest_.root = fs::path(path).parent_path().string();
    if (manifest_.root.empty()) manifest_.root = ".";
  }

  Manifest Read() {
    if (file_.Require("schema") != nullptr) file_.Integer("schema", 1, 1);
    ReadCommon(&file_, &defaults_);
    for (TomlTable& table : file_.Tables("program")) ReadEntry(&table);
    file_.Finish();
    if (manifest_.entries.empty()) file_.ErrorAt(file_.value(), "no [[program]] is listed");
    if (with_cost_ > 0 && with_cost_ < manifest_.entries.size()) {
      file_.ErrorAt(file_.value(), "'cost' must be stated of every program, or of none");
    }
    return std::move(manifest_);
  }

 private:
  static void ReadCommon(TomlTable* table, EntryDefaults* values) {
    if (auto model = table->String("model")) values->model = *model;
    if (table->value().Find("assume") != nullptr) values->assume = table->Strings("assume");
    values->strict = table->Boolean("strict").value_or(values->strict);
    const auto timeout = table->Number("timeout_s", NumberRule::kPositive);
    if (timeout) values->timeout = std::min(*timeout, kLongestTimeout);
    table->Strings("assume");  // Asked for, so that it is known where it is absent too.
  }

  void ReadEntry(TomlTable* table) {
    EntryDefaults own = defaults_;
    ReadCommon(table, &own);
    const std::string program = table->RequiredString("program").value_or("");
    Entry entry = MakeEntry(program, manifest_.root, own);
    entry.job = table->String("job").value_or("");
    entry.name = table->String("name").value_or(program);
    entry.clearance = table->Number("clearance", NumberRule::kNotNegative);
    if (const auto cost = table->Number("cost", NumberRule::kPositive)) {
      entry.cost = *cost;
      ++with_cost_;
    }
    table->Finish();
    if (program.empty() || entry.name.empty()) {
      table->ErrorAt(table->value(), "'program' and 'name' must not be empty");
    } else if (!names_.insert(entry.name).second) {
      table->ErrorAt(table->value(),
                     "'" + entry.name + "' is listed twice: give each its own 'name'");
    }
    manifest_.entries.push_back(std::move(entry));
  }

  TomlTable file_;
  EntryDefaults defaults_;
  Manifest manifest_;
  std::set<std::string> names_;
  std::size_t with_cost_ = 0;
};

}  // namespace

std::vector<std::string> Entry::Words() const {
  std::vector<std::string> words = {"check", program.starts_with("-") ? "./" + program : program};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--model", model);
  add("--job", job);
  for (const std::string& accepted : assume) add("--assume", accepted);
  if (clearance) add("--clearance", Short(*clearance, 9));
  if (strict) words.emplace_back("--strict");
  return words;
}

std::optional<Manifest> FindPrograms(const std::string& folder, const EntryDefaults& defaults,
                                     Diagnostics* diagnostics) {
  Manifest manifest;
  manifest.root = folder;
  EntryDefaults from_root = defaults;
  from_root.model = SeenFrom(folder, defaults.model);
  const std::vector<std::string> files = FilesBelow(folder, diagnostics);
  std::set<std::string> jobs, used;
  for (const std::string& file : files) {
    if (file.ends_with(kJobSuffix)) jobs.insert(file.substr(0, file.size() - kJobSuffix.size()));
  }
  std::vector<std::string> without;
  for (const std::string& file : files) {
    const std::string stem = fs::path(file).replace_extension("").generic_string();
    const bool program = IsProgram(file);
    const bool appended = jobs.count(file) > 0;
    const bool replaced = program && jobs.count(stem) > 0;
    if (appended) used.insert(file);
    if (replaced) used.insert(stem);
    if (appended || replaced || (program && !defaults.model.empty())) {
      manifest.entries.push_back(MakeEntry(file, folder, from_root));
    } else if (program) {
      without.push_back(file);
    }
  }
  std::vector<std::string> idle;
  for (const std::string& job : jobs) {
    if (used.count(job) == 0) idle.push_back(job + std::string(kJobSuffix));
  }
  if (!without.empty()) {
    manifest.notes.push_back(NotChecked(without, " without a job, not checked (--model M.urdf)"));
  }
  if (!idle.empty()) manifest.notes.push_back(NotChecked(idle, " without a program beside it"));
  if (manifest.entries.empty()) {
    diagnostics->Error(folder, 0, 0, "there is no NC program with a job beside it");
  }
  if (diagnostics->has_errors()) return std::nullopt;
  return manifest;
}

std::optional<Manifest> ReadManifest(const std::string& path, const EntryDefaults& defaults,
                                     Diagnostics* diagnostics) {
  std::string reason;
  const std::optional<std::string> text = ReadFile(path, kMaxManifestBytes, &reason);
  if (!text) {
    diagnostics->Error(path, 0, 0, "cannot be read: " + reason);
    return std::nullopt;
  }
  const std::optional<TomlValue> toml = ParseToml(*text, path, diagnostics);
  if (!toml) return std::nullopt;
  EntryDefaults from_root = defaults;
  const std::string root = fs::path(path).parent_path().string();
  from_root.model = SeenFrom(root.empty() ? "." : root, defaults.model);
  Manifest manifest = ManifestReader(path, TomlTable(*toml, path, diagnostics), from_root).Read();
  if (diagnostics->has_errors()) return std::nullopt;
  std::sort(manifest.entries.begin(), manifest.entries.end(),
            [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return manifest;
}

std::vector<Entry> Shard(const std::vector<Entry>& entries, int index, int count) {
  std::vector<const Entry*> order;
  for (const Entry& entry : entries) order.push_back(&entry);
  std::sort(order.begin(), order.end(), [](const Entry* a, const Entry* b) {
    return a->cost != b->cost ? a->cost > b->cost : a->name < b->name;
  });
  std::vector<double> load(static_cast<std::size_t>(count), 0.0);
  std::vector<Entry> mine;
  for (const Entry* entry : order) {
    const auto least = std::min_element(load.begin(), load.end());
    if (least - load.begin() == index) mine.push_back(*entry);
    // A program of no bytes still takes a process.
    *least += std::max(entry->cost, 1e-3);
  }
  std::sort(mine.begin(), mine.end(),
            [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return mine;
}

}  // namespace ncsim::nightly
