// SPDX-License-Identifier: BSD-3-Clause
// What earlier nights found, in a file of SQLite, which is met in history.cc only. Whatever ends
// the process, and whenever: the file holds every night that was recorded, whole, and no half of
// another.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/nightly/result.h"

struct sqlite3;

namespace ncsim::nightly {

/// A row of a night, as it is kept.
struct PastRow {
  std::string name, verdict, trouble;
  std::optional<Report> report;
};

class History {
 public:
  /// Older ones are forgotten.
  static constexpr int kNightsKept = 90;

  /// Makes the file where it is not there. Null where that fails, or where it is no history;
  /// `reason` then says why.
  static std::unique_ptr<History> Open(const std::string& path, std::string* reason);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// The last result of this name that may hold still.
  std::optional<Result> Known(const std::string& name);
  bool Remember(const Result& result);

  /// The last night before `night`; "" where there is none.
  std::string NightBefore(const std::string& night);
  std::vector<std::string> NamesOf(const std::string& night);
  /// Of the last night before `night` in which this program was checked to its end.
  std::optional<PastRow> LastChecked(const std::string& name, const std::string& night);
  /// Replaces `night` where it is known.
  bool Record(const std::string& night, const std::vector<PastRow>& rows);

  /// Why the last call failed.
  std::string trouble() const;

 private:
  explicit History(sqlite3* database) : database_(database) {}
  bool RecordRows(const std::string& night, const std::vector<PastRow>& rows);
  bool Execute(const char* sql);

  sqlite3* database_;
};

}  // namespace ncsim::nightly
