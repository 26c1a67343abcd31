// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string_view>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/output/contact_statistics.hpp"

namespace rondo::fmu {
namespace {

/// Only one thread at a time builds: a mesh may come from a library that has one state.
std::mutex& building() {
  static std::mutex mutex;
  return mutex;
}

rom::RimVector velocities(const Values& v) {
  return {v.hub_velocity_x, v.hub_velocity_y, -v.hub_angular_velocity};
}

dynamics::Table height_table(double height, double velocity) {
  if (velocity == 0.0) return dynamics::Table(height);
  return dynamics::Table({{0.0, height}, {1.0, height + velocity}});
}

constexpr double led_speed = 60.0;  ///< to which a wheel may be led at least           [m/s]

/// Words of warnings about the motion of a case, which is not that of its FMU.
constexpr std::string_view of_motion[] = {"motion.", "tables of [motion]", "time.step"};

/// Spin up to which the residual is made, whatever the inputs: states go from one instance to
/// another.
double led_spin(const study::Case& c) {
  return std::max(2.0 * c.motion.angular_velocity.largest(), led_speed / c.disk.outer_radius);
}

/// The importer prescribes the hub: it is constrained, and no other load acts on it. Only the start
/// of its motion is known.
study::Case case_of(const study::Case& given, const Values& v) {
  if (given.initial.state == study::InitialState::steady_rolling && v.hub_angular_velocity == 0.0)
    throw study::case_error(given, "initial.state", "a wheel that stands does not roll steadily",
                            "a hub_angular_velocity other than 0 at the start, or \"rest\"");
  study::Case c = given;
  c.time.end = 1e-6;
  c.rim = dynamics::RimBody{};
  c.ground->friction = friction_with(given, v.friction);
  c.motion.start_x = v.hub_x_start;
  c.motion.speed = dynamics::Table(v.hub_velocity_x);
  c.motion.angular_velocity = dynamics::Table(v.hub_angular_velocity);
  c.motion.height = height_table(v.hub_height_start - v.ground_height, v.hub_velocity_y);
  return c;
}

bool same_parameters(const Values& a, const Values& b) {
  for (const Variable& variable : variables())
    if (variable.kind == Kind::parameter && a.*variable.value != b.*variable.value) return false;
  return true;
}

}  // namespace

/// Means over the steps since the last communication point.
struct Wheel::Sums {
  Vec2 held, contact;  ///< forces [N/m]
  double torque = 0.0;
  long long n = 0;
};

struct Wheel::Body {
  study::Case c;
  study::Setup setup;
  study::PreparedWheel wheel;
  dynamics::State start;
  study::Bounds bounds;
  double largest_step = 0.0;
  double mass = 0.0, inertia = 0.0;  ///< [kg/m], [kg·m]
  std::unique_ptr<rom::WheelRun> integrator;
  study::ContactStatistics contact;
  Values parameters;   ///< parameters with which it was made
  rom::RimVector hub;  ///< at the last communication point
  Sums sums;
  dynamics::StepReport last;
  double dt = 0.0;  ///< 0: no step was made
};

Wheel::Wheel(study::Case c, study::RunOptions options)
    : case_(std::move(c)), options_(std::move(options)) {}

Wheel::~Wheel() {
  const BorrowedBlas blas;
  body_.reset();
}

void Wheel::check() {
  if (!case_.ground)
    throw study::case_error(case_, "ground", "the wheel of an FMU has ground to roll on",
                            "a [ground], flat or with a profile");
  if (case_.mesh)
    throw study::case_error(
        case_, "mesh.file",
        "the importer moves the rim of an FMU, and a reduced wheel on a rim that "
        "moves needs equal sectors, which a mesh from a file is not known to have",
        "a [disk]; or rondo run --reduced, whose rim follows tables");
  if (case_.motion.gravity.points().size() > 1)
    throw study::case_error(case_, "motion.gravity", "gravity of an FMU stays as it is",
                            "a number");
}

double Wheel::step() const noexcept {
  return body_ ? body_->largest_step : 0.0;
}

int Wheel::n_modes() const {
  return body_ ? body_->wheel.n_modes() : 0;
}

void Wheel::begin(Values& values) {
  check();
  const BorrowedBlas blas;
  const std::lock_guard<std::mutex> lock(building());
  auto body = std::make_unique<Body>();
  Body& b = *body;
  b.c = case_of(case_, values);
  b.setup = study::build(b.c, 1, nullptr, study::Steps::of_reduced_wheel);
  study::prepare_wheel(b.c, options_, led_spin(case_), b.setup, b.wheel);
  b.largest_step = values.step > 0.0 ? values.step : b.setup.model.dt;
  b.start =
      dynamics::start(b.setup.model, b.setup.displacement, b.setup.velocity, b.setup.half_velocity);
  b.bounds = {study::residual_bound, study::largest_strain_energy(b.setup), "", false, "J/m"};
  body_ = std::move(body);
  // Warnings about [motion] are replaced by those about the inputs.
  for (const auto* said : {&b.setup.warnings, &b.wheel.warnings})
    for (const std::string& text : *said)
      if (std::ranges::none_of(of_motion, [&](std::string_view words) {
            return text.find(words) != std::string::npos;
          }))
        warn(text);
  b.hub = velocities(values);
  make_integrator(b.largest_step);
  b.mass = b.integrator->rim()->whole_mass();
  b.inertia = b.integrator->rim()->whole_inertia();
  values.tyre_mass = values.width * b.mass;
  values.tyre_inertia = values.width * b.inertia;
  b.parameters = values;
  warn_of_step(values, b.largest_step);
  const std::string wrong = make_steps(values, 1);
  Values first = values;
  fill(values, b.largest_step, first);
  first.hub_x = values.hub_x_start;
  first.hub_height = values.hub_height_start;
  first.hub_angle = 0.0;
  first.loaded_radius =
      b.setup.model.contact->ground.distance(b.setup.model.motion.center(0.0).plane());
  values = first;
  b.integrator.reset();
  b.dt = 0.0;
  b.contact = {};
  warn_of_spin(values);
  if (!wrong.empty()) warn("a first step of the hub as it starts fails: " + wrong);
}

void Wheel::make_integrator(double dt) {
  Body& b = *body_;
  b.setup.model.dt = dt;
  b.integrator = std::make_unique<rom::WheelRun>(b.setup.model, *b.wheel.ring, b.wheel.model,
                                                 b.wheel.figures, b.start);
  b.dt = dt;
}

double Wheel::first_step(double length) const {
  return length / std::ceil(length / body_->largest_step * (1.0 - 1e-9));
}

double Wheel::sectors_passed(const Values& values, double dt) const {
  const Body& b = *body_;
  const double spin = std::max(std::abs(b.hub[2]), std::abs(values.hub_angular_velocity));
  return spin * dt * b.setup.mesh.n_sectors / (2.0 * std::numbers::pi);
}

std::string Wheel::passed_text(double sectors, double dt) {
  return fmt::format(
      "the wheel turns by {:.3g} sectors of its mesh in an internal step; contact wants {} at the "
      "most: a step of {:.3g} s; more than {} are refused",
      sectors, good_sectors, dt * good_sectors / sectors, most_sectors);
}

void Wheel::warn_of_step(const Values& values, double dt) {
  const double sectors = sectors_passed(values, dt);
  if (sectors > good_sectors && said_.insert("sectors").second)
    warnings_.push_back(passed_text(sectors, dt));
}

std::string Wheel::refuse(const Values& values, double length, double slack) const {
  if (std::string wrong = refuse_length(length, slack); !wrong.empty()) return wrong;
  const double dt = body_->dt > 0.0 ? body_->dt : first_step(length);
  const double sectors = sectors_passed(values, dt);
  return sectors > most_sectors ? passed_text(sectors, dt) : std::string();
}

std::string Wheel::refuse_length(double length, double slack) const {
  const Body& b = *body_;
  if (!(length > 0.0) || !std::isfinite(length))
    return fmt::format("a communication step of {} s: must be above 0", length);
  constexpr double most = 1e5, close = 1e-9;
  const double step = b.dt > 0.0 ? b.dt : b.largest_step, steps = length / step;
  if (steps > most)
    return fmt::format(
        "a communication step of {:.6g} s has {:.3g} internal steps of {:.3g} s: at most {:.6g}, "
        "{:.3g} s, in one call",
        length, steps, step, most, most * step);
  if (b.dt == 0.0 || std::abs(steps - std::round(steps)) <= close * steps + slack / b.dt) return {};
  return fmt::format(
      "a communication step of {:.9g} s is no whole number of internal steps, which are {:.9g} s "
      "since the first communication step: {:.9g} s or {:.9g} s",
      length, b.dt, b.dt * std::max(1.0, std::floor(steps)), b.dt * std::ceil(steps));
}

std::string Wheel::go_on(Values& values, double length) {
  Body& b = *body_;
  const BorrowedBlas blas;
  if (b.dt == 0.0) make_integrator(first_step(length));
  const auto n = static_cast<long long>(std::llround(length / b.dt));
  warn_of_spin(values);
  warn_of_step(values, b.dt);
  std::string wrong = make_steps(values, n);
  if (!wrong.empty()) return wrong;
  Values to = values;
  fill(values, static_cast<double>(n) * b.dt, to);
  values = to;
  b.hub = velocities(values);
  const std::string late = study::late_friction_text(b.wheel.figures);
  if (!late.empty() && said_.insert("friction").second) warnings_.push_back(late);
  return {};
}

/// The hub's velocities change linearly from the last communication point to the given values.
std::string Wheel::make_steps(const Values& values, long long n) {
  Body& b = *body_;
  const rom::RimVector from = b.hub, to = velocities(values);
  b.sums = {};
  std::array<dynamics::StepReport, 1> report;
  for (long long k = 1; k <= n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    b.integrator->lead(k == n ? to : rom::RimVector(from + share * (to - from)));
    b.integrator->advance(report);
    b.last = report[0];
    b.contact.add(b.last.contact);
    b.sums.held += b.last.rim.force;
    b.sums.torque += b.last.rim.torque;
    b.sums.contact += b.last.contact.impulse.plane() / b.dt;
    ++b.sums.n;
    if (std::string wrong = trouble(); !wrong.empty()) return wrong;
  }
  return {};
}

std::string Wheel::trouble() const {
  const Body& b = *body_;
  const study::OutOfBound found = study::find_out_of_bound(b.last.balance, b.contact, b.bounds);
  const double time = b.last.frame.time;
  if (!found.what.empty()) return fmt::format("t = {:.9g} s of the wheel: {}", time, found.what);
  const double above = b.setup.model.contact->ground.distance(b.last.frame.center.plane());
  if (above > b.c.disk.inner_radius) return {};
  return fmt::format(
      "t = {:.9g} s of the wheel: its hub is {:.4g} m above the ground, and the rim, of {:.4g} m, "
      "is in it",
      time, above, b.c.disk.inner_radius);
}

/// (F.1), (F.2): forces that hold the hub, without inertia and weight of the rigid body.
void Wheel::fill(const Values& from, double length, Values& to) const {
  const Body& b = *body_;
  const double n = static_cast<double>(b.sums.n), w = from.width;
  const rom::RimVector rate = (velocities(from) - b.hub) / length;
  const Vec2 gravity = b.setup.model.motion.gravity_at(0.0);
  to.force_x = w * (b.mass * (rate[0] - gravity.x) - b.sums.held.x / n);
  to.force_y = w * (b.mass * (rate[1] - gravity.y) - b.sums.held.y / n);
  to.torque = w * (-b.inertia * rate[2] - b.sums.torque / n);
  to.contact_force_x = w * b.sums.contact.x / n;
  to.contact_force_y = w * b.sums.contact.y / n;
  const Vec2 center = b.last.frame.center.plane();
  to.hub_x = center.x;
  to.hub_height = center.y + from.ground_height;
  to.hub_angle = -b.last.frame.angle;
  to.loaded_radius = b.setup.model.contact->ground.distance(center);
  to.contact_length = b.last.contact.length;
}

void Wheel::warn(std::string text) {
  if (said_.insert(text).second) warnings_.push_back(std::move(text));
}

void Wheel::warn_of_spin(const Values& v) {
  const double known = body_->wheel.model.largest_spin, spin = std::abs(v.hub_angular_velocity);
  if (spin > known && said_.insert("spin").second)
    warnings_.push_back(
        fmt::format("hub_angular_velocity = {:.5g} rad/s: what no mode has is known up to {:.5g} "
                    "rad/s, and is extrapolated beyond it",
                    v.hub_angular_velocity, known));
}

void Wheel::forget_warnings() {
  said_.clear();
  warnings_.clear();
}

std::vector<std::string> Wheel::take_warnings() {
  return std::exchange(warnings_, {});
}

SavedWheel Wheel::save(const Values& values) const {
  const Body& b = *body_;
  SavedWheel s;
  s.values = values;
  s.start = b.parameters;
  s.dt = b.dt;
  s.velocity_x = b.hub[0];
  s.velocity_y = b.hub[1];
  s.angular_velocity = b.hub[2];
  if (b.dt > 0.0) s.state = b.integrator->save();
  return s;
}

/// If the state is from before the first step, or has other parameters, the wheel is made again, as
/// it was made at first.
void Wheel::restore(const SavedWheel& s, Values& values) {
  const BorrowedBlas blas;
  Values start = s.start;
  if (!s.state || !body_ || !same_parameters(body_->parameters, start)) begin(start);
  Body& b = *body_;
  if (s.state) {
    if (b.dt != s.dt) make_integrator(s.dt);
    if (!rom::WheelRun::is_saved(b.setup.model, *b.wheel.ring, b.wheel.model, s.state->ring))
      throw request_error("state", "", "is of another wheel", "one of this FMU");
    b.integrator->restore(*s.state);
  }
  b.contact = {};
  b.hub = {s.velocity_x, s.velocity_y, s.angular_velocity};
  values = s.values;
}

}  // namespace rondo::fmu
