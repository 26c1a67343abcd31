// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/analysis/build/ground/rolling_law.hpp"
#include "rondo/analysis/steady/steady_remainder.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::study {
namespace {

using contact::Status;
using Eigen::Index;

statics::RollingDrive drive_of(const Case& c, double radius) {
  const AnalysisCase& a = c.analysis;
  statics::RollingDrive d;
  d.height = c.motion.height.at(0.0) - floor_of(c);
  d.speed = c.motion.speed.at(0.0);
  if (a.traction || a.torque) d.speed = c.motion.angular_velocity.at(0.0) * radius;
  d.slip_angle = c.motion.slip_angle.at(0.0);
  d.turn_slip = a.turn_slip;
  d.friction = constant_part(c.ground->friction);
  d.load = a.load;
  d.traction = a.traction;
  d.torque = a.torque;
  return d;
}

}  // namespace

template <int D>
SteadyState<D>::SteadyState(const Case& c, const SteadyBody<D>& body)
    : case_(c),
      body_(body),
      window_(body.window_of(c, slip_of(c))),
      law_(rolling_friction_of(
          c.ground->friction,
          extents_of<D>(body.mesh, body.sector, body.harmonics->body().candidates))),
      drive_(drive_of(c, body.radius)),
      candidate_of_(body.mesh.n_nodes()),
      sums_(static_cast<std::size_t>(c.analysis.samples_per_sector)) {
  if (law_) drive_.law = &*law_;
  for (std::size_t k = 0; k < body.mesh.boundary.size(); ++k)
    candidate_of_[at(body.mesh.boundary[k])] = k;
  demand_free_shape(c, window_.lowest(), body.radius);
  solve();
  refuse();
  if (solution_.end != statics::RollingEnd::solved) return;
  sum_up();
  if (has_slip_step(c)) step_slip();
}

template <int D>
void SteadyState<D>::step_slip() {
  if constexpr (D == 3)
    slip_step_ = roll_after_step(
        case_, {window_, drive_, solution_, {body_.radius, window_.harmonics().turn()}});
}

/// In the plane, where the speed is asked for and Newton does not find it, from the statuses of
/// free rolling.
template <int D>
statics::RollingSolution SteadyState<D>::solved(statics::RollingWindow<D>& window) const {
  using statics::RollingEnd;
  statics::RollingSolution found = statics::solve_rolling(window, drive_);
  if (D == 2 && found.end == RollingEnd::not_solved && (drive_.traction || drive_.torque)) {
    statics::RollingDrive rolling = drive_;
    rolling.traction.reset();
    rolling.torque.reset();
    const auto free = statics::solve_rolling(window, rolling);
    if (free.end == RollingEnd::solved) found = statics::solve_rolling(window, drive_, free.status);
  }
  return found;
}

template <>
void SteadyState<2>::solve_finite() {
  RONDO_DEMAND(false);  // a plane body with rubber is refused
}
template <>
void SteadyState<3>::solve_finite() {
  const statics::RollingBody<3>& body = body_.harmonics->body();
  // Half of what stiffness damping has beside K at the highest harmonic of a turn, L/2.
  const double damped =
      0.25 * window_.harmonics().turn() * std::abs(body.spin) * body.stiffness_damping;
  auto remainder = std::make_unique<SteadyRemainder>(
      body_.mesh, body_.sector, *body_.swept, body.candidates, body.samples, damped, body.threads);
  finite_ = statics::solve_finite_rolling(window_, drive_, *remainder);
  solution_ = finite_->solution;
  for (int place = 0; place < body.samples; ++place)
    energies_.push_back(remainder->energy(wrapped(sense() * place, body.samples)));
  remainder_ = std::move(remainder);
}

template <int D>
void SteadyState<D>::solve() {
  if (body_.swept)
    solve_finite();
  else
    solution_ = solved(window_);
  if (solution_.end != statics::RollingEnd::solved) return;
  spectrum_ = finite_ ? std::move(finite_->spectrum) : statics::spectrum_of(window_, solution_);
  power_ = statics::rolling_power(window_, solution_, spectrum_,
                                  finite_ ? finite_->remainder : Eigen::MatrixXd());
  u_ = finite_ ? std::move(finite_->u) : window_.harmonics().fields(spectrum_, 0.0, false);
  if (case_.analysis.estimate_slip_error) estimate_slip_error();
  remainder_.reset();  // its tangent takes the most memory
}

