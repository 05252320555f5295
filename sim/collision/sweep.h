// SPDX-License-Identifier: BSD-3-Clause
// The certificate: one pair over whole motions. See docs/collision.md for the proof.
#pragma once

#include <limits>
#include <map>
#include <vector>

#include "sim/collision/engine.h"
#include "sim/collision/patience.h"
#include "sim/motion/motion.h"
#include "sim/motion/translation.h"
#include "sim/motion/travel.h"

namespace ncsim::collision {

/// A clearance that is below this above the contact level, and that no further splitting can tell
/// from contact, counts as contact; mm. False alarms need a true clearance below about twice this.
inline constexpr double kContactResolution = 0.004;

/// What the sweep of one motion must establish.
struct Watch {
  double contact =
      0.0;  ///< At or below this clearance is contact (-tolerance for flutes); -inf: never.
  /// Every pose must be told to be at least this clear, or one that is not be found; 0: not wanted.
  double clearance = 0.0;
  double rounding = 0.0;  ///< As `clearance`, for what the control's smoothing may do.
  /// The least clearance of the near-miss run that is open, to be followed on; +inf for none.
  double run_least = std::numeric_limits<double>::infinity();
  bool track = false;  ///< Keep the pair's least clearance (see PairSweep::least).
  double track_below =
      0.0;  ///< From here down within track_within, above within a quarter of what is seen.
  double track_within = 0.02;  ///< mm
  /// A least clearance above this is of no interest (0 for cuts: only depths count).
  double track_ceiling = std::numeric_limits<double>::infinity();
  /// Gives up (uncertified) after this many poses; for attempts that need not succeed.
  int max_poses = std::numeric_limits<int>::max();
  bool find_first = true;  ///< On contact, find where it begins; else any pose in contact will do.
};

/// Equal joint positions, to rounding (1e-9).
bool SamePose(const motion::JointVector& a, const motion::JointVector& b);

struct PathPoint {
  double s = 0.0;
  double lag = 0.0;
};

struct SweepResult {
  bool contact = false;
  bool uncertified = false;  ///< The engine failed, or the bound did not close.
  PathPoint first;  ///< First contact, within 1e-3 of the motion. lag > 0: none without lag.
  /// No pose of the motion is below least.lower, and one (least_at) has least.upper (+inf when none
  /// was looked at). Without meaning after contact.
  Interval least;
  PathPoint least_at;
};

/// Motion `at` of a run that has totals; null where there are none.
struct TravelPlace {
  const motion::PairTravel* travel = nullptr;
  std::size_t at = 0;
};

class PairSweep {
 public:
  /// Both outlive this.
  PairSweep(const motion::PairPath& path, PairEngine* engine);

  /// A clearance that was seen elsewhere: no less need be told of what is above it.
  void Seed(double seen) { least_.upper = seen; }

  /// The motions from `begin` on that are all clear by more than `watch` needs, found so without a
  /// look at each: the first clearance covers what lies behind its pose, the next one what lies
  /// before it.
  struct Crossing {
    std::size_t end = 0;  ///< The first motion that is not known to be clear.
    double least = std::numeric_limits<double>::infinity();  ///< No pose is below it.
  };
  Crossing Cross(const motion::Travel& travel, const motion::PairTravel& bound, std::size_t begin,
                 const Watch& watch);

  /// Motions in order; one that does not start where the last one ended is a jump, after which
  /// nothing is known. `place`: the same motion.
  SweepResult Check(const motion::Motion& motion, const Watch& watch,
                    const TravelPlace& place = {});

  /// Is the pair known to be, or found to be, out of contact where the motion starts?
  bool StartsClear(const motion::Motion& motion);

  /// As Check, but leaves the pair where it was before the motion.
  SweepResult Probe(const motion::Motion& motion, const Watch& watch);

  /// Where the contact at `first` begins, to 1e-6 of the motion, if that is within 1e-3 before it.
  PathPoint Onset(const motion::Motion& motion, const PathPoint& first, double contact);

  /// Clearance (negative) at the deepest pose of a motion that is known to be in `contact`, to 0.01
  /// mm: at lag 0, or with all lags. `known` is the depth that is not worth looking for. `budget`
  /// counts down poses; without one left, only the middle and the end are looked at. `upper` is
  /// what was found, +inf for nothing deeper than `known`; no pose of the motion is below `lower`.
  Interval Deepest(const motion::Motion& motion, const PathPoint& contact, bool with_lag,
                   double known, int* budget, PathPoint* at);

  /// Clearance of the solids at a pose of the motion, not told apart above `enough`.
  std::optional<Interval> At(const motion::Motion& motion, const PathPoint& point, double enough,
                             double gap = 0.0);

  Eigen::Isometry3d Pose(const motion::Motion& motion, const PathPoint& point) const;
  /// Takes over a proof from elsewhere: the motion is clear, at its end by `clearance` or more.
  void Accept(const motion::Motion& motion, double clearance);
  /// What Check would have to prove for the whole motion, as far as is known before it.
  double Need(const Watch& watch) const;
  /// Certified clearance at the end of the last motion.
  double known_clearance() const { return known_.clearance; }
  /// Forgets what is known about the present pose (another tool, a new body).
  void Forget();

