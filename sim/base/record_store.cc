// SPDX-License-Identifier: BSD-3-Clause
#include "sim/base/record_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/base/bytes.h"
#include "sim/base/file.h"

namespace ncsim {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "NCSIMREC";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kDigestBytes = sizeof(Digest);
constexpr std::string_view kSuffix = ".ncsim";
constexpr std::string_view kTemporary = ".ncsim-new";
constexpr std::chrono::hours kAbandoned{1};  // a file that nobody writes any more

void Put(const Digest& digest, ByteWriter* out) {
  for (const std::uint64_t word : digest.words) out->Put(word);
}

/// Magic, version, key, the record with its length; then the digest of all that.
std::string Packed(const Digest& key, std::string_view record) {
  ByteWriter out;
  out.PutRaw(kMagic);
  out.Put(kVersion);
  Put(key, &out);
  out.PutText(record);
  Put(DigestOf(out.bytes()), &out);
  return out.bytes();
}

std::optional<std::string> Unpacked(const Digest& key, const std::string& file) {
  if (file.size() < kDigestBytes) return std::nullopt;
  const std::string_view body = std::string_view(file).substr(0, file.size() - kDigestBytes);
  ByteWriter tail;
  Put(DigestOf(body), &tail);
  if (std::string_view(file).substr(body.size()) != tail.bytes()) return std::nullopt;
  ByteReader in(body);
  ByteWriter name;
  Put(key, &name);
  const bool fits = in.GetRaw(kMagic.size()) == kMagic && in.Get<std::uint32_t>() == kVersion &&
                    in.GetRaw(kDigestBytes) == name.bytes();
  const std::string_view record = in.GetText();
  if (!fits || !in.ok() || in.left() > 0) return std::nullopt;
  return std::string(record);
}

bool WriteAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string Reason(int error) { return std::generic_category().message(error); }

}  // namespace

std::unique_ptr<RecordStore> RecordStore::Open(const std::string& folder, std::string* reason) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) {
    *reason = error.message();
    return nullptr;
  }
  return std::unique_ptr<RecordStore>(new RecordStore(folder));
}

std::string RecordStore::PathOf(const Digest& key) const {
  return (fs::path(folder_) / (ToString(key) + std::string(kSuffix))).string();
}

// Of no other thread or process, on this computer or another.
std::string RecordStore::TemporaryName() const {
  static std::atomic<std::uint64_t> count{0};
  ByteWriter name;
  name.Put(std::chrono::system_clock::now().time_since_epoch().count());
  name.Put(getpid());
  name.Put(count++);
  return (fs::path(folder_) / (std::string(kTemporary) + ToString(DigestOf(name.bytes()))))
      .string();
}

std::optional<std::string> RecordStore::Read(const Digest& key) {
  const std::string path = PathOf(key);
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  std::string reason;
  const std::optional<std::string> file = ReadFile(path, kLargest + 1024, &reason);
  std::optional<std::string> record;
  if (file.has_value()) record = Unpacked(key, *file);
  if (record.has_value()) {
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);
  } else {
    fs::remove(path, error);
  }
  return record;
}

void RecordStore::Write(const Digest& key, std::string_view record) {
  if (!writes_ || record.size() > kLargest) return;
  const std::string packed = Packed(key, record);
  const std::string temporary = TemporaryName();
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return Fail(Reason(errno));
  bool written = WriteAll(file, packed);
  int error = errno;
  if (close(file) != 0 && written) {
    written = false;
    error = errno;
  }
  if (written && std::rename(temporary.c_str(), PathOf(key).c_str()) != 0) {
    written = false;
    error = errno;
  }
  if (written) return;
  unlink(temporary.c_str());
  Fail(Reason(error));
}

void RecordStore::Fail(const std::string& what) {
  writes_ = false;
  const std::lock_guard lock(mutex_);
  if (trouble_.empty()) trouble_ = what;
}

std::string RecordStore::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void RecordStore::Trim(std::uint64_t most) {
  struct Entry {
    fs::file_time_type used;
    std::uint64_t size;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  // Others may remove files meanwhile: what is gone is passed over.
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const fs::path& path = it->path();
    const std::string name = path.filename().string();
    const bool temporary = name.starts_with(kTemporary);
    if (!temporary && !name.ends_with(kSuffix)) continue;
    const fs::file_time_type used = it->last_write_time(gone);
    const std::uint64_t size = gone ? 0 : it->file_size(gone);
    if (gone) continue;
    if (!temporary) {
      entries.push_back({used, size, path});
      total += size;
    } else if (now - used > kAbandoned) {
      fs::remove(path, gone);
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= most) return;
    std::error_code gone;
    fs::remove(entry.path, gone);
    total -= entry.size;
  }
}

}  // namespace ncsim
