// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/standing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/statics/steady/law/rolling_law.hpp"
#include "rondo/statics/steady/rolling_power.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// (n) of a field of all rows, in the axes of the wheel.
std::vector<Vec3> in_wheel_axes(const RollingHarmonics<3>& h, const MatrixXd& field) {
  const fem::SolidSector& k = h.body().stiffness;
  std::vector<Vec3> nodes(h.body().mass.size());
  for (std::size_t j = 0; j < k.turn.size(); ++j)
    for (std::size_t a = 0; a < k.n_local(); ++a)
      nodes[k.node(a, j)] =
          k.turn[j] * vec_of(NodeVector<3>(
                          field.col(static_cast<Index>(j)).segment<3>(static_cast<Index>(3 * a))));
  return nodes;
}

/// Displacement of a pair's node along n, t1 and t2.
NodeVector<3> displaced(const RollingWindow<3>& w, const RollingPair& p, const MatrixXd& u) {
  const Index row = 3 * w.harmonics().body().candidates[p.candidate];
  const auto sample = static_cast<Index>(w.harmonics().wrapped(p.sample));
  return w.to_ground(p.sample) * u.block<3, 1>(row, sample);
}

/// Height of a candidate over the center, where nothing is displaced.
double rise_of(const RollingWindow<3>& w, const RollingPair& p) {
  return w.to_ground(p.sample).row(0).dot(w.harmonics().reference(p.candidate));
}

template <class Visit>
void each_candidate(const RollingHarmonics<3>& h, Visit&& visit) {
  for (std::size_t a = 0; a < h.n_candidates(); ++a)
    for (int m = 0; m < h.turn(); ++m) visit(RollingPair{a, m});
}

/// Forces of an earlier state of the window, which has more pairs by now.
VectorXd padded(VectorXd force, Index size) {
  force.conservativeResizeLike(VectorXd::Zero(size));
  return force;
}

}  // namespace

StandingWheel::StandingWheel(const RollingHarmonics<3>& harmonics, double camber,
                             contact::Friction friction, RollingRemainder* remainder,
                             std::vector<double> extent)
    : harmonics_(harmonics),
      remainder_(remainder),
      window_(harmonics, SlipDifference::standing, camber),
      friction_(std::move(friction)),
      extent_(std::move(extent)),
      touch_height_(0.0) {
  RONDO_DEMAND(harmonics.body().samples == 1, harmonics.body().samples);
  RONDO_DEMAND(friction_.is_constant() || extent_.size() == harmonics.n_candidates(),
               extent_.size(), harmonics.n_candidates());
  each_candidate(harmonics, [&](const RollingPair& p) {
    touch_height_ = std::max(touch_height_, -rise_of(window_, p));
  });
  lift_off(state_);
}

/// The body as it is where nothing touches.
void StandingWheel::lift_off(StandingState& next) const {
  const std::size_t nodes = harmonics_.body().mass.size();
  RollingSolution& s = next.solution;
  s = {.end = RollingEnd::no_contact, .height = touch_height_ - next.depth};
  s.force = s.gap_and_slip = VectorXd::Zero(window_.problem().size());
  s.place = VectorXd::Zero(window_.problem().base_place.size());
  s.status.assign(window_.pairs().size(), {});
  next.u = MatrixXd::Zero(static_cast<Index>(3 * harmonics_.body().stiffness.n_local()),
                          harmonics_.turn());
  next.nodes.assign(nodes, {});
  next.inner.assign(nodes, {});
  next.effort = {};
  next.residual = next.equilibrium = next.penetration = 0.0;
}

void StandingWheel::find_inner(const MatrixXd& remainder, StandingState& next) const {
  next.nodes = in_wheel_axes(harmonics_, next.u);
  next.inner.assign(next.nodes.size(), {});
  fem::apply(harmonics_.body().stiffness, next.nodes, next.inner);
  next.works.strain = 0.0;
  for (std::size_t i = 0; i < next.nodes.size(); ++i)
    next.works.strain += 0.5 * dot(next.inner[i], next.nodes[i]);
  if (!remainder_) return;
  next.works.strain = remainder_->energy();
  const std::vector<Vec3> more = in_wheel_axes(harmonics_, remainder);
  for (std::size_t i = 0; i < more.size(); ++i) next.inner[i] += more[i];
}

