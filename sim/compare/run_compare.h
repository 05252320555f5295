// SPDX-License-Identifier: BSD-3-Clause
// Two runs of feeds held together: where they go the same way, how near; where not, which stretch
// of the one stands against which of the other.
#pragma once

#include <functional>
#include <vector>

#include "sim/compare/fault_log.h"
#include "sim/compare/free_space.h"

namespace ncsim::compare {

/// The greatest distance of the tips (mm) and of the tool axes (of unit vectors), and the blocks.
struct Largest {
  double value = 0.0;
  SourcePosition tested, reference;
};

/// What a program adds, not an error.
struct Added {
  SourcePosition where;
  std::string text;
};

struct RunCompareParts {
  const std::vector<Piece>* reference = nullptr;
  const std::vector<Piece>* tested = nullptr;
  Radii radii;  ///< Of chords: the tolerances less what chords deviate from the motions.
  FaultLog* log = nullptr;
  std::vector<Added>* added = nullptr;
  Largest* position = nullptr;
  Largest* axis = nullptr;
};

/// Where the very start of a run differs: the blocks that lead there. Line 0: none.
struct Blame {
  SourcePosition tested, reference;
};

class RunCompare {
 public:
  explicit RunCompare(const RunCompareParts& parts) : parts_(parts) {}

  void Compare(Run reference, Run tested, const Blame& blame);

 private:
  struct Region {
    Run reference, tested;
    /// The same from a little before, where both are at one place.
    Run whole_reference, whole_tested;
    bool at_start = false;
    Blame blame;
  };

  void Measure(const Run& reference, const Run& tested, const std::vector<Step>& steps);
  Step LastMeeting(const Run& reference, const Run& tested, const std::vector<Step>& steps) const;
  void Report(const Region& region);
  void ReportRapid(const Piece& reference, const Piece& tested);
  bool IsDetour(const Run& tested) const;
  bool Touches(const Run& run, const Pose& pose) const;
  bool Rests(const Run& run) const;
  const SourcePosition& WhereReference(const Run& run) const;
  std::string Hint(const Region& region) const;

  const RunCompareParts parts_;
};

/// Where both are again at one pose behind `from`, and go on alike.
std::vector<Step> FindNext(const Run& reference, const Run& tested, const Step& from,
                           const Radii& radii);

}  // namespace ncsim::compare
