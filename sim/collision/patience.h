// SPDX-License-Identifier: BSD-3-Clause
// How long something that did not help is left alone: twice as long each time.
#pragma once

#include <algorithm>

namespace ncsim::collision {

class Patience {
 public:
  /// Is it time to try? Asked once an opportunity.
  bool Ready() { return wait_ == 0 || --wait_ == 0; }
  void Helped() { pause_ = 1; }
  void Failed() {
    wait_ = pause_;
    pause_ = std::min(2 * pause_, 64);
  }

 private:
  int wait_ = 0;
  int pause_ = 1;
};

}  // namespace ncsim::collision
