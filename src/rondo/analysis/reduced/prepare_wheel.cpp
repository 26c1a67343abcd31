// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/prepare_wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/elements/combinations.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/fem/contact_mass.hpp"

namespace rondo::study {
namespace {

constexpr double longest_step = 4e-4;      ///< chosen without a wish                     [s]
constexpr double fewest_passes = 1.618;    ///< steps in the pass of a sector
constexpr double beyond_whole = 0.618;     ///< so that nodes are seen at all their phases
constexpr double steps_in_contact = 20.0;  ///< while a node passes it
constexpr int few_modes_of_mesh = 20;
constexpr int most_modes = 40, most_modes_of_tread = 90, fewest_modes = 10;
/// A wheel in three dimensions takes so many where the ground is not flat.
constexpr int most_modes_on_bumps = 200;
constexpr double highest_mode = 1.5;      ///< ω Δt of the modes that are taken
constexpr double speed_from_rest = 60.0;  ///< that a wheel from rest may come to         [m/s]
constexpr double late_share = 0.01;       ///< steps whose friction is late: more are told
constexpr long long few_late = 5;         ///< and so few are not
constexpr double beyond_expected = 2.0;   ///< of the spin that is expected of a free one: known

double radius_of(const Setup& setup) {
  double radius = 0.0;
  for (const Vec2 x : setup.model.reference) radius = std::max(radius, norm(x));
  return radius;
}

/// How many contact nodes of a wheel with a width come by, one after the other, in a turn: those
/// of a sector that are beside each other count once.
double columns_around(const Setup& setup) {
  constexpr double beside = 0.1;  // of a sector: the twist of inflated cords is less
  std::vector<double> angles;
  for (const int node : setup.model.contact->nodes) {
    if (setup.mesh.sector[at(node)] != 0) continue;
    const Vec2 x = setup.model.reference[at(node)];
    angles.push_back(std::atan2(x.y, x.x));
  }
  std::ranges::sort(angles);
  const double pitch = 2.0 * std::numbers::pi / setup.mesh.n_sectors;
  int columns = angles.empty() ? 0 : 1;
  for (std::size_t i = 1; i < angles.size(); ++i)
    columns += angles[i] - angles[i - 1] > beside * pitch ? 1 : 0;
  return static_cast<double>(columns) * setup.mesh.n_sectors;
}

/// The spin that torque and ground let the wheel reach is known only afterwards: at least that of
/// free rolling is expected.
ExpectedContact expected(const Case& c, bool led, const Setup& setup) {
  ExpectedContact e;
  const double radius = radius_of(setup);
  e.spin = c.motion.angular_velocity.largest();
  if (c.rim && c.rim->free_spin) e.spin = std::max(e.spin, c.motion.speed.largest() / radius);
  e.speed = std::max(c.motion.speed.largest(), e.spin * radius);
  double lowest = radius;
  for (const auto& point : c.motion.height.points()) lowest = std::min(lowest, point[1]);
  const double top = setup.model.contact->ground.top();
  const double above = std::clamp(lowest - (std::isfinite(top) ? top : 0.0), 0.0, radius);
  const bool lowers_itself = led || (c.rim && c.rim->free_y);
  if (!lowers_itself) e.length = 2.0 * std::sqrt(radius * radius - above * above);
  const auto n_nodes = static_cast<double>(setup.model.contact->nodes.size());
  const bool sectors = setup.model.sector || setup.model.solid;
  const double around = setup.model.solid ? columns_around(setup) : n_nodes;
  e.spacing = 2.0 * std::numbers::pi * radius / around;
  if (e.length < e.spacing) e.length = 0.0;  // it may not touch at all
  const double n = sectors ? setup.mesh.n_sectors : n_nodes;
  if (e.spin > 0.0) e.pass = 2.0 * std::numbers::pi / n / e.spin;
  return e;
}

/// The step that is asked for, else one that sees contact and the nodes that pass it.
/// @param end of the run; of a wheel that is led, without a bound [s]
double step_of(double end, const RunOptions& options, const ExpectedContact& e) {
  if (options.reduced_step) {
    if (*options.reduced_step > 0.0 && *options.reduced_step <= end &&
        std::isfinite(*options.reduced_step))
      return *options.reduced_step;
    throw request_error(
        "--reduced-step", fmt::format("{:.9g}", *options.reduced_step),
        "is no step of a reduced wheel",
        fmt::format(
            "a number of seconds above 0{}, e.g. 0.0004; or no "
            "--reduced-step",
            std::isfinite(end) ? fmt::format(" and up to time.end = {:.6g}", end) : std::string()));
  }
  double step = longest_step;
  if (e.speed > 0.0 && e.length > 0.0)
    step = std::min(step, e.length / (steps_in_contact * e.speed));
  if (e.pass == 0.0) return step;
  const double passes = std::max(fewest_passes, e.pass / step);
  return e.pass / (std::max(1.0, std::ceil(passes - beyond_whole - 1e-9)) + beyond_whole);
}

/// The residual of the law of contact that is asked for.
double law_residual_of(const RunOptions& options, const Setup& setup) {
  constexpr double usual = 1e-6, least = 1e-12, most = 1e-3;
  if (!options.law_residual) return usual;
  const double asked = *options.law_residual;
  if (!setup.model.solid)
    throw request_error("--law-residual", fmt::format("{:.9g}", asked),
                        "is of a reduced wheel in three dimensions: that of a disk is solved to "
                        "round-off",
                        "no --law-residual");
  if (asked >= least && asked <= most) return asked;
  throw request_error("--law-residual", fmt::format("{:.9g}", asked),
                      "is no residual of the law of contact",
                      fmt::format("a number from {:g} to {:g}, e.g. 1e-6", least, most));
}

/// Spins of the residual: those of the tables; of a free or led spin well beyond what is expected,
/// as far as no spin there is critical.
rom::KnownSpins spins_of(const Case& c, std::optional<double> led, double expected, double radius) {
  if (led) return {0.0, *led, true};
  const bool free = c.rim && c.rim->free_spin;
  if (!free) return {expected, expected, c.motion.angular_velocity.points().size() > 1};
  return {expected, expected > 0.0 ? beyond_expected * expected : speed_from_rest / radius, true};
}

rom::ModeChoice modes_of(const RunOptions& options, const Setup& setup) {
  if (options.reduced_modes) {
    if (*options.reduced_modes < 0 || *options.reduced_modes > 100000)
      throw request_error("--modes", std::to_string(*options.reduced_modes),
                          "is no number of modes", "a whole number from 0 to 100000");
    if (!setup.model.sector && !setup.model.solid && *options.reduced_modes > most_modes_of_mesh)
      throw request_error("--modes", std::to_string(*options.reduced_modes),
                          "without equal sectors so many modes take too long to find",
                          fmt::format("a whole number from 0 to {}", most_modes_of_mesh));
    return {.wanted = static_cast<int>(*options.reduced_modes)};
  }
  const bool tread = setup.model.solid
                         ? columns_around(setup) > setup.mesh.n_sectors
                         : setup.model.sector && setup.mesh.boundary.size() >
                                                     static_cast<std::size_t>(setup.mesh.n_sectors);
  const dynamics::ContactModel& contact = *setup.model.contact;
  const bool bumps = setup.model.solid && (contact.space || !contact.ground.bends().empty());
  return {.wanted = bumps   ? most_modes_on_bumps
                    : tread ? most_modes_of_tread
                            : most_modes,
          .highest = highest_mode / setup.model.dt,
          .fewest = fewest_modes};
}

/// The first region whose branches are not those of [material] or, where no cell has these, not
/// those of the first cell. None: all cells have the same branches.
std::optional<std::size_t> unlike_region(const Case& c, const Setup& setup) {
  const auto branches = [&](std::size_t cell) -> const std::vector<fem::ViscousBranch>& {
    return fem::branches_of(fem::material_of(setup.mesh, setup.materials, cell));
  };
  bool alike = true, has_common = false;
  for (std::size_t e = 0; e < setup.mesh.n_elements(); ++e) {
    alike = alike && branches(e) == branches(0);
    has_common = has_common || branches(e) == fem::branches_of(c.material);
  }
  if (alike) return {};
  const auto& expected = has_common ? fem::branches_of(c.material) : branches(0);
  const auto found = std::ranges::find_if(c.regions, [&](const MaterialRegion& region) {
    return fem::branches_of(region.material) != expected;
  });
  RONDO_DEMAND(found != c.regions.end(), c.regions.size());
  return static_cast<std::size_t>(found - c.regions.begin());
}

/// Whether the branches of a wheel in three dimensions resist what its stiffness resists, up to the
/// order in which elements are summed. Cords and the inflation of a tyre do not creep, and branches
/// of rubber resist changes of shape alone.
bool all_creeps(const dynamics::SolidBody& body) {
  if (body.viscous.size() != 1) return false;
  const auto &all = body.sector.entries, &part = body.viscous.front().stiffness.entries;
  if (part.size() != all.size()) return false;
  double largest = 0.0, difference = 0.0;
  for (std::size_t e = 0; e < all.size(); ++e)
    for (std::size_t i = 0; i < all[e].block.size(); ++i) {
      largest = std::max(largest, std::abs(all[e].block[i]));
      difference = std::max(difference, std::abs(all[e].block[i] - part[e].block[i]));
    }
  return difference <= 1e-12 * largest;
}

/// The residual of a wheel creeps by one spectrum, which a body has whose branches are the same
/// everywhere.
void refuse_unlike_branches(const Case& c, const Setup& setup) {
  const std::optional<dynamics::SolidBody>& solid = setup.model.solid;
  if (solid ? solid->viscous.empty() : setup.model.viscous.empty()) return;
  const std::optional<std::size_t> region = unlike_region(c, setup);
  if (!region && solid && !all_creeps(*solid))
    throw case_error(
        c, "material",
        fmt::format("{}, and what no mode of a reduced wheel has can only creep as a whole",
                    !c.cords.empty() ? "the cords do not creep"
                    : c.inflation    ? "what the inflation resists does not creep"
                                     : "the branches resist changes of shape alone"),
        "no loss_factor and no viscosity, with [damping] in their place; or the full "
        "run, without --reduced; or steady rolling");
  if (!region) return;
  throw case_error(c, item_of("material.region", *region),
                   "regions differ in their viscous branches, and what no mode of a reduced wheel "
                   "has can only creep as a whole",
                   "no loss_factor and no viscosity of a region, and one for all of the body in "
                   "[material]; or the full run, without --reduced; or steady rolling");
}

void refuse(const Case& c, const Setup& setup) {
  refuse_combinations(c, setup.model, dynamics::has::reduced);
  if (!c.ground)
    throw case_error(c, "ground", "a reduced wheel is one of exact contact, and there is no ground",
                     "a [ground]; or the full run, without --reduced");
  refuse_unlike_branches(c, setup);
}

/// What a body that starts inside the ground does, contact nodes having no mass.
void tell_start(Setup& setup) {
  for (std::string& text : setup.warnings)
    if (const auto end = text.find(": contact keeps it from going deeper");
        end != std::string::npos)
      text.replace(end, std::string::npos,
                   ": contact nodes have no mass and are out of it after the first step, which "
                   "shakes the wheel; start above the ground or touching it");
}

/// The mass of contact nodes goes to their neighbours.
void move_masses(const Case& c, Setup& setup) {
  dynamics::Model& model = setup.model;
  fem::MovedMass moved = fem::move_contact_mass(setup.mesh, model.mass, model.contact->nodes);
  if (moved.without_neighbour >= 0) {
    const Vec2 x = model.reference[static_cast<std::size_t>(moved.without_neighbour)];
    throw case_error(
        c, c.mesh ? "mesh.contact" : "disk.mesh.radial",
        fmt::format("the contact node at ({:.4g}, {:.4g}) m has no free neighbour that "
                    "could carry its mass",
                    x.x, x.y),
        "at least two layers of elements");
  }
  model.lumped_mass = std::exchange(model.mass, std::move(moved.mass));
}

/// (n_local) What pressures and the state about which a wheel is linear do to each sector.
std::vector<Vec3> constant_load(const Case& c, const Setup& setup) {
  const dynamics::SolidBody& body = *setup.model.solid;
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    if (c.pressures[k].pressure.points().size() > 1)
      throw case_error(c, item_of("load.pressure", k) + ".value",
                       "is a table, and pressures on a reduced wheel stay as they are",
                       "a number; or the full run, without --reduced");
  std::vector<Vec3> load(body.pressures.empty() ? 0 : body.sector.n_local());
  for (const dynamics::SolidPressure& p : body.pressures)
    for (std::size_t a = 0; a < load.size(); ++a) load[a] += p.pressure.at(0.0) * p.force[a];
  return load;
}

void warn_of(const Case& c, const Setup& setup, bool led, PreparedWheel& w) {
  const ExpectedContact& e = w.expected;
  const double dt = setup.model.dt;
  const auto warn = [&](std::string text) { w.warnings.push_back(std::move(text)); };
  if (c.time.step)
    warn("time.step is that of the full run: the step of a reduced wheel is --reduced-step");
  if (e.length > 0.0 && e.length < 5.0 * e.spacing)
    warn(
        fmt::format("contact has {:.1f} nodes at the lowest motion.height: forces of fewer than 5 "
                    "nodes depend on where the nodes are; a finer mesh sees more",
                    e.length / e.spacing));
  if (w.whole && w.n_modes() < few_modes_of_mesh)
    warn(
        fmt::format("--modes {}: without equal sectors the inertia of all other modes is left out, "
                    "which fewer than {} do not make up for; 40 are usual",
                    w.n_modes(), few_modes_of_mesh));
  if (w.highest() * dt > 2.0)
    warn(
        fmt::format("the highest mode, of {:.5g} rad/s, turns by {:.2g} rad in a step, where 2 are "
                    "accurate: fewer --modes, or a smaller --reduced-step",
                    w.highest(), w.highest() * dt));
  if (!led && e.length > 0.0 && e.speed * dt > e.length / 12.0)
    warn(
        fmt::format("a step moves by {:.3g} m, of a contact of {:.3g} m: a --reduced-step of at "
                    "most {:.2g} s sees what happens within it",
                    e.speed * dt, e.length, e.length / 12.0 / e.speed));
  if (!led && e.pass > 0.0 && w.passes(dt) < 1.5)
    warn(
        fmt::format("{:.2g} steps in the pass of a {}: forces of fewer than 1.5 swing; a "
                    "--reduced-step of at most {:.2g} s",
                    w.passes(dt), w.passing(), e.pass / 1.618));
  if (w.solid && contact::falls_with_slip(c.ground->friction))
    warn(
        "ground.friction.slip_speed falls with the slip: contact nodes stick and slide in turn, "
        "the more the smaller the step, and friction may be off by several per cent: compare with "
        "another --reduced-step (--estimate), or with the full run, without --reduced");
  if (const double lowest = w.lowest(); w.solid && setup.model.mass_damping > lowest)
    warn(
        fmt::format("damping.mass = {:.4g} 1/s acts on the modes of a reduced wheel alone, and is "
                    "larger than the lowest one, of {:.4g} rad/s: more --modes feel it; or the "
                    "full run, without --reduced",
                    setup.model.mass_damping, lowest));
  if (!w.model.one_matrix.empty())
    warn(
        fmt::format("the material is so viscous at {:.4g} rad/s that in {} harmonics, from {} on, "
                    "the loss of what no mode has is that without its inertia: more --modes carry "
                    "more of it",
                    e.spin, w.model.one_matrix.size(), w.model.one_matrix.front()));
  for (const rom::RingResidual& r : w.model.residuals)
    if (!r.made_static.empty())
      return warn(
          fmt::format("at {:.4g} rad/s the mesh is beyond the critical spin of harmonic {}: "
                      "the inertia of what no mode has is left out of {} harmonics",
                      e.spin, r.made_static.front(), r.made_static.size()));
}

rom::WheelViscosity viscosity_of(const Setup& setup) {
  const dynamics::Model& model = setup.model;
  if (model.solid && !model.solid->viscous.empty())
    return {model.solid->viscous.front().branches, model.stiffness_damping};
  if (model.viscous.empty()) return {};
  return {model.viscous.front().branches, model.stiffness_damping};
}

rom::WholeMesh whole_of(const Setup& setup) {
  return {setup.mesh, setup.model.stiffness, setup.model.free};
}

/// A mesh without equal sectors has no convected form to leave out of.
void refuse_soft_mesh(const Case& c, const PreparedWheel& wheel) {
  const double spin = wheel.expected.spin;
  const auto& harmonics = wheel.model.harmonics;
  const bool stable = harmonics.empty() || harmonics[0].squares.minCoeff() > spin * spin;
  if (stable && std::ranges::all_of(wheel.model.residuals, [](const rom::RingResidual& r) {
        return r.made_static.empty();
      }))
    return;
  throw case_error(c, "motion.angular_velocity",
                   fmt::format("at {:.6g} rad/s the softening by the spin exceeds the stiffness of "
                               "the mesh, which has no reduced wheel there",
                               spin),
                   "a slower spin, or a stiffer body");
}

/// The modes of the file that is named, else those of the case.
std::vector<rom::RingHarmonic> harmonics_of(const Case& c, const RunOptions& options,
                                            const Setup& setup, PreparedWheel& wheel) {
  if (options.reduced.empty() || options.reduced == wheel_of_case) {
    const rom::ModeChoice choice = modes_of(options, setup);
    std::vector<rom::RingHarmonic> found =
        wheel.solid   ? rom::solid_modes(*wheel.solid, choice)
        : wheel.whole ? rom::whole_modes(*wheel.ring, whole_of(setup), choice)
                      : rom::ring_modes(*wheel.ring, choice);
    if (const int n = rom::count_modes(found); options.reduced_modes && n < choice.wanted)
      wheel.warnings.push_back(fmt::format("--modes {}: the wheel has {} modes", choice.wanted, n));
    return found;
  }
  if (options.reduced_modes)
    throw request_error(
        "--modes", std::to_string(*options.reduced_modes),
        "is of modes that are found in the run, not of those of a file",
        "rondo reduce CASE.toml --modes N -o wheel.h5; or --reduced without a file");
  if (wheel.solid)
    throw request_error("--reduced", options.reduced.string(),
                        "the modes of a wheel in three dimensions are not kept in a file",
                        "--reduced without a file: they are found in seconds");
  WheelFile file = read_wheel_file(options.reduced, c, setup, *wheel.ring);
  wheel.basis = file.basis;
  wheel.file = options.reduced.string();
  return std::move(file.harmonics);
}

}  // namespace

int PreparedWheel::n_modes() const {
  return rom::count_modes(model.harmonics);
}

double PreparedWheel::lowest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const rom::RingHarmonic& h : model.harmonics)
    least = std::min(least, h.squares.size() > 0 ? std::sqrt(h.squares.minCoeff()) : least);
  return least;
}

