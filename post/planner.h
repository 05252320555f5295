// SPDX-License-Identifier: BSD-3-Clause
// From what a cutter-location file does to what a machine does: which mode an operation runs in,
// which rotary positions it takes, where the machine must retract and turn, and what a control that
// interpolates its axes needs in between. Knows no text.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "post/part_geometry.h"
#include "post/plan.h"
#include "sim/base/diagnostics.h"
#include "sim/base/finding.h"

namespace ncsim::post {

/// What a mode of the post can do.
struct PlanAbilities {
  std::array<bool, 3> arcs{true, true, true};  ///< By PlanPlane.
  bool helices = true;                         ///< Arcs that leave their plane.
  bool holes = true;                           ///< Cycles.
  bool great_circle = false;  ///< The control leads the tool axis on one, told by its vector,
  double pole_limit = 0.0;    ///< but nearer to the pole by its rotary axes in proportion; rad.
  bool compensation = true;   ///< Cutter compensation.
  bool rate_alarm = false;    ///< A feed that needs more than an axis's rate is an error.
};

struct PlanOptions {
  /// None: an operation whose feeds keep the tool axis is kIndexed, another kTcp.
  std::optional<PlanMode> mode;
  bool turned_planes = false;              ///< kIndexed in the plane's own directions (CYCLE800).
  std::array<PlanAbilities, 3> abilities;  ///< By PlanMode.
  bool separate = false;                   ///< An operation never goes on where the last one ends.
  double tolerance = 0.004;                ///< mm: chords, and tips that bow.
  double angle_tolerance = 0.005 * 0.01745329;  ///< rad: tool axes that leave their great circle.
  double turn_rate = 0.35;                      ///< rad/s: turns with the tool in the part.
  double rewind_retract = 50.0;                 ///< mm along the tool axis.
  /// By ClOperation::index: which of the ranked ways to follow its axes (0: the best). Beyond the
  /// last: the last.
  std::map<int, std::size_t> choice;
};

/// An operation's ways: how many there are, and which was taken.
struct PlanChoice {
  int operation = 0;
  std::size_t ways = 1;
  std::size_t taken = 0;
};

class Planner {
 public:
  /// All must outlive this. The diagnostics' file is `name`.
  Planner(const PartGeometry& geometry, const PlanOptions& options, std::string name,
          Diagnostics* diagnostics, PlanSink* sink);
  ~Planner();

  /// In order, ClEnd last. An operation is planned as a whole, when the next one begins.
  void Take(const ClEvent& event);

  const std::vector<PlanChoice>& choices() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace ncsim::post
