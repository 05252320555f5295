// SPDX-License-Identifier: BSD-3-Clause
// A job: what stands on the machine and in the control's registers before the program starts.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/machine/machine.h"
#include "sim/machine/tool.h"

namespace ncsim::machine {

/// A pose as the job states it: on a link, on another fixture, or on a work offset ("G54": machine
/// directions at the offset's B, C, riding on the table).
struct Placement {
  std::string on;
  Eigen::Isometry3d X_OG = Eigen::Isometry3d::Identity();  ///< mm.
  int line = 0, column = 0;
};

/// A work offset: either machine axis values as entered at the control (mm, rad; what is not named
/// is 0), or a frame on a link from which those values are worked out.
struct WorkOffset {
  std::string name;  ///< "G54", "G154 P1" ...
  std::map<char, double> values;
  std::optional<Placement> placement;
};

enum class BodyKind { kMachine, kFixture, kPart, kStock, kFlutes, kShank, kHolder };

/// A fixture, part or blank. A primitive has been made a mesh (cylinders circumscribed, sagitta
/// under 0.005 mm).
struct PlacedBody {
  std::string name;
  BodyKind kind = BodyKind::kFixture;
  Placement at;
  TriangleMesh mesh;
  std::string defect;  ///< As LinkBody::defect.
};

enum class GougeMode { kError, kWarning, kOff };

/// A clearance of one pair of bodies, or of a few pairs of a kind: see margins.h.
struct PairMargin {
  struct Body {
    std::string name;
    int line = 0, column = 0;
  };
  std::array<Body, 2> bodies;
  double clearance = 0.0;  ///< mm.
};

struct CheckSettings {
  double clearance = 0.0;  ///< mm; below it, near-miss. 0: no near misses.
  std::vector<PairMargin> margins;
  double part_tolerance = 0.1;
  double gouge_tolerance = 0.25;
  GougeMode gouge = GougeMode::kError;
  /// Not a key of the job: least clearances below this (mm) are told to 0.02 mm in any case.
  double exact_below = 0.0;
};

struct Job {
  std::string path;              ///< "" for no job file.
  std::string model;             ///< As written; "" if not stated.
  std::map<char, double> start;  ///< Axis letter -> machine value (mm, rad).
  int start_tool = 0;            ///< T number in the spindle at the start; 0 = none.
  std::map<std::string, WorkOffset> offsets;
  std::vector<Tool> tools;
  bool has_tools = false;  ///< The job states tools: one that it does not list is `tool-missing`.
  std::vector<PlacedBody> bodies;  ///< Fixtures, part, stock, in the order of the file.
  CheckSettings check;
  /// "setting 9" -> "inch"; names and values as settings.h spells them (lengths as mm, angles as
  /// degrees).
  std::map<std::string, std::string> control;
  std::vector<std::string> subprogram_folders;  ///< As paths from the current folder.
  /// NC code that sets tool and work offsets ($TC_DP, $P_UIFR), to be run before the program; paths
  /// as above.
  std::vector<std::string> data_files;
  std::vector<int> m_codes_without_motion;

  /// The work offset of this name, under either of its names (G110 is G154 P1); nullptr if the job
  /// has none.
  const WorkOffset* FindOffset(std::string_view name) const;
};

}  // namespace ncsim::machine
