// SPDX-License-Identifier: BSD-3-Clause
#include "sim/compare/free_space.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ncsim::compare {
namespace {

/// Where |from + s way - point| <= radius.
Interval Near(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              double radius) {
  const Eigen::Vector3d way = to - from, lead = point - from;
  const double square = way.squaredNorm();
  const double nearest = square > 0.0 ? lead.dot(way) / square : 0.0;
  const double room = radius * radius - (lead - nearest * way).squaredNorm();
  if (!(room >= 0.0)) return {};
  if (!(square > 0.0)) return {0.0, 1.0};
  const double half = std::sqrt(room / square);
  return {std::max(0.0, nearest - half), std::min(1.0, nearest + half)};
}

Interval From(const Interval& free, double lower) {
  return {std::max(free.lower, lower), free.upper};
}

/// A pair of chords: what of the edges by which it is entered can be reached. Left: where b is at
/// its vertex j; bottom: where a is at its vertex i.
struct Cell {
  std::uint32_t j = 0;
  Interval left, bottom;
};

class Diagram {
 public:
  Diagram(const Run& a, const Run& b, const Radii& radii) : a_(a), b_(b), radii_(radii) {}

  Walk Follow(std::size_t most_cells) {
    Walk walk;
    if (!Fill(most_cells)) return walk;
    walk.cut = cells_.size() > most_cells;
    if (walk.cut) return walk;
    walk.complete = complete_;
    walk.steps = Back();
    return walk;
  }

 private:
  /// A place that can be reached, on an edge of a cell.
  struct Place {
    std::size_t i = 0, cell = 0;
    double s = 0.0, t = 0.0;
    double reach = -1.0;  // how far both have got
  };

  /// All cells that can be reached, row by row. False where not even the start can.
  bool Fill(std::size_t most_cells) {
    std::vector<Cell> row(1), next;
    row[0].bottom = AlongB(0, 0);
    if (row[0].bottom.empty() || row[0].bottom.lower > 0.0) return false;
    for (std::size_t i = 0; i < a_.chords() && !row.empty() && cells_.size() <= most_cells; ++i) {
      row_begin_.push_back(cells_.size());
      next.clear();
      FillRow(i, row, &next);
      row.swap(next);
    }
    row_begin_.push_back(cells_.size());
    return true;
  }

  void FillRow(std::size_t i, const std::vector<Cell>& entered, std::vector<Cell>* next) {
    Interval left;
    std::size_t k = 0, j = 0;
    while (true) {
      if (left.empty()) {
        if (k == entered.size()) return;
        j = entered[k].j;
      }
      Cell cell{static_cast<std::uint32_t>(j), left, {}};
      if (k < entered.size() && entered[k].j == j) cell.bottom = entered[k++].bottom;
      cells_.push_back(cell);
      const Interval right = AlongA(i, j + 1), top = AlongB(i + 1, j);
      const Interval to_right = cell.bottom.empty() ? From(right, left.lower) : right;
      const Interval to_top = left.empty() ? From(top, cell.bottom.lower) : top;
      Note(i, cell, to_right, to_top);
      if (!to_top.empty()) next->push_back({cell.j, {}, to_top});
      left = ++j < b_.chords() ? to_right : Interval();
    }
  }

  /// Keeps the place at which both have got furthest.
  void Note(std::size_t i, const Cell& cell, const Interval& right, const Interval& top) {
    const bool last = i + 1 == a_.chords() && cell.j + 1 == b_.chords();
    if (last && ((!right.empty() && right.upper == 1.0) || (!top.empty() && top.upper == 1.0))) {
      complete_ = true;
    }
    if (!cell.left.empty()) Offer(i, cell.left.upper, 0.0, cell.j);
    if (!cell.bottom.empty()) Offer(i, 0.0, cell.bottom.upper, cell.j);
    if (!right.empty()) Offer(i, right.upper, 1.0, cell.j);
    if (!top.empty()) Offer(i, 1.0, top.upper, cell.j);
  }

  void Offer(std::size_t i, double s, double t, std::size_t j) {
    const double reach = static_cast<double>(i + j) + s + t;
    if (reach > furthest_.reach) furthest_ = {i, cells_.size() - 1, s, t, reach};
  }

