// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <string_view>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/fmu/led_wheel.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/model/solid/wheel_ground.hpp"
#include "rondo/output/contact_statistics.hpp"

namespace rondo::fmu {
namespace {

/// Only one thread at a time builds: a mesh may come from a library that has one state.
std::mutex& building() {
  static std::mutex mutex;
  return mutex;
}

/// Between two velocities. @param share of the way: 0 to 1
rom::HubVelocity between(const rom::HubVelocity& a, const rom::HubVelocity& b, double share) {
  const auto mixed = [&](double from, double to) { return from + share * (to - from); };
  rom::HubVelocity v;
  v.along = a.along + share * (b.along - a.along);
  v.spin = mixed(a.spin, b.spin);
  v.camber_rate = mixed(a.camber_rate, b.camber_rate);
  v.yaw_rate = mixed(a.yaw_rate, b.yaw_rate);
  return v;
}

dynamics::Table height_table(double height, double velocity) {
  if (velocity == 0.0) return dynamics::Table(height);
  return dynamics::Table({{0.0, height}, {1.0, height + velocity}});
}

constexpr double led_speed = 60.0;  ///< to which a wheel may be led at least           [m/s]

/// Words of warnings about the motion of a case, which is not that of its FMU.
constexpr std::string_view of_motion[] = {"motion.", "tables of [motion]", "time.step"};

/// Largest and smallest distance of a node from the axle [m].
std::array<double, 2> radii_of(const study::Case& c, const study::Setup& setup) {
  if (!c.section) return {c.disk.outer_radius, c.disk.inner_radius};
  std::array<double, 2> radii{0.0, std::numeric_limits<double>::infinity()};
  for (const Vec2 x : setup.model.reference)
    radii = {std::max(radii[0], norm(x)), std::min(radii[1], norm(x))};
  return radii;
}

/// Spin up to which the residual is made, whatever the inputs: states go from one instance to
/// another.
double led_spin(const study::Case& c, double radius) {
  return std::max(2.0 * c.motion.angular_velocity.largest(), led_speed / radius);
}

/// Gives a wheel in three dimensions the velocity along the ground at the start.
void set_course(const Values& v, dynamics::Motion& motion) {
  const double left = v.hub_velocity_left;
  const double sense = v.hub_velocity_x < 0.0 ? -1.0 : 1.0;
  motion.speed = dynamics::Table(sense * std::hypot(v.hub_velocity_x, left));
  motion.slip_angle =
      dynamics::Table(left == 0.0 ? 0.0 : std::atan2(-sense * left, std::abs(v.hub_velocity_x)));
  motion.camber = v.camber_start;
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
  c.motion.height = height_table(v.hub_height_start - v.ground_height, v.hub_velocity_up);
  if (dimension_of(given) == Dimension::space) set_course(v, c.motion);
  return c;
}

bool same_parameters(Dimension dimension, const Values& a, const Values& b) {
  for (const Variable& variable : variables(dimension))
    if (variable.kind == Kind::parameter && a.*variable.value != b.*variable.value) return false;
  return true;
}

}  // namespace

struct Wheel::Body {
  study::Case c;
  study::Setup setup;
  study::PreparedWheel wheel;
  dynamics::State start;
  study::Bounds bounds;
  double largest_step = 0.0;
  double rim = 0.0;  ///< its radius                                                 [m]
  std::unique_ptr<LedWheel> run;
  study::ContactStatistics contact;
  Values parameters;     ///< parameters with which it was made
  rom::HubVelocity hub;  ///< at the last communication point
  double dt = 0.0;       ///< 0: no step was made
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

Dimension Wheel::dimension() const {
  return dimension_of(case_);
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
  const auto [radius, rim] = radii_of(case_, b.setup);
  b.rim = rim;
  study::prepare_wheel(b.c, options_, led_spin(case_, radius), b.setup, b.wheel);
  b.largest_step = values.step > 0.0 ? values.step : b.setup.model.dt;
  b.start =
      dynamics::start(b.setup.model, b.setup.displacement, b.setup.velocity, b.setup.half_velocity);
  const bool is_plane = dimension() == Dimension::plane;
  b.bounds = {study::residual_bound, study::largest_strain_energy(b.setup), "", false,
              is_plane ? "J/m" : "J"};
  if (!is_plane) b.bounds.contact = b.wheel.law_residual;
  body_ = std::move(body);
  // Warnings about [motion] are replaced by those about the inputs.
  for (const auto* said : {&b.setup.warnings, &b.wheel.warnings})
    for (const std::string& text : *said)
      if (std::ranges::none_of(of_motion, [&](std::string_view words) {
            return text.find(words) != std::string::npos;
          }))
        warn(text);
  b.hub = velocities(values);
  b.parameters = values;
  make_integrator(b.largest_step);
  b.run->weigh(values);
  for (double* of_width : {&values.tyre_mass, &values.tyre_inertia}) *of_width *= values.width;
  b.parameters = values;
  warn_of_step(values, b.largest_step);
  const std::string wrong = make_steps(values, 1);
  Values first = values;
  b.run->fill(values.ground_height, values.width, first);
  first.hub_x = values.hub_x_start;
  first.hub_left = values.hub_left_start;
  first.hub_height = values.hub_height_start;
  first.hub_angle = first.yaw = 0.0;
  first.camber = values.camber_start;
  const Vec3 start{values.hub_x_start, values.hub_height_start - values.ground_height,
                   0.0 - values.hub_left_start};
  first.loaded_radius =
      dynamics::distance_in_space(*b.setup.model.contact, start) / std::cos(values.camber_start);
  values = first;
  b.run.reset();
  b.dt = 0.0;
  b.contact = {};
  warn_of_spin(values);
  if (!wrong.empty()) warn("a first step of the hub as it starts fails: " + wrong);
}

void Wheel::make_integrator(double dt) {
  Body& b = *body_;
  b.setup.model.dt = dt;
  b.run = led_wheel(b.setup, b.wheel, b.start, b.parameters);
  b.dt = dt;
}

double Wheel::first_step(double length) const {
  return length / std::ceil(length / body_->largest_step * (1.0 - 1e-9));
}

double Wheel::sectors_passed(const Values& values, double dt) const {
  const Body& b = *body_;
  const double spin = std::max(std::abs(b.hub.spin), std::abs(values.hub_angular_velocity));
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
  b.run->fill(values.ground_height, values.width, values);
  b.hub = velocities(values);
  const std::string late = study::late_friction_text(b.wheel.figures);
  if (!late.empty() && said_.insert("friction").second) warnings_.push_back(late);
  return {};
}

/// The hub's velocities change linearly from the last communication point to the given values.
std::string Wheel::make_steps(const Values& values, long long n) {
  Body& b = *body_;
  const rom::HubVelocity to = velocities(values);
  b.run->begin(b.hub);
  for (long long k = 1; k <= n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n);
    const dynamics::StepReport& made = b.run->step(k == n ? to : between(b.hub, to, share));
    b.contact.add(made.contact);
    if (std::string wrong = trouble(made); !wrong.empty()) return wrong;
  }
  return {};
}

std::string Wheel::trouble(const dynamics::StepReport& made) const {
  const Body& b = *body_;
  const study::OutOfBound found = study::find_out_of_bound(made.balance, b.contact, b.bounds);
  const std::string wrong = found.what.empty() ? b.run->misplaced(b.rim) : found.what;
  if (wrong.empty()) return {};
  return fmt::format("t = {:.9g} s of the wheel: {}", made.frame.time, wrong);
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
  s.hub = b.hub;
  if (b.dt > 0.0) s.state = b.run->save();
  return s;
}

/// If the state is from before the first step, or has other parameters, the wheel is made again, as
/// it was made at first.
void Wheel::restore(const SavedWheel& s, Values& values) {
  const BorrowedBlas blas;
  Values start = s.start;
  if (!s.state || !body_ || !same_parameters(dimension(), body_->parameters, start)) begin(start);
  Body& b = *body_;
  if (s.state) {
    if (b.dt != s.dt) make_integrator(s.dt);
    if (!study::is_saved(b.setup, b.wheel, s.state->ring))
      throw request_error("state", "", "is of another wheel", "one of this FMU");
    b.run->restore(*s.state);
  }
  b.contact = {};
  b.hub = s.hub;
  values = s.values;
}

}  // namespace rondo::fmu
