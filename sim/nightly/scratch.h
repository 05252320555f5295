// SPDX-License-Identifier: BSD-3-Clause
// Where a night works in: a folder that goes with it. One that is left by a night that was killed
// goes with the next.
#pragma once

#include <memory>
#include <string>

namespace ncsim::nightly {

class Scratch {
 public:
  /// An empty folder "ncsim-scratch-HOST-XXXXXX" in `folder`, locked (flock) until this object or
  /// its process ends. What other processes of this user and computer have left there, and no
  /// longer lock, is removed first. nullptr where it cannot be made; `reason` then says why.
  static std::unique_ptr<Scratch> Make(const std::string& folder, std::string* reason);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::string& path() const { return path_; }

 private:
  Scratch(std::string path, int lock);

  std::string path_;
  int lock_;
};

}  // namespace ncsim::nightly