void StandingWheel::take(FiniteRolling found, StandingState& next) {
  next.effort = found.effort;
  next.solution = found.solution;
  if (next.solution.end != RollingEnd::solved) return;
  next.u = found.u;
  find_inner(found.own_remainder, next);
  finite_ = std::move(found);
}

/// From the state, whose fields are made smaller where the wheel is let up: those of more depth or
/// load would draw it off the ground. Where that leads nowhere, from first touch.
FiniteRolling StandingWheel::solve_finite(const RollingDrive& drive, const StandingTarget& target) {
  if (!finite_ || state_.solution.end != RollingEnd::solved)
    return solve_finite_rolling(window_, drive, *remainder_);
  FiniteRolling near = *finite_;
  near.u *= std::min(
      1.0, target.load ? *target.load / near.solution.forces.normal : target.depth / state_.depth);
  FiniteRolling found = solve_finite_rolling(window_, drive, *remainder_, &near);
  if (found.solution.end == RollingEnd::solved) return found;
  return solve_finite_rolling(window_, drive, *remainder_);
}

double StandingWheel::friction_of_all() const {
  return friction_.is_constant() ? friction_.constant() : 1.0;
}

/// Returns the coefficient of a pair of the window, by its pressure and place in the state.
double StandingWheel::coefficient(std::size_t pair) const {
  const RollingPair& p = window_.pairs()[pair];
  const auto row = static_cast<Index>(3 * pair);
  const double normal = row < state_.solution.force.size() ? state_.solution.force[row] : 0.0;
  const double extent = extent_[p.candidate];
  const NodeVector<3> place = window_.to_ground(p.sample) * harmonics_.reference(p.candidate) +
                              displaced(window_, p, state_.u);
  return friction_.coefficient({.place = {place[1] + state_.slide, 0.0, place[2]},
                                .pressure = extent > 0.0 ? normal / extent : 0.0});
}

/// Sets the coefficients of all pairs of the window for the increment that begins.
void StandingWheel::find_friction() {
  if (friction_.is_constant()) return;
  for (std::size_t j = pairs_.size(); j < window_.pairs().size(); ++j)
    pairs_.push_back({.factor = coefficient(j)});
}

/// Pairs that the window grows by have no coefficient yet: with theirs once more.
bool StandingWheel::solve(const StandingTarget& target, StandingState& next) {
  RollingDrive drive{.height = touch_height_ - target.depth,
                     .speed = target.slide - state_.slide,
                     .friction = friction_of_all(),
                     .load = target.load};
  window_.count_from(harmonics_.on_candidates(state_.u));
  const std::optional<FiniteRolling> finite = finite_;
  pairs_.clear();
  do {
    finite_ = finite;
    find_friction();
    drive.pairs = pairs_;
    solve_contact(target, drive, next);
  } while (!friction_.is_constant() && pairs_.size() < window_.pairs().size());
  if (target.load) next.depth = touch_height_ - next.solution.height;
  return next.solution.end == RollingEnd::solved;
}

void StandingWheel::solve_contact(const StandingTarget& target, const RollingDrive& drive,
                                  StandingState& next) {
  if (remainder_) {
    take(solve_finite(drive, target), next);
  } else {
    next.solution = solve_rolling_from(window_, drive, state_.solution);
    if (next.solution.end == RollingEnd::solved) {
      next.u = harmonics_.fields(spectrum_of(window_, next.solution), 0.0, false);
      find_inner({}, next);
    }
  }
}

