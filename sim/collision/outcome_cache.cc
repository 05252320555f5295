// SPDX-License-Identifier: BSD-3-Clause
#include "sim/collision/outcome_cache.h"

#include <algorithm>
#include <set>

#include "sim/base/bytes.h"

namespace ncsim::collision {

namespace {

/// Outcomes that a record holds, in numbers of its run's pairs. Those of a job that may be changed
/// back stay, and of other runs of the same motions.
constexpr std::size_t kMostVersions = 6;

}  // namespace

KnownRun::KnownRun(RecordStore* store, const Digest& build, const motion::Travel& run,
                   std::uint64_t number, std::size_t pairs)
    : store_(store), place_(PlaceOf(run, number)), uses_(pairs) {
  ByteWriter name;
  PutDigest(build, &name);
  PutDigest(ContentOf(run, place_), &name);
  name_ = DigestOf(name.bytes());
  record_ = store_->Read(name_).value_or("");
  entries_ = Entries(record_);
}

// A key and a text for each outcome; in the order of the keys.
std::vector<KnownRun::Entry> KnownRun::Entries(std::string_view record) {
  std::vector<Entry> entries;
  ByteReader in(record);
  while (in.left() > 0) {
    Entry entry;
    for (std::uint64_t& word : entry.key.words) word = in.Get<std::uint64_t>();
    entry.bytes = in.GetText();
    if (!in.ok()) break;
    entries.push_back(entry);
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.key < b.key; });
  return entries;
}

Digest KnownRun::KeyOf(const Digest& content, const PairCarry& carry,
                       const BlankState* blank) const {
  ByteWriter key;
  PutDigest(content, &key);
  PutDigest(ContentOf(carry, blank, place_), &key);
  return DigestOf(key.bytes());
}

bool KnownRun::Recall(std::size_t pair, const Digest& key, PairOutcome* outcome, PairCarry* carry,
                      BlankState* blank) {
  const auto entry = std::lower_bound(entries_.begin(), entries_.end(), key,
                                      [](const Entry& e, const Digest& k) { return e.key < k; });
  if (entry == entries_.end() || entry->key != key) return false;
  if (!UnpackOutcome(entry->bytes, place_, outcome, carry, blank)) return false;
  uses_[pair] = {key, true, entry->bytes, {}};
  return true;
}

void KnownRun::Keep(std::size_t pair, const Digest& key, const PairOutcome& outcome,
                    const PairCarry& carry, const BlankState* blank) {
  uses_[pair] = {key, false, {}, PackOutcome(outcome, carry, blank, place_)};
}

void KnownRun::Save() {
  if (recalled() == uses_.size()) return;
  // It may have been written since.
  const std::string record = store_->Read(name_).value_or("");
  ByteWriter out;
  std::set<Digest> written;
  const auto write = [&](const Digest& key, std::string_view bytes) {
    if (!written.insert(key).second) return;
    PutDigest(key, &out);
    out.PutText(bytes);
  };
  for (const Use& use : uses_) write(use.key, use.recalled ? use.known : use.fresh);
  for (const Entry& entry : Entries(record)) {
    if (written.size() < kMostVersions * uses_.size()) write(entry.key, entry.bytes);
  }
  store_->Write(name_, out.bytes());
}

std::uint64_t KnownRun::recalled() const {
  return static_cast<std::uint64_t>(
      std::count_if(uses_.begin(), uses_.end(), [](const Use& use) { return use.recalled; }));
}

}  // namespace ncsim::collision
