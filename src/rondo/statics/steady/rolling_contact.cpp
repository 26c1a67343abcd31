// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_contact.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "rondo/contact/residual.hpp"
#include "rondo/statics/lemke.hpp"
#include "rondo/statics/steady/rolling_system.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;
using Findings = std::vector<RollingStatus>;

constexpr double bound = 1e-9;  // of the relative residual of a solution
constexpr int most_newton_steps = 60, most_rounds = 60;

Eigen::VectorXd gaps_and_ways(const RollingWindow& w, const RollingPoint& p) {
  Eigen::VectorXd all = w.base() + w.matrix() * p.force;
  const Index m = all.size() / 2;
  all(Eigen::seqN(0, m, 2)).array() += p.height;
  all(Eigen::seqN(1, m, 2)).array() += p.speed * w.time();
  return all;
}

/// Largest law residual over the largest force (6.4d).
double residual_of(const RollingWindow& w, const RollingPoint& p, double friction) {
  const Eigen::VectorXd moved = gaps_and_ways(w, p);
  double largest = 0.0, force = 0.0;
  for (Index j = 0; j < p.force.size() / 2; ++j) {
    const double stiffness = 1.0 / std::abs(w.matrix()(2 * j, 2 * j));
    const Vec2 r{p.force[2 * j], p.force[2 * j + 1]}, v{moved[2 * j], moved[2 * j + 1]};
    const double residual = contact::law_residual(r, v, 0.0, friction, stiffness);
    if (!std::isfinite(residual)) return residual;
    largest = std::max(largest, residual);
    force = std::max(force, norm(r));
  }
  return largest == 0.0 ? 0.0 : largest / force;
}

/// The active set that the law says of these forces: of r - w/compliance, which lies in the cone
/// where a pair sticks, beyond its side where it slips, and opposite where it is open.
Findings next_findings(const RollingWindow& w, const RollingPoint& p, double friction) {
  const Eigen::VectorXd moved = gaps_and_ways(w, p);
  const double stiffness = 1.0 / w.matrix().diagonal().cwiseAbs().mean();
  Findings next(static_cast<std::size_t>(p.force.size() / 2));
  for (std::size_t j = 0; j < next.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    const double normal = p.force[row] - stiffness * moved[row];
    const double shear = p.force[row + 1] - stiffness * moved[row + 1];
    if (!(normal > 0.0)) continue;
    const bool sticks = friction > 0.0 && std::abs(shear) <= friction * normal;
    next[j] = sticks ? RollingStatus{Status::stick, 0}
                     : RollingStatus{Status::slip, shear > 0.0 || friction == 0.0 ? 1 : -1};
  }
  return next;
}

/// As make_complementary (condensed_contact.hpp), of a compliance that is not symmetric.
Lcp complementary(const RollingWindow& w, const RollingDrive& d) {
  const Index m = w.base().size() / 2;
  const auto normal = Eigen::seqN(0, m, 2), shear = Eigen::seqN(1, m, 2);
  Eigen::VectorXd free = w.base();
  free(normal).array() += d.height;
  free(shear).array() += d.speed * w.time();
  const double compliance = w.matrix().diagonal().cwiseAbs().mean();
  const Eigen::MatrixXd g = w.matrix() / compliance;
  Lcp lcp;
  lcp.matrix = Eigen::MatrixXd::Zero(3 * m, 3 * m);
  lcp.matrix.topLeftCorner(m, m) = g(normal, normal) - d.friction * g(normal, shear);
  lcp.matrix.block(0, m, m, m) = g(normal, shear);
  lcp.matrix.block(m, 0, m, m) = g(shear, normal) - d.friction * g(shear, shear);
  lcp.matrix.block(m, m, m, m) = g(shear, shear);
  lcp.matrix.block(m, 2 * m, m, m).setIdentity();
  lcp.matrix.bottomLeftCorner(m, m).diagonal().setConstant(2.0 * d.friction);
  lcp.matrix.block(2 * m, m, m, m).diagonal().setConstant(-1.0);
  const double length = free.cwiseAbs().maxCoeff();
  lcp.q = Eigen::VectorXd::Zero(3 * m);
  lcp.q.head(m) = free(normal) / length;
  lcp.q.segment(m, m) = free(shear) / length;
  lcp.cover = Eigen::VectorXd::Ones(3 * m);
  lcp.cover.segment(m, m).setConstant(1.0 / std::max(1.0, d.friction));
  return lcp;
}

Findings findings_of(const LcpSolution& lcp, double friction) {
  const std::size_t m = lcp.basic.size() / 3;
  Findings found(m);
  for (std::size_t j = 0; j < m; ++j) {
    const bool off_lower = lcp.basic[m + j] != 0, off_upper = lcp.basic[2 * m + j] == 0;
    if (lcp.basic[j] == 0 || (!off_lower && !off_upper)) continue;
    const bool sticks = off_lower && off_upper && friction > 0.0;
    found[j] = {sticks ? Status::stick : Status::slip, sticks ? 0 : off_lower ? 1 : -1};
  }
  return found;
}

/// Forces on a window that does not grow.
class Set {
 public:
  Set(const RollingWindow& window, const RollingDrive& drive, RollingSolution& s)
      : window_(window), drive_(drive), s_(s) {}

  Findings found;
  RollingPoint point;