/// With the tangent at a state that is not linear.
template <>
void SteadyState<2>::linearise(statics::RollingWindow<2>& /*other*/) const {
  RONDO_DEMAND(false);  // a plane body with rubber is refused
}
template <>
void SteadyState<3>::linearise(statics::RollingWindow<3>& other) const {
  other.take_response(window_.response());
  other.include(window_.pairs());
  other.soften([this](const statics::RollingPair& of, const statics::RollingPair& by) {
    return remainder_->softness(of, by);
  });
  other.foresee(solution_.force, Eigen::MatrixXd::Zero(u_.rows(), u_.cols()));
}

/// By the same state with the other difference, in space from the state itself; of one that is not
/// linear by its tangent. With a table of friction, which may have several states, anew.
template <int D>
void SteadyState<D>::estimate_slip_error() {
  using statics::SlipDifference;
  const bool is_upwind = slip_of(case_) == SlipDifference::upwind;
  statics::RollingWindow<D> other =
      body_.window_of(case_, is_upwind ? SlipDifference::bdf2 : SlipDifference::upwind);
  const bool is_near = finite_ || (D == 3 && !law_);
  if (finite_)
    linearise(other);
  else if (is_near)
    other.include(window_.pairs());
  const statics::RollingSolution found =
      is_near ? statics::solve_rolling_from(other, drive_, solution_) : solved(other);
  if (found.end != statics::RollingEnd::solved) return;
  slip_error_ = is_upwind ? slip_error_of(solution_.forces, found.forces)
                          : slip_error_of(found.forces, solution_.forces);
}

template <int D>
void SteadyState<D>::refuse() const {
  const AnalysisCase& a = case_.analysis;
  if (solution_.end == statics::RollingEnd::no_contact) {
    if (a.load)
      throw case_error(case_, "analysis.load", "no contact was found that carries it",
                       fmt::format("a smaller load, which presses the {} in by a part of its wall "
                                   "only",
                                   D == 2 ? "body" : "wheel"));
    throw case_error(
        case_, "motion.height",
        fmt::format("nothing touches: the center is {:.6g} m above the ground", drive_.height),
        nothing_touches());
  }
  if (solution_.end == statics::RollingEnd::sliding)
    throw case_error(case_, a.torque ? "analysis.torque" : "analysis.traction",
                     "the whole contact slides, which does not determine the speed: friction "
                     "carries no more",
                     why_it_slides());
  if (solution_.end == statics::RollingEnd::solved && is_generated(case_) &&
      solution_.height <= case_.disk.inner_radius)
    throw case_error(case_, a.load ? "analysis.load" : "motion.height",
                     fmt::format("the ground is within the rim: the center is {:.6g} m above it",
                                 solution_.height),
                     fmt::format("a value that leaves it well above the inner radius, {:.6g} m",
                                 case_.disk.inner_radius));
}

template <int D>
std::string SteadyState<D>::trouble() const {
  if (solution_.end != statics::RollingEnd::solved) return not_solved();
  if (!(power_.residual <= residual_bound))
    return fmt::format("the power does not balance: relative residual {:.3g}, bound {:.0e}",
                       power_.residual, residual_bound);
  if (slip_step_) return slip_step_->trouble;
  return {};
}

template <int D>
double SteadyState<D>::resistance() const noexcept {
  if (solution_.speed == 0.0) return std::numeric_limits<double>::quiet_NaN();
  const statics::RollingForces& f = solution_.forces;
  const double along =
      f.heading * std::cos(drive_.slip_angle) + f.lateral * std::sin(drive_.slip_angle);
  const double yaw = drive_.turn_slip * f.aligning;
  return (-spin() * torque() - solution_.speed * (along + yaw)) / std::abs(solution_.speed);
}

/// The slip ratio uses the component of the speed along the heading.
template <int D>
double SteadyState<D>::slip_ratio() const noexcept {
  return dynamics::slip_ratio(-spin() * body_.radius,
                              solution_.speed * std::cos(drive_.slip_angle));
}

