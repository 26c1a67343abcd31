// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "rondo/mesh/deformed_boundary.hpp"

namespace rondo::study {
namespace {

using contact::Status;
using Eigen::Index;

constexpr std::string_view without_friction =
    "motion.speed instead, because without friction no traction determines it; or ground.friction "
    "above 0";
constexpr Vec2 normal{0.0, 1.0};  ///< a contact frame's vector times it is along the fixed axes

statics::RollingDrive drive_of(const Case& c) {
  const AnalysisCase& a = c.analysis;
  statics::RollingDrive d;
  d.height = c.motion.height.at(0.0) - floor_of(c);
  d.speed = c.motion.speed.at(0.0);
  if (a.traction || a.torque) d.speed = c.motion.angular_velocity.at(0.0) * c.disk.outer_radius;
  d.friction = c.ground->friction;
  d.load = a.load;
  d.traction = a.traction;
  d.torque = a.torque;
  return d;
}

}  // namespace

SteadyState::SteadyState(const Case& c, const SteadyBody& body)
    : case_(c),
      body_(body),
      window_(*body.window),
      drive_(drive_of(c)),
      candidate_of_(body.mesh.n_nodes()),
      sums_(static_cast<std::size_t>(c.analysis.samples_per_sector)) {
  for (std::size_t k = 0; k < body.mesh.boundary.size(); ++k)
    candidate_of_[static_cast<std::size_t>(body.mesh.boundary[k])] = k;
  demand_free_shape(c, statics::lowest_place(window_), c.disk.outer_radius);
  solve();
  refuse();
  if (solution_.end == statics::RollingEnd::solved) sum_up();
}

/// Where the speed is asked for and Newton does not find it, from the statuses of free rolling.
void SteadyState::solve() {
  using statics::RollingEnd;
  solution_ = statics::solve_rolling(window_, drive_);
  if (solution_.end == RollingEnd::not_solved && (drive_.traction || drive_.torque)) {
    statics::RollingDrive rolling = drive_;
    rolling.traction.reset();
    rolling.torque.reset();
    const auto free = statics::solve_rolling(window_, rolling);
    if (free.end == RollingEnd::solved)
      solution_ = statics::solve_rolling(window_, drive_, free.status);
  }
  if (solution_.end != RollingEnd::solved) return;
  spectrum_ = statics::spectrum_of(window_, solution_);
  power_ = statics::rolling_power(window_, solution_, spectrum_);
  u_ = window_.harmonics().fields(spectrum_, 0.0, false);
}

void SteadyState::refuse() const {
  const AnalysisCase& a = case_.analysis;
  if (solution_.end == statics::RollingEnd::no_contact) {
    const double radius = case_.disk.outer_radius;
    if (a.load)
      throw case_error(case_, "analysis.load", "no contact was found that carries it",
                       "a smaller load, which presses the body in by a part of its wall only");
    throw case_error(
        case_, "motion.height",
        fmt::format("nothing touches: the center is {:.6g} m above the ground", drive_.height),
        fmt::format("less than the outer radius as deformed by the spin, about {:.6g} "
                    "m above the ground",
                    radius));
  }
  if (solution_.end == statics::RollingEnd::sliding)
    throw case_error(
        case_, a.torque ? "analysis.torque" : "analysis.traction",
        "the whole contact slides, which does not determine the speed: friction carries no more",
        drive_.friction == 0.0 ? std::string(without_friction)
                               : fmt::format("nearer to 0, below ground.friction = {:.6g} times "
                                             "the load{}; or motion.speed instead",
                                             drive_.friction, a.torque ? " times the height" : ""));
  if (solution_.end == statics::RollingEnd::solved && solution_.height <= case_.disk.inner_radius)
    throw case_error(case_, a.load ? "analysis.load" : "motion.height",
                     fmt::format("the ground is within the rim: the center is {:.6g} m above it",
                                 solution_.height),
                     fmt::format("a value that leaves it well above the inner radius, {:.6g} m",
                                 case_.disk.inner_radius));
}

std::string SteadyState::trouble() const {
  if (solution_.end != statics::RollingEnd::solved)
    return fmt::format(
        "the contact was not solved: {}, after {} Newton steps and {} pivots; another "
        "analysis.samples_per_sector (4 to 32{}){}{} or both, a smaller ground.friction{}",
        std::isfinite(solution_.residual)
            ? fmt::format("residual {:.3g}, bound {:.0e}", solution_.residual, residual_bound)
            : "the iteration over sets of contacts did not end",
        solution_.newton_steps, solution_.pivots,
        window_.time() < case_.damping.stiffness
            ? fmt::format("; fewer, as a sample of {:.2g} s is shorter than damping.stiffness",
                          window_.time())
            : "",
        case_.analysis.massless_contact ? "" : ", analysis.massless_contact = true",
        case_.analysis.slip == RollingSlip::bdf2 ? ", analysis.slip = \"upwind\"" : "",
        case_.analysis.load ? " or analysis.load" : "");
  if (!(power_.residual <= residual_bound))
    return fmt::format("the power does not balance: relative residual {:.3g}, bound {:.0e}",
                       power_.residual, residual_bound);
  return {};
}

double SteadyState::resistance() const noexcept {
  if (solution_.speed == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return (-spin() * torque() - solution_.speed * solution_.forces.x) / std::abs(solution_.speed);
}

SteadyState::Where SteadyState::where(std::size_t pair) const {
  const statics::RollingPair& p = window_.pairs()[pair];
  const statics::RollingHarmonics& h = window_.harmonics();
  const int samples = h.body().samples, place = wrapped(sense() * p.sample, samples);
  const int sector = wrapped(p.sample - sense() * place, h.turn()) / samples;
  const auto row = static_cast<std::size_t>(h.body().candidates[p.candidate]);
  return {place, candidate_of_[body_.sector.node(row, static_cast<std::size_t>(sector))]};
}

/// What each pair that is pressed stands for at its place, of the deformed boundary.
void SteadyState::measure_extents() {
  const mesh::DeformedBoundary boundary(body_.mesh);
  extent_.assign(window_.pairs().size(), 0.0);
  Field u;
  for (int place = 0; place < window_.harmonics().body().samples; ++place) {
    unroll(u_, place, 1.0, u);
    for (std::size_t j = 0; j < extent_.size(); ++j)
      if (const Where w = where(j); w.place == place) extent_[j] = boundary.extent(w.candidate, u);
  }
}

void SteadyState::sum_up() {
  measure_extents();
  const statics::RollingHarmonics& h = window_.harmonics();
  const double share = 1.0 / h.body().samples;
  for (std::size_t j = 0; j < window_.pairs().size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    const Vec2 r{solution_.force[row + 1], solution_.force[row]};
    if (!(r.y > 0.0)) continue;
    const Where w = where(j);
    const statics::RollingPair& p = window_.pairs()[j];
    const Index local = 2 * h.body().candidates[p.candidate], sample = wrapped(p.sample, h.turn());
    const Vec2 x =
        body_.mesh.coordinates[body_.sector.node(static_cast<std::size_t>(local / 2), 0)];
    const Vec2 arm = window_.frame(p.sample) * (x + Vec2{u_(local, sample), u_(local + 1, sample)});
    const double length = extent_[j];
    const double slip = solution_.gap_and_slip[row + 1];
    const bool sticks = solution_.status[j].status == Status::stick;
    for (SteadySums* s : {&sums_[static_cast<std::size_t>(w.place)], &mean_}) {
      const double part = s == &mean_ ? share : 1.0;
      s->force += part * r;
      s->torque += part * cross(arm, r);
      ++s->nodes;
      s->sticking += sticks ? 1 : 0;
      (sticks ? s->stick_length : s->slip_length) += part * length;
      s->pressure = std::max(s->pressure, r.y / length);
      s->shear = std::max(s->shear, std::abs(r.x) / length);
      s->friction -= part * r.x * slip;
      s->slip = std::max(s->slip, std::abs(slip));
      s->penetration = std::max(s->penetration, -solution_.gap_and_slip[row]);
    }
  }
}

HistoryRecord SteadyState::record(int place, const Snapshot& now) const {
  const SteadySums& s = sums_[static_cast<std::size_t>(place)];
  HistoryRecord h;
  h.time = now.time;
  h.angle = now.angle;
  h.center = now.center;
  h.force = s.force;
  h.torque = s.torque;
  h.nodes = s.nodes;
  h.sticking = s.sticking;
  h.contact_length = s.stick_length + s.slip_length;
  h.penetration = s.penetration;
  h.slip_ratio = slip_ratio();
  std::vector<Vec2> ku(now.u.size());
  fem::apply(body_.sector, now.u, ku);
  for (std::size_t i = 0; i < now.u.size(); ++i) {
    h.balance.strain += 0.5 * dot(now.u.plane()[i], ku[i]);
    h.balance.kinetic += 0.5 * body_.mass[i] * dot(now.v.plane()[i], now.v.plane()[i]);
  }
  return h;
}

/// Polar components at a place into fixed ones of all nodes, times a number.
void SteadyState::unroll(const Eigen::MatrixXd& field, int place, double by, Field& nodes) const {
  const int samples = window_.harmonics().body().samples;
  nodes = Field(body_.mesh.n_nodes(), 2);
  for (int j = 0; j < body_.sector.n_sectors; ++j) {
    const auto sector = static_cast<std::size_t>(j);
    const Index m = wrapped(j * samples + sense() * place, window_.harmonics().turn());
    const Complex turn = by * body_.sector.turn[sector];
    for (std::size_t a = 0; a < body_.sector.n_local(); ++a) {
      const auto row = static_cast<Index>(2 * a);
      nodes.plane()[body_.sector.node(a, sector)] = turn * Vec2{field(row, m), field(row + 1, m)};
    }
  }
}

void SteadyState::displace(int place, Snapshot& s) const {
  unroll(u_, place, 1.0, s.u);
}

void SteadyState::fill(int place, Snapshot& s) {
  if (rate_.size() == 0) rate_ = window_.harmonics().fields(spectrum_, 0.0, true);
  s.time = s.time_velocity = place * sample_time();
  s.angle = s.angle_velocity = spin() * s.time;
  s.center = Vec2{case_.motion.start_x + solution_.speed * place * sample_time(), height()};
  displace(place, s);
  unroll(rate_, place, spin(), s.v);
  s.contacts.clear();
  for (std::size_t k = 0; k < window_.pairs().size(); ++k) {
    const Where w = where(k);
    const auto row = static_cast<Index>(2 * k);
    const Vec2 r{solution_.force[row + 1], solution_.force[row]};
    if (w.place == place && r.y > 0.0)
      s.contacts.push_back({.candidate = w.candidate,
                            .force = to_frame(normal, r),
                            .force_fixed = r,
                            .slip = solution_.gap_and_slip[row + 1],
                            .sticks = solution_.status[k].status == Status::stick});
  }
  std::ranges::sort(s.contacts, {}, &ContactForce::candidate);
}

double SteadyState::slip_ratio() const noexcept {
  return dynamics::slip_ratio(-spin() * case_.disk.outer_radius, solution_.speed);
}

std::unique_ptr<RolledState> SteadyBody::solve(const Case& c) const {
  return std::make_unique<SteadyState>(c, *this);
}

}  // namespace rondo::study
