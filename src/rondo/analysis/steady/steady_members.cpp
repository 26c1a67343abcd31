// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_members.hpp"

#include <cmath>
#include <string_view>

#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/steady/steady.hpp"
#include "rondo/core/ground_frame.hpp"

namespace rondo::study {
namespace {

constexpr JsonMember<double> harmonics_rows[] = {
    {"harmonics_wall_s", "number", "s", "Wall time of the harmonics of the body",
     [](const double& seconds) -> Json { return seconds; }},
};

/// Forces, height and speed, or their derivatives.
struct Sloped {
  const statics::RollingForces& f;
  GroundMoments iso;
  double height, speed;
  bool solid;
};
Json of_solid(const Sloped& s, double value) {
  return s.solid ? Json(value) : absent();
}
constexpr JsonMember<Sloped> slope_rows[] = {
    {"force_x", "number", "", "Derivative of `force_x`",
     [](const Sloped& s) -> Json { return s.f.heading; }},
    {"force_y", "number", "", "Derivative of `force_y`",
     [](const Sloped& s) -> Json { return s.f.normal; }},
    {"force_lateral", "number", "", "Derivative of `force_lateral`, of a 3D wheel",
     [](const Sloped& s) { return of_solid(s, s.f.lateral); }},
    {"torque", "number", "", "Derivative of `torque`",
     [](const Sloped& s) -> Json { return s.f.torque; }},
    {"moment_aligning", "number", "", "Derivative of `moment_aligning`, of a 3D wheel",
     [](const Sloped& s) { return of_solid(s, s.f.aligning); }},
    {"moment_overturning", "number", "", "Derivative of `moment_overturning`, of a 3D wheel",
     [](const Sloped& s) { return of_solid(s, s.f.overturning); }},
    {"moment_aligning_iso", "number", "", "Derivative of `moment_aligning_iso`, of a 3D wheel",
     [](const Sloped& s) { return of_solid(s, s.iso.aligning); }},
    {"moment_overturning_iso", "number", "",
     "Derivative of `moment_overturning_iso`, of a 3D wheel",
     [](const Sloped& s) { return of_solid(s, s.iso.overturning); }},
    {"height", "number", "", "Derivative of `height`",
     [](const Sloped& s) -> Json { return s.height; }},
    {"speed", "number", "", "Derivative of `speed`",
     [](const Sloped& s) -> Json { return s.speed; }},
};

GroundMoments iso_of(const SteadyFigures& k, const statics::RollingForces& f, double height) {
  return GroundFrame(k.c.motion.camber)
      .about_contact_centre({f.aligning, f.overturning}, {f.heading, f.normal, f.lateral}, height);
}

/// The height matters to the moments about the contact centre beside the forces.
GroundMoments iso_slope_of(const SteadyFigures& k, const statics::RollingSlope& slope) {
  const statics::RollingForces& f = k.s.forces;
  const GroundMoments by_forces = iso_of(k, slope.forces, k.s.height),
                      by_height =
                          iso_of(k, {.normal = f.normal, .heading = f.heading}, slope.height);
  return {by_forces.aligning + by_height.aligning, by_forces.overturning + by_height.overturning};
}

Json slope_of(const SteadyFigures& k, const statics::RollingSlope& slope) {
  return object_of(slope_rows,
                   {slope.forces, iso_slope_of(k, slope), slope.height, slope.speed, k.solid});
}
/// No force depends on how fast the wheel turns.
bool has_no_rate(const Case& c) noexcept {
  return c.analysis.inertia == RollingMasses::none && c.damping.mass == 0.0 &&
         c.damping.stiffness == 0.0;
}

constexpr JsonMember<SteadyFigures> slopes_rows[] = {
    {"by_friction", "object", "", "By `ground.friction`, or the coefficient of its table",
     [](const SteadyFigures& k) { return slope_of(k, k.s.slopes.by_friction); },
     [] { return texts_of(slope_rows); }},
    {"by_load", "object", "", "By the load, where that is given",
     [](const SteadyFigures& k) {
       return k.c.analysis.load ? slope_of(k, k.s.slopes.by_height) : absent();
     }},
    {"by_height", "object", "", "By the height, where that is given",
     [](const SteadyFigures& k) {
       return k.c.analysis.load ? absent() : slope_of(k, k.s.slopes.by_height);
     }},
    {"by_torque", "object", "", "By the torque, where that is given",
     [](const SteadyFigures& k) {
       return k.c.analysis.torque ? slope_of(k, k.s.slopes.by_speed) : absent();
     }},
    {"by_traction", "object", "", "By the traction, where that is given",
     [](const SteadyFigures& k) {
       const bool is_given = k.c.analysis.traction && !k.c.analysis.torque;
       return is_given ? slope_of(k, k.s.slopes.by_speed) : absent();
     }},
    {"by_speed", "object", "", "By the speed, where that is given",
     [](const SteadyFigures& k) {
       const bool is_given = !k.c.analysis.traction && !k.c.analysis.torque;
       return is_given ? slope_of(k, k.s.slopes.by_speed) : absent();
     }},
    {"by_slip_angle", "object", "", "By the slip angle, of a 3D wheel",
     [](const SteadyFigures& k) {
       return k.solid ? slope_of(k, k.s.slopes.by_slip_angle) : absent();
     }},
    {"by_turn_slip", "object", "", "By the turn slip, of a 3D wheel",
     [](const SteadyFigures& k) {
       return k.solid ? slope_of(k, k.s.slopes.by_turn_slip) : absent();
     }},
};

/// What a table of friction alone has.
template <class Value>
Json of_law(const SteadyFigures& k, Value value) {
  return k.s.pairs.empty() ? absent() : Json(value);
}
std::string_view branch_of(const statics::FrictionEffort& f) {
  if (f.steps == 0) return "near";
  return f.steps == 1 ? "direct" : "continued";
}

constexpr JsonMember<statics::RollingPower> power_rows[] = {
    {"drive", "number", "W/m",
     "Given by speed, spin and yaw against the forces of the ground: V F_x + s T, of a 3D wheel "
     "V·F + s T + φ V M_n",
     [](const statics::RollingPower& p) -> Json { return p.drive; }},
    {"mass", "number", "W/m", "Taken by mass damping",
     [](const statics::RollingPower& p) -> Json { return p.mass; }},
    {"stiffness", "number", "W/m", "Taken by stiffness damping",
     [](const statics::RollingPower& p) -> Json { return p.stiffness; }},
    {"viscosity", "number", "W/m", "Taken by the viscous branches of the material",
     [](const statics::RollingPower& p) -> Json { return p.viscosity; }},
    {"friction", "number", "W/m", "Taken by friction",
     [](const statics::RollingPower& p) -> Json { return p.friction; }},
    {"weight", "number", "W/m", "Given by the weight along the deformation",
     [](const statics::RollingPower& p) -> Json { return p.weight; }},
    {"scheme", "number", "W/m",
     "Difference between the slip of the law and the velocity of the field",
     [](const statics::RollingPower& p) -> Json { return p.scheme; }},
    {"residual", "number", "",
     "drive + mass + stiffness + viscosity + friction − weight − scheme, over the largest of them",
     [](const statics::RollingPower& p) -> Json { return p.residual; }},
};

/// What a viscous part of the body takes.
struct PartPower {
  const std::string& name;
  double power;
};
constexpr JsonMember<PartPower> part_rows[] = {
    {"region", "string", "", "Name of the region; \"material\": what is in none",
     [](const PartPower& p) -> Json { return p.name; }},
    {"power", "number", "W/m", "Taken by its branches",
     [](const PartPower& p) -> Json { return p.power; }},
};

Json part_powers(const SteadyFigures& k) {
  std::vector<PartPower> all;
  for (std::size_t p = 0; p < k.parts.size(); ++p) all.push_back({k.parts[p], k.power.by_part[p]});
  return objects_of(part_rows, all);
}

/// Differences, and whether they are those of a wheel in three dimensions.
struct OfSlip {
  const SlipError& e;
  bool solid;
};
constexpr JsonMember<OfSlip> slip_error_rows[] = {
    {"force_x", "number", "N/m", "Of `force_x`",
     [](const OfSlip& s) -> Json { return s.e.difference.heading; }},
    {"force_lateral", "number", "N", "Of `force_lateral`, of a 3D wheel",
     [](const OfSlip& s) { return s.solid ? Json(s.e.difference.lateral) : absent(); }},
    {"moment_aligning", "number", "N·m", "Of `moment_aligning`, of a 3D wheel",
     [](const OfSlip& s) { return s.solid ? Json(s.e.difference.aligning) : absent(); }},
    {"share", "number", "", "Of the force along the ground, over the mean of both",
     [](const OfSlip& s) { return std::isfinite(s.e.share) ? Json(s.e.share) : absent(); }},
};

Json solid_only(const SteadyFigures& k, double value) {
  return k.solid ? Json(value) : absent();
}
Json plane_only(const SteadyFigures& k, const Json& value) {
  return k.solid ? absent() : value;
}
constexpr JsonMember<SteadyFigures> figures_rows[] = {
    {"force_x", "number", "N/m", "Force of the ground on the body, along x",
     [](const SteadyFigures& k) -> Json { return k.s.forces.heading; }},
    {"force_y", "number", "N/m", "Force of the ground on the body, along its normal",
     [](const SteadyFigures& k) -> Json { return k.s.forces.normal; }},
    {"force_lateral", "number", "N/m", "Force of the ground on a 3D wheel, to the right",
     [](const SteadyFigures& k) { return solid_only(k, k.s.forces.lateral); }},
    {"torque", "number", "N·m/m",
     "Torque on the rim, clockwise, that maintains the spin: > 0 drives towards +x",
     [](const SteadyFigures& k) -> Json { return k.s.forces.torque; }},
    {"moment_aligning", "number", "N·m/m",
     "Moment of the ground on a 3D wheel about the normal of the ground through the center",
     [](const SteadyFigures& k) { return solid_only(k, k.s.forces.aligning); }},
    {"moment_overturning", "number", "N·m/m",
     "Moment of the ground on a 3D wheel about the heading, in the ground below the center",
     [](const SteadyFigures& k) { return solid_only(k, k.s.forces.overturning); }},
    {"moment_aligning_iso", "number", "N·m/m",
     "`moment_aligning` about the contact centre of ISO 8855, where the line in the plane of the "
     "wheel from its center down meets the ground",
     [](const SteadyFigures& k) {
       return solid_only(k, iso_of(k, k.s.forces, k.s.height).aligning);
     }},
    {"moment_overturning_iso", "number", "N·m/m", "`moment_overturning`, likewise",
     [](const SteadyFigures& k) {
       return solid_only(k, iso_of(k, k.s.forces, k.s.height).overturning);
     }},
    {"height", "number", "m", "Height of the center, given or found",
     [](const SteadyFigures& k) -> Json { return k.height; }},
    {"speed", "number", "m/s", "Speed of the center, given or found",
     [](const SteadyFigures& k) -> Json { return k.s.speed; }},
    {"slip_ratio", "number", "", "Slip ratio, as in `history.csv`",
     [](const SteadyFigures& k) -> Json { return k.slip_ratio; }},
    {"slip_angle", "number", "rad", "Slip angle of a 3D wheel",
     [](const SteadyFigures& k) { return solid_only(k, k.c.motion.slip_angle.at(0.0)); }},
    {"camber", "number", "rad", "Camber of a 3D wheel",
     [](const SteadyFigures& k) { return solid_only(k, k.c.motion.camber); }},
    {"turn_slip", "number", "1/m", "Turn slip of a 3D wheel: `motion.turn_slip`",
     [](const SteadyFigures& k) { return solid_only(k, k.c.analysis.turn_slip); }},
    {"rolling_resistance", "number", "N/m",
     "Rolling resistance: power lost over speed, (ω `torque` − V `force_x`) / |V|: −`force_x` if "
     "the torque is 0 and V "
     "> 0; of a 3D wheel (ω `torque` − V·F − φ V `moment_aligning`) / |V|; null at speed 0",
     [](const SteadyFigures& k) -> Json { return k.resistance; }},
    {"stick_length", "number", "m", "Sum of the deformed boundary lengths of the nodes that stick",
     [](const SteadyFigures& k) { return plane_only(k, k.mean.stick); }},
    {"stick_area", "number", "m2",
     "Sum of the deformed areas of the nodes of a 3D wheel that stick",
     [](const SteadyFigures& k) { return solid_only(k, k.mean.stick); }},
    {"slip_length", "number", "m", "Sum of the deformed boundary lengths of the nodes that slip",
     [](const SteadyFigures& k) { return plane_only(k, k.mean.slip); }},
    {"slip_area", "number", "m2", "Sum of the deformed areas of the nodes of a 3D wheel that slip",
     [](const SteadyFigures& k) { return solid_only(k, k.mean.slip); }},
    {"footprint_length", "number", "m",
     "Extent along its heading of the deformed surface of a 3D wheel in contact, as "
     "`footprint_length_m` in `history.csv`",
     [](const SteadyFigures& k) { return solid_only(k, k.mean.length); }},
    {"footprint_width", "number", "m", "Likewise across: `footprint_width_m`",
     [](const SteadyFigures& k) { return solid_only(k, k.mean.width); }},
    {"pressure_mean", "number", "Pa",
     "`force_y` over the deformed area of a 3D wheel in contact, `stick_area` + `slip_area`",
     [](const SteadyFigures& k) {
       return solid_only(k, k.s.forces.normal / (k.mean.stick + k.mean.slip));
     }},
    {"pressure_max", "number", "Pa", "Largest pressure of all samples, over the deformed boundary",
     [](const SteadyFigures& k) -> Json { return k.mean.pressure; }},
    {"shear_max", "number", "Pa", "Largest shear of all samples, over the deformed boundary",
     [](const SteadyFigures& k) -> Json { return k.mean.shear; }},
    {"slopes", "object", "",
     "Derivatives with respect to what is given, in SI units, each with the same members; with "
     "`inflation.nonlinear` only without inertia (`analysis.inertia`) and `[damping]`, which the "
     "tangent of the last step leaves out",
     [](const SteadyFigures& k) {
       return !k.finite || has_no_rate(k.c) ? object_of(slopes_rows, k) : absent();
     },
     [] { return texts_of(slopes_rows); }},
    {"power", "object", "", "Balance of powers",
     [](const SteadyFigures& k) { return object_of(power_rows, k.power); },
     [] { return texts_of(power_rows); }},
    {"viscous_power", "array", "", "What of `viscosity` of `power` each region takes",
     [](const SteadyFigures& k) { return k.parts.empty() ? absent() : part_powers(k); },
     [] { return texts_of(part_rows); }},
    {"scheme_share", "number", "",
     "|`scheme`| of `power` over the largest of `drive`, damping (`mass` + `stiffness` + "
     "`viscosity`) and `friction`; 0 if it is round-off",
     [](const SteadyFigures& k) -> Json { return k.power.scheme_share; }},
    {"slip_error", "object", "",
     "Values with `analysis.slip` = \"upwind\" less those with \"bdf2\": a measure of the error of "
     "the discretisation",
     [](const SteadyFigures& k) {
       return k.slip_error ? object_of(slip_error_rows, {*k.slip_error, k.solid}) : absent();
     },
     [] { return texts_of(slip_error_rows); }},
    {"friction_branch", "string", "",
     "With a table of `ground.friction`, how the state was reached: \"direct\", in one step from "
     "that of the constant coefficient, or \"continued\", in steps of the departure from it, which "
     "a factor that falls with the slip speed takes, as there may be several states; \"near\": "
     "with `inflation.nonlinear`, from one under other inner forces, which was reached so",
     [](const SteadyFigures& k) {
       return k.s.pairs.empty() ? absent() : Json(branch_of(k.s.friction));
     }},
    {"friction_steps", "integer", "", "Steps from the constant coefficient to the table",
     [](const SteadyFigures& k) { return of_law(k, k.s.friction.steps); }},
    {"friction_restarts", "integer", "", "Of these, how many were restarted with half the step",
     [](const SteadyFigures& k) { return of_law(k, k.s.friction.restarts); }},
    {"friction_change", "number", "",
     "Largest difference between a coefficient and that of the slip speed and the pressure which "
     "it "
     "leads to, bound 1e-10",
     [](const SteadyFigures& k) { return of_law(k, k.s.friction.change); }},
    {"friction_min", "number", "", "Smallest coefficient of friction of a node in contact",
     [](const SteadyFigures& k) { return of_law(k, k.mean.least_friction); }},
    {"friction_max", "number", "", "Largest coefficient of friction of a node in contact",
     [](const SteadyFigures& k) { return of_law(k, k.mean.most_friction); }},
    {"residual", "number", "", "Residual of the contact law, over the largest force",
     [](const SteadyFigures& k) -> Json { return k.s.residual; }},
    {"balance_residual", "number", "",
     "With `inflation.nonlinear`: the largest force by which a node is out of balance, over the "
     "load",
     [](const SteadyFigures& k) { return k.finite ? Json(k.finite->residual) : absent(); }},
    {"contact_problems", "integer", "",
     "With `inflation.nonlinear`: problems of contact that were solved until the forces balanced",
     [](const SteadyFigures& k) { return k.finite ? Json(k.finite->turns) : absent(); }},
    {"newton_steps", "integer", "", "Newton steps of the solver",
     [](const SteadyFigures& k) -> Json { return k.s.effort.newton_steps; }},
    {"pivots", "integer", "", "Pivots of the solver",
     [](const SteadyFigures& k) { return plane_only(k, k.s.effort.pivots); }},
    {"sweeps", "integer", "", "Sweeps of the solver of a 3D wheel",
     [](const SteadyFigures& k) { return k.solid ? Json(k.s.effort.sweeps) : absent(); }},
    {"pairs", "integer", "", "Pairs of a contact node and a sample that were considered",
     [](const SteadyFigures& k) -> Json { return k.pairs; }},
    {"samples_per_sector", "integer", "", "Samples of the pass of a sector",
     [](const SteadyFigures& k) -> Json { return k.c.analysis.samples_per_sector; }},
};
constexpr JsonMember<SteadyFigures> state_rows[] = {
    {"steady", "object", "", "Means over the pass of a sector",
     [](const SteadyFigures& k) { return object_of(figures_rows, k); },
     [] { return texts_of(figures_rows); }},
};

}  // namespace

void describe_steady(double harmonics_s, double solve_s, Json& json) {
  add_members(harmonics_rows, harmonics_s, json);
  add_solve_wall(solve_s, json);
}

void add_steady(const SteadyFigures& figures, Json& json) {
  add_members(state_rows, figures, json);
}

std::vector<MemberText> steady_members() {
  return joined({texts_of(harmonics_rows), texts_of(state_rows), slip_step_members()});
}

}  // namespace rondo::study