  /// Least clearance over all motions checked with Watch::track.
  const Interval& least() const { return least_; }
  bool has_least() const { return least_.upper < std::numeric_limits<double>::infinity(); }
  /// Where its `upper` was seen; null where nowhere.
  const motion::Motion* least_motion() const { return least_motion_; }
  /// Puts a depth that was found otherwise into least().
  void Include(const Interval& clearance, const motion::Motion& motion);

  const motion::PairPath& path() const { return *path_; }
  std::uint64_t queries() const { return queries_; }

 private:
  struct Known {
    double clearance = -std::numeric_limits<double>::infinity();  // certified at the last end
    bool outside = false;  // neither body is inside the other
    motion::JointVector q;
  };
  struct Sweep {
    const motion::Motion* motion = nullptr;
    TravelPlace place;
    Watch watch;
    SweepResult result;
    double end = std::numeric_limits<double>::infinity();  // certified at the motion's end
    int refinements = 0;
    int poses = 0;
  };
  struct Deepening {
    double limit = 0.0;  // nothing above this is of interest
    Interval best;
    PathPoint* at = nullptr;
    int queries = 0;
  };
  void Deepen(const motion::Motion& motion, const motion::Span& whole, int queries,
              Deepening* search);
  double Need(const Sweep& sweep) const;
  double Need(const Watch& watch, double found, bool tired) const;
  double Gap() const;
  std::optional<Interval> Look(const motion::Motion& motion, const Eigen::Isometry3d& X_BA,
                               const Watch& watch, double enough);
  std::optional<double> PassAtOnce(Sweep* sweep);
  std::optional<double> PassInBox(const Sweep& sweep, double need);
  /// A step of a Crossing: to `end`, clear by `least` all the way and by `clearance` there.
  struct Step {
    std::size_t end = 0;
    double least = 0.0;
    double clearance = 0.0;
  };
  void Expect(double spare);
  double Spared(const Watch& watch) const;
  bool Stand(const motion::Motion& motion, const Watch& watch, double enough);

  std::optional<Step> Settle(const motion::PairTravel& bound, const motion::Motion& motion,
                             std::size_t at, const Watch& watch);
  Step Onward(const motion::Travel& travel, const motion::PairTravel& bound, std::size_t at,
              const Watch& watch);
  std::optional<double> Recall(const motion::PairTravel::Neighbourhood& around) const;
  std::optional<double> Explore(const motion::PairTravel& bound,
                                const motion::PairTravel::Neighbourhood& around, double enough,
                                double beyond);
  const motion::PairTravel::Neighbourhood& Stretch(const motion::PairTravel& bound, std::size_t at,
                                                   std::size_t level, int grid);
  Step Around(const motion::PairTravel& bound, std::size_t at, std::size_t path_end,
              const Watch& watch);
  Step Backward(const motion::PairTravel& bound, std::size_t at, Step seen, bool even) const;
  Step Ahead(const motion::Travel& travel, const motion::PairTravel& bound, std::size_t at,
             const Watch& watch);
  bool Start(Sweep* sweep);
  void Observe(const Interval& clearance, const PathPoint& at, Sweep* sweep);
  void See(double clearance, const motion::Motion& motion, bool track);
  std::optional<double> ClearAllTheWay(const motion::Translation& translation, double need);
  SweepResult Pass(double clearance, Sweep* sweep);
  void Arrive(double clearance, const Sweep& sweep);
  void Cover(const motion::Span& whole, Sweep* sweep);
  std::optional<Interval> Query(const motion::Span& span, double bound, Sweep* sweep);
  bool Accept(const motion::Span& span, const motion::Span& whole, const Interval& clearance,
              double bound, Sweep* sweep);
  void Split(const motion::Span& span, double clearance, double bound, Sweep* sweep);
  SweepResult FirstWithoutLag(const SweepResult& with_lag, const motion::Motion& motion,
                              const Watch& watch);

  const motion::PairPath* path_;
  PairEngine* engine_;
  Known known_;
  Interval least_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const motion::Motion* least_motion_ = nullptr;
  std::vector<motion::Span> stack_;
  /// What a look ahead showed: the clearance behind the motions before `end`.
  struct Seen {
    std::size_t end;
    double clearance;
  };
  const motion::PairTravel* crossed_ = nullptr;  // whose motions these number
  std::vector<Seen> ahead_seen_;                 // the nearest last
  struct Stretched {
    std::size_t end = 0;
    int grid = 0;
    motion::PairTravel::Neighbourhood around;
  };
  std::vector<Stretched> stretches_;  // the last one of each level
  Patience around_;
  std::size_t level_ = 0;  // of the last stretch that was settled around a pose
  std::map<motion::PairTravel::GridKey, double> memory_;  // never more than the clearance
  double ahead_ = 0.0;  // mm beyond what is needed that the next look ahead hopes for
  std::uint64_t queries_ = 0;
};

}  // namespace ncsim::collision