double PreparedWheel::highest() const {
  double most = 0.0;
  for (const rom::RingHarmonic& h : model.harmonics)
    most = std::max(most, h.squares.size() > 0 ? std::sqrt(h.squares.maxCoeff()) : 0.0);
  return most;
}

void begin_wheel(const Case& c, const RunOptions& options, std::optional<double> led, Setup& setup,
                 PreparedWheel& wheel) {
  refuse(c, setup);
  move_masses(c, setup);
  wheel.full_step = setup.model.dt;
  wheel.expected = expected(c, led.has_value(), setup);
  setup.model.dt =
      step_of(led ? std::numeric_limits<double>::infinity() : c.time.end, options, wheel.expected);
  setup.n_steps = count_steps(c, setup.model.dt);
  if (setup.model.solid) tell_start(setup);
  const dynamics::Model& model = setup.model;
  wheel.law_residual = law_residual_of(options, setup);
  if (model.solid) {
    wheel.solid.emplace(rom::make_solid_ring(model.solid->sector, model.mass, model.reference,
                                             model.solid->axial, model.contact->nodes));
    wheel.solid->load = constant_load(c, setup);
    wheel.solid->threads = model.threads;
    return;
  }
  if (!model.sector) wheel.whole = rom::one_sector(whole_of(setup));
  wheel.ring.emplace(rom::make_ring(wheel.whole ? *wheel.whole : *model.sector, model.mass,
                                    model.reference, model.contact->nodes));
}