VectorXd StandingWheel::moved(const StandingState& next) const {
  VectorXd all(window_.problem().size());
  for (Index j = 0; j < window_.problem().n_pairs(); ++j) {
    const RollingPair& p = window_.pairs()[at(j)];
    const NodeVector<3> now = displaced(window_, p, next.u);
    all.segment<3>(3 * j) = now - displaced(window_, p, state_.u);
    all[3 * j] = touch_height_ - next.depth + rise_of(window_, p) + now[0];
    all[3 * j + 1] += next.slide - state_.slide;
  }
  return all;
}

/// By the fields alone, which the solver of contact never saw.
void StandingWheel::judge(StandingState& next) const {
  next.residual =
      residual_of(window_.problem(), RollingPoint{next.solution.force, next.solution.height, 0.0},
                  moved(next), PairCoefficients(friction_of_all(), pairs_));
  MatrixXd force = MatrixXd::Zero(next.u.rows(), next.u.cols());
  for (std::size_t j = 0; j < window_.pairs().size(); ++j) {
    const RollingPair& p = window_.pairs()[j];
    force.block<3, 1>(3 * harmonics_.body().candidates[p.candidate],
                      static_cast<Index>(harmonics_.wrapped(p.sample))) =
        window_.to_ground(p.sample).transpose() *
        next.solution.force.segment<3>(static_cast<Index>(3 * j));
  }
  const std::vector<Vec3> ground = in_wheel_axes(harmonics_, force);
  double left = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    left = keep_larger(left, norm(next.inner[i] - ground[i]));
    largest = std::max(largest, norm(ground[i]));
  }
  next.equilibrium = left == 0.0 ? 0.0 : left / largest;
  next.penetration = 0.0;
  each_candidate(harmonics_, [&](const RollingPair& p) {
    const double gap =
        touch_height_ - next.depth + rise_of(window_, p) + displaced(window_, p, next.u)[0];
    next.penetration = std::max(next.penetration, -gap);
  });
}

/// By mean forces of the increment, (6.4e).
void StandingWheel::add_works(StandingState& next) const {
  const VectorXd before = padded(state_.solution.force, next.solution.force.size());
  const double down = next.depth - state_.depth, ahead = next.slide - state_.slide;
  CompensatedSum contact;
  for (std::size_t j = 0; j < window_.pairs().size(); ++j) {
    const auto row = static_cast<Index>(3 * j);
    const NodeVector<3> mean = 0.5 * (before.segment<3>(row) + next.solution.force.segment<3>(row));
    if (mean.isZero(0.0)) continue;
    const NodeVector<3> by = displaced(window_, window_.pairs()[j], next.u) -
                             displaced(window_, window_.pairs()[j], state_.u);
    contact.add(mean.dot(by));
    next.sums[0].add(mean[0] * down - mean[1] * ahead);
    next.sums[1].add(-mean[1] * (by[1] + ahead) - mean[2] * by[2]);
    next.sums[2].add(-mean[0] * (by[0] - down));
  }
  for (std::size_t i = 0; i < next.nodes.size(); ++i)
    next.sums[3].add(0.5 * dot(state_.inner[i] + next.inner[i], next.nodes[i] - state_.nodes[i]));
  CrushWorks& w = next.works;
  w.contact += contact.value();
  w.rim = next.sums[0].value();
  w.friction = next.sums[1].value();
  w.impact = next.sums[2].value();
  w.internal = remainder_ ? next.sums[3].value() : w.strain;
  w.residual = w.internal - w.contact;
  w.exchanged = std::max(w.exchanged, w.strain + std::abs(w.contact));
  const double relative = w.residual != 0.0 ? std::abs(w.residual) / w.exchanged : 0.0;
  w.relative = keep_larger(w.relative, relative);
}

RollingEnd StandingWheel::press(const StandingTarget& target) {
  trial_ = state_;
  trial_.depth = target.depth;
  trial_.slide = target.slide;
  if (!target.load && target.depth <= 0.0) {
    lift_off(trial_);
    trial_.works.strain = 0.0;
  } else {
    if (!solve(target, trial_)) return trial_.solution.end;
    judge(trial_);
  }
  add_works(trial_);
  state_ = std::move(trial_);
  return state_.solution.end;
}

}  // namespace rondo::statics
