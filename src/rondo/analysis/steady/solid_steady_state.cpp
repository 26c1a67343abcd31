// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/solid_steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/deformed_boundary.hpp"

namespace rondo::study {
namespace {

using contact::Status;
using Eigen::Index;

statics::SolidRollingDrive drive_of(const Case& c, const SolidSteadyBody& body) {
  const AnalysisCase& a = c.analysis;
  statics::SolidRollingDrive d;
  d.height = c.motion.height.at(0.0) - floor_of(c);
  d.speed = c.motion.speed.at(0.0);
  if (a.traction || a.torque) d.speed = c.motion.angular_velocity.at(0.0) * body.radius;
  d.slip_angle = c.motion.slip_angle.at(0.0);
  d.friction = c.ground->friction;
  d.load = a.load;
  d.traction = a.traction;
  d.torque = a.torque;
  return d;
}

}  // namespace

SolidSteadyState::SolidSteadyState(const Case& c, const SolidSteadyBody& body)
    : case_(c),
      body_(body),
      window_(*body.harmonics, slip_of(c), c.motion.camber, c.motion.gravity.at(0.0)),
      drive_(drive_of(c, body)),
      candidate_of_(body.mesh.n_nodes()),
      sums_(static_cast<std::size_t>(c.analysis.samples_per_sector)) {
  for (std::size_t k = 0; k < body.mesh.boundary.size(); ++k)
    candidate_of_[static_cast<std::size_t>(body.mesh.boundary[k])] = k;
  demand_free_shape(c, window_.lowest(), body.radius);
  solve();
  refuse();
  if (solution_.end == statics::RollingEnd::solved) sum_up();
}

void SolidSteadyState::solve() {
  solution_ = statics::solve_rolling(window_, drive_);
  if (solution_.end != statics::RollingEnd::solved) return;
  spectrum_ = statics::spectrum_of(window_, solution_);
  power_ = statics::rolling_power(window_, solution_, spectrum_);
  u_ = window_.harmonics().fields(spectrum_, false);
}

void SolidSteadyState::refuse() const {
  const AnalysisCase& a = case_.analysis;
  if (solution_.end == statics::RollingEnd::no_contact) {
    if (a.load)
      throw case_error(case_, "analysis.load", "no contact was found that carries it",
                       "a smaller load, which presses the wheel in by a part of its wall only");
    throw case_error(
        case_, "motion.height",
        fmt::format("nothing touches: the center is {:.6g} m above the ground", drive_.height),
        fmt::format("less than {:.6g} m above the ground, the lowest place of the wheel as the "
                    "spin deforms it",
                    window_.lowest()));
  }
  if (solution_.end == statics::RollingEnd::sliding)
    throw case_error(
        case_, a.torque ? "analysis.torque" : "analysis.traction",
        "the whole contact slides, which does not determine the speed: friction carries no more",
        drive_.friction == 0.0 ? "motion.speed instead, because without friction no traction "
                                 "determines it; or ground.friction above 0"
                               : "nearer to 0, or a smaller motion.slip_angle, because both share "
                                 "the friction; or motion.speed instead");
  if (solution_.end == statics::RollingEnd::solved && is_generated(case_) &&
      solution_.height <= case_.disk.inner_radius)
    throw case_error(case_, a.load ? "analysis.load" : "motion.height",
                     fmt::format("the ground is within the rim: the center is {:.6g} m above it",
                                 solution_.height),
                     fmt::format("a value that leaves it well above the inner radius, {:.6g} m",
                                 case_.disk.inner_radius));
}

/// What was found, and what makes fewer pairs where they are too many for the work on them.
std::string SolidSteadyState::not_solved() const {
  const AnalysisCase& a = case_.analysis;
  const bool too_many = solution_.work >= statics::most_solid_work;
  std::string found = "the iteration over sets of contacts did not end";
  if (too_many)
    found = fmt::format(
        "analysis.samples_per_sector = {} makes {} pairs of a node and a sample near the ground, "
        "and {:.2g} operations (limit {:.0e}) did not solve them",
        a.samples_per_sector, window_.pairs().size(), solution_.work, statics::most_solid_work);
  else if (std::isfinite(solution_.residual))
    found = fmt::format("residual {:.3g}, bound {:.0e}", solution_.residual,
                        statics::solid_residual_bound);
  std::string remedy = "another analysis.samples_per_sector (1 to 8, fewer first)";
  if (too_many)
    remedy = fmt::format("{}a coarser {}{}", a.samples_per_sector > 1 ? "fewer samples, " : "",
                         case_.section ? "section.file or fewer section.sectors" : "disk.mesh",
                         a.load ? "" : ", a larger motion.height");
  return fmt::format(
      "the contact was not solved: {}, after {} Newton steps and {} sweeps; {}{}{}, a smaller "
      "ground.friction{}",
      found, solution_.newton_steps, solution_.sweeps, remedy,
      a.massless_contact ? "" : ", analysis.massless_contact = true",
      a.slip == RollingSlip::bdf2 ? ", analysis.slip = \"upwind\"" : "",
      a.load ? " or analysis.load" : "");
}

std::string SolidSteadyState::trouble() const {
  if (solution_.end != statics::RollingEnd::solved) return not_solved();
  if (!(power_.residual <= residual_bound))
    return fmt::format("the power does not balance: relative residual {:.3g}, bound {:.0e}",
                       power_.residual, residual_bound);
  return {};
}

double SolidSteadyState::resistance() const noexcept {
  if (solution_.speed == 0.0) return std::numeric_limits<double>::quiet_NaN();
  const statics::SolidRollingForces& f = solution_.forces;
  const double along =
      f.heading * std::cos(drive_.slip_angle) + f.lateral * std::sin(drive_.slip_angle);
  return (-spin() * torque() - solution_.speed * along) / std::abs(solution_.speed);
}

/// Of the speed along the heading.
double SolidSteadyState::slip_ratio() const noexcept {
  return dynamics::slip_ratio(-spin() * body_.radius,
                              solution_.speed * std::cos(drive_.slip_angle));
}

SolidSteadyState::Where SolidSteadyState::where(std::size_t pair) const {
  const statics::RollingPair& p = window_.pairs()[pair];
  const statics::SolidHarmonics& h = window_.harmonics();
  const int samples = h.body().samples, place = wrapped(sense() * p.sample, samples);
  const int sector = wrapped(p.sample - sense() * place, h.turn()) / samples;
  const auto row = static_cast<std::size_t>(h.body().candidates[p.candidate]);
  return {place, candidate_of_[body_.sector.node(row, static_cast<std::size_t>(sector))]};
}

Vec3 SolidSteadyState::force(std::size_t pair) const {
  const auto row = static_cast<Index>(3 * pair);
  return {solution_.force[row], solution_.force[row + 1], solution_.force[row + 2]};
}

double SolidSteadyState::slip(std::size_t pair) const {
  return solution_.gap_and_slip.segment<2>(static_cast<Index>(3 * pair + 1)).norm();
}

void SolidSteadyState::add(std::size_t pair, double share, SolidSteadySums& s) const {
  const statics::GroundFrame& ground = window_.problem().ground;
  const auto row = static_cast<Index>(3 * pair), place = static_cast<Index>(2 * pair);
  const Vec3 r = force(pair), f = ground.to_wheel(r);
  const double gap = solution_.gap_and_slip[row];
  const Vec3 arm = ground.to_wheel({gap, solution_.place[place], solution_.place[place + 1]});
  const double area = extent_[pair];
  const bool sticks = solution_.status[pair] == Status::stick;
  s.force += share * r;
  s.moment += share * cross(arm, f);
  s.torque += share * cross(arm - solution_.height * ground.normal, f).z;
  ++s.nodes;
  s.sticking += sticks ? 1 : 0;
  (sticks ? s.stick_area : s.slip_area) += share * area;
  s.pressure = std::max(s.pressure, r.x / area);
  s.shear = std::max(s.shear, std::hypot(r.y, r.z) / area);
  s.friction -= share * force(pair).y * solution_.gap_and_slip[row + 1] +
                share * force(pair).z * solution_.gap_and_slip[row + 2];
  s.slip = std::max(s.slip, slip(pair));
  s.penetration = std::max(s.penetration, -gap);
}

/// What each pair that is pressed stands for at its place, of the deformed boundary.
void SolidSteadyState::measure_extents() {
  const mesh::DeformedBoundary boundary(body_.mesh);
  extent_.assign(window_.pairs().size(), 0.0);
  Field u;
  for (int place = 0; place < window_.harmonics().body().samples; ++place) {
    unroll(u_, place, 1.0, u);
    for (std::size_t j = 0; j < extent_.size(); ++j)
      if (const Where w = where(j); w.place == place) extent_[j] = boundary.extent(w.candidate, u);
  }
}

void SolidSteadyState::sum_up() {
  measure_extents();
  const double share = 1.0 / window_.harmonics().body().samples;
  for (std::size_t j = 0; j < window_.pairs().size(); ++j) {
    if (!(force(j).x > 0.0)) continue;
    add(j, 1.0, sums_[static_cast<std::size_t>(where(j).place)]);
    add(j, share, mean_);
  }
}

HistoryRecord SolidSteadyState::record(int place, const Snapshot& now) const {
  const SolidSteadySums& s = sums_[static_cast<std::size_t>(place)];
  HistoryRecord h;
  h.time = now.time;
  h.angle = now.angle;
  h.center = now.center;
  h.force = {s.force.y, s.force.x, s.force.z};
  h.torque = s.torque;
  h.moment_aligning = dot(s.moment, window_.problem().ground.normal);
  h.moment_overturning = dot(s.moment, window_.problem().ground.heading);
  h.nodes = s.nodes;
  h.sticking = s.sticking;
  h.contact_length = s.stick_area + s.slip_area;
  h.penetration = s.penetration;
  h.slip_ratio = slip_ratio();
  h.slip_angle = drive_.slip_angle;
  const std::span<const Vec3> u = now.u.space(), v = now.v.space();
  std::vector<Vec3> ku(u.size());
  fem::apply(body_.sector, u, ku);
  for (std::size_t i = 0; i < u.size(); ++i) {
    h.balance.strain += 0.5 * dot(u[i], ku[i]);
    h.balance.kinetic += 0.5 * body_.mass[i] * dot(v[i], v[i]);
  }
  return h;
}

/// Polar components at a place into fixed ones of all nodes, times a number.
void SolidSteadyState::unroll(const Eigen::MatrixXd& field, int place, double by,
                              Field& nodes) const {
  const int samples = window_.harmonics().body().samples;
  nodes = Field(body_.mesh.n_nodes(), 3);
  for (int j = 0; j < body_.sector.n_sectors; ++j) {
    const auto sector = static_cast<std::size_t>(j);
    const Index m = wrapped(j * samples + sense() * place, window_.harmonics().turn());
    const Complex turn = by * body_.sector.turn[sector];
    for (std::size_t a = 0; a < body_.sector.n_local(); ++a) {
      const auto row = static_cast<Index>(3 * a);
      nodes.space()[body_.sector.node(a, sector)] = {turn * Vec2{field(row, m), field(row + 1, m)},
                                                     by * field(row + 2, m)};
    }
  }
}

void SolidSteadyState::displace(int place, Snapshot& s) const {
  unroll(u_, place, 1.0, s.u);
}

void SolidSteadyState::fill(int place, Snapshot& s) {
  if (rate_.size() == 0) rate_ = window_.harmonics().fields(spectrum_, true);
  s.time = s.time_velocity = place * sample_time();
  s.angle = s.angle_velocity = spin() * s.time;
  const double way = solution_.speed * s.time;
  s.center = {case_.motion.start_x + way * std::cos(drive_.slip_angle), height(),
              way * std::sin(drive_.slip_angle)};
  displace(place, s);
  unroll(rate_, place, spin(), s.v);
  s.contacts.clear();
  constexpr Vec2 normal{0.0, 1.0};  // along t1 and n
  for (std::size_t k = 0; k < window_.pairs().size(); ++k) {
    const Where w = where(k);
    const Vec3 r = force(k), fixed = window_.problem().ground.to_wheel(r);
    if (w.place == place && r.x > 0.0)
      s.contacts.push_back({.candidate = w.candidate,
                            .force = {to_frame(normal, Vec2{r.y, r.x}), r.z},
                            .force_fixed = fixed,
                            .slip = slip(k),
                            .sticks = solution_.status[k] == Status::stick});
  }
  std::ranges::sort(s.contacts, {}, &ContactForce::candidate);
}

std::unique_ptr<RolledState> SolidSteadyBody::solve(const Case& c) const {
  return std::make_unique<SolidSteadyState>(c, *this);
}

}  // namespace rondo::study
