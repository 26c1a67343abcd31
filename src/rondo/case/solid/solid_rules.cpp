// SPDX-License-Identifier: BSD-3-Clause
/// Rules of the parts of a wheel in three dimensions and of combinations that it excludes, as far
/// as the case shows them (docs/wheel3d.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/case/case_rules.hpp"
#include "rondo/case/solid/wheel_of.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view wheel = "a wheel in three dimensions";

/// Keys that have no use for a plane body.
void check_plane(CaseValues& in) {
  if (in.has("disk.width") || in.has_table("section")) return;  // has a fault
  for (const std::string_view key :
       {"disk.crown_radius", "disk.mesh.axial", "disk.tread.circumferential_grooves",
        "motion.slip_angle", "motion.camber", "motion.turn_slip"})
    if (in.has(key))
      in.refuse(key, fmt::format("applies to {} only, and the body is plane", wheel),
                "disk.width beside it, which gives the disk a width; or a [section]");
}

/// Grooves that cover the whole width would leave no tread.
void check_lateral_grooves(CaseValues& in, const Case& c) {
  constexpr std::string_view key = "disk.tread.groove_columns";
  if (is_generated(c) && c.disk.tread && c.wheel.grooves.empty() && in.has(key) &&
      c.disk.tread->groove_columns == 0)
    in.refuse(
        key, "leaves the tread without grooves",
        "1 to 100000; 0 only with disk.tread.circumferential_grooves, for a wheel with a width");
}

// The body --------------------------------------------------------------------------------------

void check_other_bodies(CaseValues& in) {
  if (!in.has_table("section")) return;
  for (const std::string_view other : {"disk", "mesh"})
    if (in.has_table(other))
      in.fault("section",
               fmt::format("is given together with [{}]: the body is one or the other", other),
               fmt::format("[{}] or [section]", other));
}

/// Lines of nodes must be distinct numbers at the size of the radius.
void check_width(CaseValues& in, const Case& c) {
  if (!in.good({"disk.width", "disk.outer_radius", "disk.mesh.axial"})) return;
  const double least = 1e-9 * c.wheel.axial * c.disk.outer_radius;
  if (*c.wheel.width < least)
    in.fault("disk.width",
             fmt::format("each of the {} elements over it would be {:.2g} m thin", c.wheel.axial,
                         *c.wheel.width / c.wheel.axial),
             fmt::format(">= {:.2g}; or no disk.width: a plane body", least));
}

void check_crown(CaseValues& in, const Case& c) {
  constexpr std::string_view key = "disk.crown_radius";
  if (!c.wheel.crown_radius ||
      !in.good({key, "disk.width", "disk.outer_radius", "disk.inner_radius"}))
    return;
  const double half = 0.5 * *c.wheel.width, radius = *c.wheel.crown_radius;
  const double wall =
      c.disk.outer_radius - c.disk.inner_radius - (c.disk.tread ? c.disk.tread->depth : 0.0);
  if (radius < half)
    return in.fault(key, "is less than half the width: the tread would bend back under the wheel",
                    fmt::format(">= disk.width / 2 = {:.6g}", half));
  const double drop = radius - std::sqrt(radius * radius - half * half);
  if (!(drop < wall))
    in.fault(key,
             fmt::format("the tread would come down by {:.4g} m towards the sides, and the wall is "
                         "{:.4g} m thick",
                         drop, wall),
             fmt::format("> {:.4g}, or a smaller disk.width",
                         (half * half + wall * wall) / (2.0 * wall)));
}

bool is_in(const std::vector<std::array<double, 2>>& grooves, double z) {
  return std::ranges::any_of(grooves, [z](const std::array<double, 2>& groove) {
    return std::abs(z - groove[0]) < 0.5 * groove[1];
  });
}

/// Whether something of the tread is left. @pre enough elements over the width
bool leaves_lands(const mesh::Wheel& w) {
  const std::vector<double> lines = mesh::axial_lines(w);
  for (std::size_t k = 1; k < lines.size(); ++k)
    if (!is_in(w.grooves, 0.5 * (lines[k - 1] + lines[k]))) return true;
  return false;
}

