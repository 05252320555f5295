// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/history.h"

#include <sqlite3.h>

#include <initializer_list>

#include "sim/base/digest.h"

namespace ncsim::nightly {
namespace {

constexpr int kVersion = 1;
constexpr int kBusyTimeout = 30'000;  // ms

// A report is kept once under its digest: most programs say the same every night.
constexpr const char* kSchema = R"sql(
BEGIN IMMEDIATE;
CREATE TABLE IF NOT EXISTS nights(night TEXT PRIMARY KEY) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS rows(night TEXT, program TEXT, verdict TEXT NOT NULL, trouble TEXT NOT NULL,
  report TEXT, PRIMARY KEY(program, night)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS reports(digest TEXT PRIMARY KEY, report TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS known(program TEXT PRIMARY KEY, result TEXT NOT NULL);
PRAGMA user_version = 1;
COMMIT;
)sql";

/// A statement with its values.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql, std::initializer_list<std::string> values) {
    if (sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr) != SQLITE_OK) return;
    int index = 0;
    for (const std::string& value : values) {
      sqlite3_bind_text64(statement_, ++index, value.data(), value.size(), SQLITE_TRANSIENT,
                          SQLITE_UTF8);
    }
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// There is a (further) row.
  bool Step() { return statement_ != nullptr && sqlite3_step(statement_) == SQLITE_ROW; }
  /// Runs to the end.
  bool Run() { return statement_ != nullptr && sqlite3_step(statement_) == SQLITE_DONE; }
  std::string Text(int column) const {
    const auto* text = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return text == nullptr ? "" : std::string(text, size);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
};

int VersionOf(sqlite3* database) {
  Statement version(database, "PRAGMA user_version", {});
  return version.Step() ? std::atoi(version.Text(0).c_str()) : -1;
}

}  // namespace

std::unique_ptr<History> History::Open(const std::string& path, std::string* reason) {
  sqlite3* database = nullptr;
  const int opened =
      sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  std::unique_ptr<History> history(new History(database));
  if (opened == SQLITE_OK) {
    sqlite3_busy_timeout(database, kBusyTimeout);
    const int version = VersionOf(database);
    if (version == kVersion || (version == 0 && history->Execute(kSchema))) return history;
    if (version > 0) {
      *reason = "it is the history of another version of ncsim";
      return nullptr;
    }
  }
  *reason = history->trouble();
  return nullptr;
}

History::~History() { sqlite3_close(database_); }

std::string History::trouble() const { return sqlite3_errmsg(database_); }

bool History::Execute(const char* sql) {
  return sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

std::optional<Result> History::Known(const std::string& name) {
  Statement known(database_, "SELECT result FROM known WHERE program = ?", {name});
  return known.Step() ? ReadResult(known.Text(0)) : std::nullopt;
}

bool History::Remember(const Result& result) {
  return Statement(database_, "INSERT OR REPLACE INTO known VALUES(?, ?)",
                   {result.name, WriteResult(result)})
      .Run();
}

std::string History::NightBefore(const std::string& night) {
  Statement before(database_, "SELECT max(night) FROM nights WHERE night < ?", {night});
  return before.Step() ? before.Text(0) : "";
}

std::vector<std::string> History::NamesOf(const std::string& night) {
  Statement names(database_, "SELECT program FROM rows WHERE night = ? ORDER BY program", {night});
  std::vector<std::string> all;
  while (names.Step()) all.push_back(names.Text(0));
  return all;
}

std::optional<PastRow> History::LastChecked(const std::string& name, const std::string& night) {
  Statement last(database_,
                 "SELECT verdict, reports.report FROM rows JOIN reports ON digest = rows.report "
                 "WHERE program = ? AND night < ? ORDER BY night DESC LIMIT 1",
                 {name, night});
  if (!last.Step()) return std::nullopt;
  const std::optional<Result> kept = ReadResult(last.Text(1));
  if (!kept || !kept->report) return std::nullopt;
  return PastRow{name, last.Text(0), "", kept->report};
}

bool History::Record(const std::string& night, const std::vector<PastRow>& rows) {
  if (!Execute("BEGIN IMMEDIATE")) return false;
  if (RecordRows(night, rows) && Execute("COMMIT")) return true;
  Execute("ROLLBACK");
  return false;
}

bool History::RecordRows(const std::string& night, const std::vector<PastRow>& rows) {
  if (!Statement(database_, "DELETE FROM rows WHERE night = ?", {night}).Run()) return false;
  if (!Statement(database_, "INSERT OR IGNORE INTO nights VALUES(?)", {night}).Run()) return false;
  for (const PastRow& row : rows) {
    std::string digest;
    if (row.report) {
      Result kept;
      kept.name = row.name;
      kept.report = row.report;
      const std::string text = WriteResult(kept);
      digest = ToString(DigestOf(text));
      Statement report(database_, "INSERT OR IGNORE INTO reports VALUES(?, ?)", {digest, text});
      if (!report.Run()) return false;
    }
    Statement insert(database_, "INSERT INTO rows VALUES(?, ?, ?, ?, nullif(?, ''))",
                     {night, row.name, row.verdict, row.trouble, digest});
    if (!insert.Run()) return false;
  }
  const std::string kept = std::to_string(kNightsKept);
  return Statement(database_,
                   "DELETE FROM nights WHERE night NOT IN "
                   "(SELECT night FROM nights ORDER BY night DESC LIMIT CAST(? AS INTEGER))",
                   {kept})
             .Run() &&
         Execute("DELETE FROM rows WHERE night NOT IN (SELECT night FROM nights)") &&
         Execute(
             "DELETE FROM reports WHERE digest NOT IN "
             "(SELECT report FROM rows WHERE report IS NOT NULL)");
}

}  // namespace ncsim::nightly