  /// @return false: the set that is left touches nothing
  bool solve() {
    std::set<std::vector<int>> seen;
    for (int n = 0; n < most_newton_steps; ++n) {
      ++s_.newton_steps;
      if (std::ranges::all_of(found, [](const auto& f) { return f.status == Status::open; }))
        return false;
      const RollingPoint before = point;
      point = RollingSystem(window_, drive_, found, before).solve();
      if (!point.force.allFinite()) break;
      Findings next = next_findings(window_, point, drive_.friction);
      const bool settled = next == found;
      if (settled && (!drive_.torque || is_near(before))) break;
      if (!settled && !seen.insert(key_of(next)).second) break;
      found = std::move(next);
    }
    s_.residual = residual_of(window_, point, drive_.friction);
    if (!(s_.residual <= bound) && !drive_.load && !drive_.traction && !drive_.torque) pivot();
    return true;
  }

 private:
  /// The torque, which is not linear, is as asked for.
  [[nodiscard]] bool is_near(const RollingPoint& before) const {
    const double change = (point.force - before.force).cwiseAbs().maxCoeff();
    return change <= 1e-11 * point.force.cwiseAbs().maxCoeff();
  }
  static std::vector<int> key_of(const Findings& found) {
    std::vector<int> key;
    for (const RollingStatus& f : found) key.push_back(3 * static_cast<int>(f.status) + f.side);
    return key;
  }
  void pivot() {
    const Index m = window_.base().size() / 2;
    LcpSolution z;
    const LemkeReport end =
        solve_lemke(complementary(window_, drive_), static_cast<int>(30 * m + 100), z);
    s_.pivots += end.pivots;
    if (end.end != LemkeEnd::solved) return;
    const Findings pivoted = findings_of(z, drive_.friction);
    RollingPoint other = RollingSystem(window_, drive_, pivoted, point).solve();
    const double residual = residual_of(window_, other, drive_.friction);
    if (!(residual < s_.residual) && std::isfinite(s_.residual)) return;
    point = std::move(other);
    found = pivoted;
    s_.residual = residual;
  }

  const RollingWindow& window_;
  const RollingDrive& drive_;
  RollingSolution& s_;
};

double lowest(const RollingWindow& w) {
  const RollingHarmonics& h = w.harmonics();
  double least = 0.0;
  for (std::size_t a = 0; a < h.n_candidates(); ++a) least = std::max(least, norm(h.place(a, 0)));
  return least;
}

/// The speed is asked for, and nothing that sticks tells it.
bool slides(const RollingDrive& drive, const Findings& found) {
  const bool sticks =
      std::ranges::any_of(found, [](const auto& f) { return f.status == Status::stick; });
  return (drive.traction || drive.torque) && !sticks;
}

void fill(const RollingWindow& w, const RollingDrive& drive, Set& set, RollingSolution& s) {
  const RollingPoint& p = set.point;
  s.height = p.height;
  s.speed = p.speed;
  s.force = p.force;
  s.status = set.found;
  s.gap_and_slip = gaps_and_ways(w, p);
  const Index m = p.force.size() / 2;
  s.gap_and_slip(Eigen::seqN(1, m, 2)) /= w.time();
  const double pass = w.harmonics().body().samples;
  const Eigen::VectorXd normal = p.force(Eigen::seqN(0, m, 2)),
                        x = w.base_x() + w.matrix_x() * p.force;
  s.forces.y = normal.sum() / pass;
  s.forces.x = p.force(Eigen::seqN(1, m, 2)).sum() / pass;
  s.forces.torque = x.dot(normal) / pass + p.height * s.forces.x;
  RollingSystem(w, drive, set.found, p).add_slopes(s);
}

}  // namespace

RollingSolution solve_rolling(RollingWindow& window, const RollingDrive& drive,
                              const std::vector<RollingStatus>& from) {
  RollingSolution s;
  Set set(window, drive, s);
  const double radius = lowest(window);
  set.point.height = drive.load ? radius * (1.0 - 1e-3) : drive.height;
  set.point.speed = drive.speed;
  window.include_below(set.point.height);
  set.found = from;
  for (int round = 0; round < most_rounds; ++round) {
    const auto pairs = window.pairs().size();
    s.end = pairs == 0 ? RollingEnd::no_contact : RollingEnd::not_solved;
    if (pairs == 0) break;
    const bool fresh = set.found.empty();
    set.found.resize(pairs);
    set.point.force.conservativeResizeLike(Eigen::VectorXd::Zero(static_cast<Index>(2 * pairs)));
    if (fresh) set.found = next_findings(window, set.point, drive.friction);
    if (!set.solve()) {
      s.end = RollingEnd::no_contact;
      if (!drive.load) break;
      // Nothing is left that touches: from further down.
      set.point.height = radius * (1.0 - 2e-3 * (round + 1));
      window.include_below(set.point.height);
      set.found.clear();
      continue;
    }
    if (window.include_touching(set.point.height, set.point.force)) continue;
    fill(window, drive, set, s);
    if (s.residual <= bound)
      s.end = RollingEnd::solved;
    else if (slides(drive, set.found))
      s.end = RollingEnd::sliding;
    return s;
  }
  s.height = set.point.height;
  s.speed = set.point.speed;
  s.force = Eigen::VectorXd::Zero(window.base().size());
  s.gap_and_slip = s.force;
  s.status.assign(window.pairs().size(), {});
  return s;
}

double rolling_residual(const RollingWindow& window, const RollingSolution& s, double friction) {
  return residual_of(window, {s.force, s.height, s.speed}, friction);
}

}  // namespace rondo::statics
