// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/cache_folder.h"

#include <utility>

namespace ncsim::app {

std::optional<CacheFolder> CacheFolder::Open(const std::string& folder, std::ostream& err) {
  std::string reason;
  std::unique_ptr<RecordStore> store = RecordStore::Open(folder, &reason);
  if (store == nullptr) {
    err << folder << ": error: cannot be a cache: " << reason << "\n";
    return std::nullopt;
  }
  const std::optional<Digest> build = DigestOfThisProgram();
  if (!build.has_value()) {
    err << folder << ": error: cannot be a cache: this program cannot read its own files\n";
    return std::nullopt;
  }
  return CacheFolder(std::move(store), *build);
}

void CacheFolder::Finish(std::uint64_t recalled, std::uint64_t all, std::ostream& err) const {
  if (all > 0) {
    err << store_->folder() << ": cache: " << recalled << " of " << all << " outcomes were known\n";
  }
  if (const std::string trouble = store_->trouble(); !trouble.empty()) {
    err << store_->folder() << ": warning: the cache cannot be written: " << trouble << "\n";
  }
  if (recalled < all) store_->Trim(kMostBytes);
}

}  // namespace ncsim::app
