// SPDX-License-Identifier: BSD-3-Clause
// Records in a folder, a file each, found by a key. Nobody relies on them: what is damaged, or not
// of this key, is removed and not there.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "sim/base/digest.h"

namespace ncsim {

/// Any number of threads and of processes may use a folder at a time: a file appears under its name
/// when it is whole.
class RecordStore {
 public:
  /// No record is larger, bytes.
  static constexpr std::uint64_t kLargest = std::uint64_t{1} << 26U;

  /// Makes the folder where it is not there. Null where that fails; `reason` then says why.
  static std::unique_ptr<RecordStore> Open(const std::string& folder, std::string* reason);

  /// Reading counts as use.
  std::optional<std::string> Read(const Digest& key);
  /// Replaces a record of this key. After a failure nothing more is written.
  void Write(const Digest& key, std::string_view record);
  /// Removes the records that were not used for the longest time until those that are left take no
  /// more than `most` bytes. Leaves other files alone.
  void Trim(std::uint64_t most);

  const std::string& folder() const { return folder_; }
  /// Why a record could not be written, or "".
  std::string trouble() const;

 private:
  explicit RecordStore(std::string folder) : folder_(std::move(folder)) {}
  std::string PathOf(const Digest& key) const;
  std::string TemporaryName() const;
  void Fail(const std::string& what);

  std::string folder_;
  mutable std::mutex mutex_;  // of trouble_
  std::string trouble_;
  std::atomic<bool> writes_{true};
};

}  // namespace ncsim