  /// One way back from the furthest place: of each cell's entries the nearest pair of poses.
  std::vector<Step> Back() const {
    std::vector<Step> steps;
    Place at = furthest_;
    while (true) {
      const Cell& cell = cells_[at.cell];
      steps.push_back({static_cast<double>(at.i) + at.s, cell.j + at.t});
      const Place left = ByLeft(at, cell), bottom = ByBottom(at, cell);
      const bool by_left = bottom.reach < 0.0 || (left.reach >= 0.0 && left.reach <= bottom.reach);
      const Place entry = by_left ? left : bottom;
      if (entry.reach < 0.0) break;
      if (!by_left && at.i == 0) {
        steps.push_back({0.0, cell.j + entry.t});
        break;
      }
      at = by_left ? Place{at.i, at.cell - 1, entry.s, 1.0, 0.0}
                   : Place{at.i - 1, Find(at.i - 1, cell.j), 1.0, entry.t, 0.0};
    }
    steps.push_back({});
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  /// The entry by an edge, its reach the ratio of the distances to the radii; < 0: none.
  Place ByLeft(const Place& at, const Cell& cell) const {
    const double upper = std::min(cell.left.upper, at.s);
    if (cell.left.empty() || cell.left.lower > upper) return {};
    const Pose& v = b_.vertices[cell.j];
    const double s =
        std::clamp(Nearest(v, a_.vertices[at.i], a_.vertices[at.i + 1]), cell.left.lower, upper);
    const Pose pose = Lerp(a_.vertices[at.i], a_.vertices[at.i + 1], s);
    return {at.i, at.cell, s, 0.0, Ratio(Between(pose, v), radii_)};
  }

  Place ByBottom(const Place& at, const Cell& cell) const {
    const double upper = std::min(cell.bottom.upper, at.t);
    if (cell.bottom.empty() || cell.bottom.lower > upper) return {};
    const Pose& v = a_.vertices[at.i];
    const double t = std::clamp(Nearest(v, b_.vertices[cell.j], b_.vertices[cell.j + 1]),
                                cell.bottom.lower, upper);
    const Pose pose = Lerp(b_.vertices[cell.j], b_.vertices[cell.j + 1], t);
    return {at.i, at.cell, 0.0, t, Ratio(Between(pose, v), radii_)};
  }

  /// Where the chord is nearest to `v`, the radii being the units.
  double Nearest(const Pose& v, const Pose& from, const Pose& to) const {
    const double p = 1.0 / (radii_.position * radii_.position),
                 u = 1.0 / (radii_.axis * radii_.axis);
    const Eigen::Vector3d dp = to.p - from.p, du = to.u - from.u;
    const double square = p * dp.squaredNorm() + u * du.squaredNorm();
    if (!(square > 0.0)) return 0.0;
    return (p * dp.dot(v.p - from.p) + u * du.dot(v.u - from.u)) / square;
  }

  std::size_t Find(std::size_t i, std::uint32_t j) const {
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(row_begin_[i]);
    const auto end = cells_.begin() + static_cast<std::ptrdiff_t>(row_begin_[i + 1]);
    const auto found =
        std::lower_bound(begin, end, j, [](const Cell& c, std::uint32_t key) { return c.j < key; });
    return static_cast<std::size_t>(found - cells_.begin());
  }

  Interval AlongA(std::size_t i, std::size_t j) const {
    return compare::Near(b_.vertices[j], a_.vertices[i], a_.vertices[i + 1], radii_);
  }
  Interval AlongB(std::size_t i, std::size_t j) const {
    return compare::Near(a_.vertices[i], b_.vertices[j], b_.vertices[j + 1], radii_);
  }

  const Run& a_;
  const Run& b_;
  const Radii radii_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> row_begin_;
  Place furthest_;
  bool complete_ = false;
};

}  // namespace

Interval Near(const Pose& pose, const Pose& from, const Pose& to, const Radii& radii) {
  const Interval p = Near(pose.p, from.p, to.p, radii.position);
  if (p.empty()) return p;
  const Interval u = Near(pose.u, from.u, to.u, radii.axis);
  return {std::max(p.lower, u.lower), std::min(p.upper, u.upper)};
}

Walk WalkTogether(const Run& a, const Run& b, const Radii& radii, std::size_t most_cells) {
  return Diagram(a, b, radii).Follow(most_cells);
}

}  // namespace ncsim::compare