template <int D>
typename SteadyState<D>::Where SteadyState<D>::where(std::size_t pair) const {
  const statics::RollingPair& p = window_.pairs()[pair];
  const statics::RollingHarmonics<D>& h = window_.harmonics();
  const int samples = h.body().samples, place = wrapped(sense() * p.sample, samples);
  const int sector = wrapped(p.sample - sense() * place, h.turn()) / samples;
  const auto row = static_cast<std::size_t>(h.body().candidates[p.candidate]);
  return {place, candidate_of_[body_.sector.node(row, static_cast<std::size_t>(sector))]};
}

template <int D>
double SteadyState<D>::slip(std::size_t pair) const {
  const statics::NodeVector<D - 1> s =
      solution_.gap_and_slip.template segment<D - 1>(static_cast<Index>(D * pair + 1));
  return D == 2 ? s[0] : s.norm();
}

template <int D>
double SteadyState<D>::friction_of(std::size_t pair) const {
  const auto row = static_cast<Index>(D * pair);
  return -force(pair).template tail<D - 1>().dot(
      solution_.gap_and_slip.template segment<D - 1>(row + 1));
}

template <int D>
void SteadyState<D>::add(std::size_t pair, double share, SteadySums& s) const {
  const auto row = static_cast<Index>(D * pair), at = static_cast<Index>((D - 1) * pair);
  const statics::NodeVector<D> r = force(pair);
  const statics::NodeVector<D - 1> shear = r.template tail<D - 1>();
  const double gap = solution_.gap_and_slip[row], extent = extent_[pair];
  const bool sticks = solution_.status[pair].status == Status::stick;
  statics::add_force<D>(r, solution_.place.template segment<D - 1>(at), solution_.height,
                        window_.problem().lean, share, s.forces);
  ++s.nodes;
  s.sticking += sticks ? 1 : 0;
  (sticks ? s.stick : s.slip) += share * extent;
  s.pressure = std::max(s.pressure, r[0] / extent);
  s.shear = std::max(s.shear, (D == 2 ? std::abs(shear[0]) : shear.norm()) / extent);
  s.friction += share * friction_of(pair);
  s.speed = std::max(s.speed, std::abs(slip(pair)));
  s.penetration = std::max(s.penetration, -gap);
  const double coefficient = statics::PairCoefficients(drive_.friction, solution_.pairs)[pair];
  s.least_friction = std::min(s.least_friction, coefficient);
  s.most_friction = std::max(s.most_friction, coefficient);
}

/// What each pair that is pressed stands for at its place, of the deformed boundary.
template <int D>
void SteadyState<D>::measure_extents() {
  const mesh::DeformedBoundary boundary(body_.mesh);
  extent_.assign(window_.pairs().size(), 0.0);
  Field u;
  for (int place = 0; place < window_.harmonics().body().samples; ++place) {
    unroll(u_, place, 1.0, u);
    for (std::size_t j = 0; j < extent_.size(); ++j)
      if (const Where w = where(j); w.place == place) extent_[j] = boundary.extent(w.candidate, u);
    if constexpr (D == 3) measure_footprint(place, boundary, u);
  }
}

/// @param u at the place, in the turning frame
template <int D>
void SteadyState<D>::measure_footprint(int place, const mesh::DeformedBoundary& boundary,
                                       FieldView u) {
  mesh::Footprint footprint(GroundFrame(case_.motion.camber),
                            rotation(spin() * (place * sample_time())));
  for (std::size_t j = 0; j < extent_.size(); ++j)
    if (const Where w = where(j); w.place == place && force(j)[0] > 0.0)
      boundary.widen(w.candidate, u, footprint);
  sums_[at(place)].length = footprint.length();
  sums_[at(place)].width = footprint.width();
}

template <int D>
void SteadyState<D>::sum_up() {
  measure_extents();
  const double share = 1.0 / window_.harmonics().body().samples;
  for (std::size_t j = 0; j < window_.pairs().size(); ++j) {
    if (!(force(j)[0] > 0.0)) continue;
    add(j, 1.0, sums_[at(where(j).place)]);
    add(j, share, mean_);
  }
  for (const SteadySums& s : sums_) {
    mean_.length += share * s.length;
    mean_.width += share * s.width;
  }
}