void complete_wheel(const Case& c, std::optional<double> led,
                    std::vector<rom::RingHarmonic> harmonics, Setup& setup, PreparedWheel& wheel) {
  const rom::KnownSpins spins = spins_of(c, led, wheel.expected.spin, radius_of(setup));
  const rom::WheelViscosity viscosity = viscosity_of(setup);
  if (wheel.solid) {
    wheel.model = rom::make_solid_model(*wheel.solid, std::move(harmonics), spins, viscosity);
  } else if (wheel.whole) {
    const rom::WholeMesh whole = whole_of(setup);
    wheel.model =
        rom::make_wheel_model(*wheel.ring, std::move(harmonics), spins, &whole, viscosity);
    refuse_soft_mesh(c, wheel);
  } else {
    wheel.model =
        rom::make_wheel_model(*wheel.ring, std::move(harmonics), spins, nullptr, viscosity);
  }
  const std::string of_pod = wheel.basis == WheelBasis::pod
                                 ? fmt::format(" of a POD up to {:.17g} rad/s", wheel.highest())
                                 : std::string();
  const std::string residual =
      wheel.solid ? fmt::format(" and a residual of {:.9g}", wheel.law_residual) : std::string();
  setup.reduced = fmt::format("a reduced wheel of {} modes{} with a step of {:.17g} s{}",
                              wheel.n_modes(), of_pod, setup.model.dt, residual);
  setup.saved_numbers = wheel.solid
                            ? rom::SolidWheelRun::n_numbers(setup.model, *wheel.solid, wheel.model)
                            : rom::WheelRun::n_numbers(setup.model, *wheel.ring, wheel.model);
  warn_of(c, setup, led.has_value(), wheel);
}