void check_grooves(CaseValues& in, const Case& c) {
  constexpr std::string_view key = "disk.tread.circumferential_grooves";
  if (c.wheel.grooves.empty() || !in.good({key, "disk.width", "disk.mesh.axial"})) return;
  const double half = 0.5 * *c.wheel.width;
  for (std::size_t k = 0; k < c.wheel.grooves.size(); ++k) {
    const auto& [z, width] = c.wheel.grooves[k];
    if (!(width > 0.0))
      in.fault_at_item(key, static_cast<int>(k), "the groove has no width: [z, width], width > 0");
    else if (!(std::abs(z) < half))
      in.fault_at_item(key, static_cast<int>(k),
                       fmt::format("the groove lies beside the wheel: its middle z is above "
                                   "{:.4g} and below {:.4g} m",
                                   -half, half));
  }
  if (!in.good({key})) return;
  const mesh::Wheel w = wheel_of(c);
  if (const int least = mesh::least_axial(w); c.wheel.axial < least)
    in.fault("disk.mesh.axial",
             "the sides of the grooves around the wheel are faces of elements, which are too few",
             fmt::format(">= {}", least));
  else if (!leaves_lands(w))
    in.fault(key, "the grooves leave nothing of the tread", "lands between them");
}

/// The nodes of the mesh must be counted by int.
void check_solid_size(CaseValues& in, const Case& c) {
  if (!in.good({"disk.mesh.radial", "disk.mesh.circumferential", "disk.mesh.axial",
                "disk.tread.pitches", "disk.tread.land_columns", "disk.tread.groove_columns",
                "disk.tread.layers"}))
    return;
  constexpr std::size_t most_nodes = std::size_t{1} << 31;
  const std::size_t plane = mesh::n_disk_nodes(c.disk);
  if (plane < most_nodes && n_generated_nodes(c) >= most_nodes)
    in.fault(in.has("disk.mesh.axial") ? "disk.mesh.axial" : largest_count(c.disk),
             fmt::format("the mesh would have {} nodes", n_generated_nodes(c)),
             fmt::format("fewer than {} nodes", most_nodes));
}

void check_body(CaseValues& in, const Case& c) {
  check_other_bodies(in);
  if (c.section) return;
  check_width(in, c);
  check_crown(in, c);
  check_grooves(in, c);
  check_solid_size(in, c);
}

// Excluded combinations -------------------------------------------------------------------------

void check_start(CaseValues& in, const Case& c) {
  if (c.initial.state == InitialState::steady_rolling)
    in.refuse("initial.state",
              fmt::format("a start in steady rolling is for plane bodies, not for {}", wheel),
              "\"stationary\", and a run long enough to settle");
  constexpr std::string_view gradient = "initial.displacement_gradient";
  for (const auto& row : c.initial.displacement_gradient)
    if (row[0] != 0.0 || row[1] != 0.0)
      return in.refuse(gradient, fmt::format("is for plane bodies, not for {}", wheel),
                       "no such key; initial.velocity sets it in motion");
}

/// Combinations that a rim moved by loads excludes: see model/solid/solid_rim.hpp.
void check_solid_rim(CaseValues& in, const Case& c) {
  if (!c.rim) return;
  if (c.rim->free_x && c.motion.slip_angle.largest() != 0.0)
    in.refuse("motion.slip_angle",
              "with rim.free = \"speed\" the lateral speed of the wheel is undetermined",
              "0; or a speed that is held: rim.free without \"speed\"");
  if (c.rim->free_y && c.motion.camber != 0.0 && !c.pressures.empty())
    in.refuse(
        "motion.camber",
        "with rim.free = \"height\" and a [[load.pressure]] the force of the pressure on the rim "
        "along the axle has a part that lifts or presses the wheel, and that force is not known",
        "0; or no [[load.pressure]]; or a height that is held");
}

void check_probes(CaseValues& in, const Case& c) {
  if (!c.output.probes.empty())
    in.fault("output.probe[0]", fmt::format("probes are for plane bodies, not for {}", wheel),
             "no [[output.probe]]; output.snapshots have every node");
}

/// A crush presses a wheel by the means of steady rolling: it stands, so that one sample a sector
/// has all of it, and nothing is accelerated.
void stand_still(Case& c) {
  c.analysis.samples_per_sector = 1;
  c.analysis.massless_contact = false;
  c.analysis.inertia = RollingMasses::none;
}

}  // namespace

void check_solid(CaseValues& in, Case& c) {
  check_lateral_grooves(in, c);
  if (!is_solid(c)) {
    check_other_bodies(in);
    return check_plane(in);
  }
  if (c.analysis.kind == AnalysisKind::crush) stand_still(c);
  check_body(in, c);
  check_start(in, c);
  check_solid_rim(in, c);
  check_probes(in, c);
}

}  // namespace rondo::study