template <int D>
HistoryRecord SteadyState<D>::record(int place, const Snapshot& now) const {
  const SteadySums& s = sums_[at(place)];
  HistoryRecord h;
  h.time = now.time;
  h.angle = now.angle;
  h.center = now.center;
  h.force = {s.forces.heading, s.forces.normal, s.forces.lateral};
  h.torque = s.forces.torque;
  h.moment_aligning = s.forces.aligning;
  h.moment_overturning = s.forces.overturning;
  h.moments_iso = GroundFrame(case_.motion.camber)
                      .about_contact_centre({s.forces.aligning, s.forces.overturning}, h.force,
                                            solution_.height);
  h.nodes = s.nodes;
  h.sticking = s.sticking;
  h.contact_length = s.stick + s.slip;
  h.footprint_length = s.length;
  h.footprint_width = s.width;
  h.penetration = s.penetration;
  h.slip_ratio = slip_ratio();
  h.slip_angle = drive_.slip_angle;
  const std::span<const Vec> u = now.u, v = now.v;
  std::vector<Vec> ku(u.size());
  fem::apply(body_.sector, u, ku);
  for (std::size_t i = 0; i < u.size(); ++i) {
    h.balance.strain += 0.5 * dot(u[i], ku[i]);
    h.balance.kinetic += 0.5 * body_.mass[i] * dot(v[i], v[i]);
  }
  if (finite_) h.balance.strain = energies_[at(place)];
  return h;
}

/// Polar components at a place into fixed ones of all nodes, times a number.
template <int D>
void SteadyState<D>::unroll(const Eigen::MatrixXd& field, int place, double by,
                            Field& nodes) const {
  const int samples = window_.harmonics().body().samples;
  nodes = Field(body_.mesh.n_nodes(), D);
  const std::span<Vec> of = nodes;
  for (int j = 0; j < body_.sector.n_sectors; ++j) {
    const auto sector = static_cast<std::size_t>(j);
    const Index m = wrapped(j * samples + sense() * place, window_.harmonics().turn());
    const Complex turn = by * body_.sector.turn[sector];
    for (std::size_t a = 0; a < body_.sector.n_local(); ++a) {
      const auto row = static_cast<Index>(D * a);
      const Vec2 plane = turn * Vec2{field(row, m), field(row + 1, m)};
      if constexpr (D == 2)
        of[body_.sector.node(a, sector)] = plane;
      else
        of[body_.sector.node(a, sector)] = {plane, by * field(row + 2, m)};
    }
  }
}

template <int D>
void SteadyState<D>::displace(int place, Snapshot& s) const {
  unroll(u_, place, 1.0, s.u);
}

template <int D>
void SteadyState<D>::fill(int place, Snapshot& s) {
  if (rate_.size() == 0) rate_ = window_.harmonics().fields(spectrum_, 0.0, true);
  s.time = s.time_velocity = place * sample_time();
  s.angle = s.angle_velocity = spin() * s.time;
  const double way = solution_.speed * place * sample_time();
  s.center = {case_.motion.start_x + way * std::cos(drive_.slip_angle), height(),
              way * std::sin(drive_.slip_angle)};
  displace(place, s);
  unroll(rate_, place, spin(), s.v);
  s.contacts.clear();
  constexpr Vec2 normal{0.0, 1.0};  // along t1 and n
  const statics::NodeMatrix<D> axes = statics::ground_axes<D>(window_.problem().lean);
  for (std::size_t k = 0; k < window_.pairs().size(); ++k) {
    const Where w = where(k);
    const statics::NodeVector<D> r = force(k), fixed = axes * r;
    if (w.place != place || !(r[0] > 0.0)) continue;
    ContactForce& f = s.contacts.emplace_back();
    f.candidate = w.candidate;
    f.force = {to_frame(normal, Vec2{r[1], r[0]}), D == 2 ? 0.0 : r[D - 1]};
    f.force_fixed = {fixed[0], fixed[1], D == 2 ? 0.0 : fixed[D - 1]};
    f.slip = slip(k);
    f.power = friction_of(k);
    f.sticks = solution_.status[k].status == Status::stick;
  }
  std::ranges::sort(s.contacts, {}, &ContactForce::candidate);
}

template <int D>
std::unique_ptr<RolledState> SteadyBody<D>::solve(const Case& c) const {
  return std::make_unique<SteadyState<D>>(c, *this);
}

template class SteadyState<2>;
template class SteadyState<3>;
template std::unique_ptr<RolledState> SteadyBody<2>::solve(const Case&) const;
template std::unique_ptr<RolledState> SteadyBody<3>::solve(const Case&) const;

}  // namespace rondo::study
