// SPDX-License-Identifier: BSD-3-Clause
#include "sim/nightly/scratch.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/base/file.h"

namespace ncsim::nightly {
namespace {

constexpr std::string_view kRandom = "XXXXXX";
constexpr int kAttempts = 10;

/// With the computer's name: others may see the folder and not the locks (NFS). Nights of versions
/// that did not lock had another name.
std::string NamePrefix() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return std::string("ncsim-scratch-") + host.data() + "-";
}

/// -1 where it is no folder that this user's mkdtemp made, or another process has it.
int LockFolder(const std::string& path) {
  const int lock = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat status {};
  if (lock >= 0 && fstat(lock, &status) == 0 && status.st_uid == geteuid() &&
      (status.st_mode & 0777U) == 0700U && flock(lock, LOCK_EX | LOCK_NB) == 0) {
    return lock;
  }
  if (lock >= 0) close(lock);
  return -1;
}

/// The lock ends last: who gets it then finds that the folder is no more.
void RemoveLocked(const std::string& path, int lock) {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
  close(lock);
}

void RemoveAbandoned(const std::string& folder, const std::string& prefix) {
  for (const std::string& name : NamesIn(folder)) {
    if (name.size() != prefix.size() + kRandom.size() || name.rfind(prefix, 0) != 0) continue;
    const std::string path = folder + "/" + name;
    if (const int lock = LockFolder(path); lock >= 0) RemoveLocked(path, lock);
  }
}

}  // namespace

std::unique_ptr<Scratch> Scratch::Make(const std::string& folder, std::string* reason) {
  const std::string prefix = NamePrefix();
  RemoveAbandoned(folder, prefix);
  for (int i = 0; i < kAttempts; ++i) {
    std::string path = folder + "/" + prefix + std::string(kRandom);
    if (mkdtemp(path.data()) == nullptr) {
      *reason = std::generic_category().message(errno);
      return nullptr;
    }
    // A night that begins in this instant may take it for abandoned: then again.
    const int lock = LockFolder(path);
    if (lock >= 0 && IsFolder(path)) return std::unique_ptr<Scratch>(new Scratch(path, lock));
    if (lock >= 0) close(lock);
    rmdir(path.c_str());
  }
  *reason = "folders cannot be locked there";
  return nullptr;
}

Scratch::Scratch(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}

Scratch::~Scratch() { RemoveLocked(path_, lock_); }

}  // namespace ncsim::nightly