std::unique_ptr<dynamics::Integrator> make_steps(const Setup& setup, PreparedWheel& wheel,
                                                 const dynamics::State& start) {
  if (wheel.solid)
    return std::make_unique<rom::SolidWheelRun>(setup.model, *wheel.solid, wheel.model,
                                                wheel.law_residual, wheel.figures, start);
  return std::make_unique<rom::WheelRun>(setup.model, *wheel.ring, wheel.model, wheel.figures,
                                         start);
}

bool is_saved(const Setup& setup, const PreparedWheel& wheel, std::span<const double> numbers) {
  return wheel.solid ? rom::SolidWheelRun::is_saved(setup.model, *wheel.solid, wheel.model, numbers)
                     : rom::WheelRun::is_saved(setup.model, *wheel.ring, wheel.model, numbers);
}

void prepare_wheel(const Case& c, const RunOptions& options, std::optional<double> led,
                   Setup& setup, PreparedWheel& wheel) {
  const OneBlasThread one;
  begin_wheel(c, options, led, setup, wheel);
  complete_wheel(c, led, harmonics_of(c, options, setup, wheel), setup, wheel);
}

std::string late_friction_text(const rom::WheelFigures& figures) {
  const auto late = static_cast<double>(figures.late_friction),
             steps = static_cast<double>(figures.contact_steps);
  if (figures.late_friction <= few_late || late <= late_share * steps) return {};
  return fmt::format(
      "ground.friction: in {:.2g} % of the steps in contact the coefficients are those by slip and "
      "pressure of the step before, because those of the step itself were not found: friction "
      "falls with the slip so that nodes stick and slip in turn; compare with another "
      "--reduced-step, or with the full run, without --reduced",
      100.0 * late / steps);
}

}  // namespace rondo::study
