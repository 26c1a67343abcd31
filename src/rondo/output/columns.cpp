// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/columns.hpp"

#include <array>

namespace rondo::study {
namespace {

using H = HistoryRecord;
using P = ContactRecord;

constexpr std::array history{
    Column<H>{"time_s", "s", "end of the interval", [](const H& r) { return r.time; }},
    Column<H>{
        "angle_rad", "rad",
        "∫ω dt, by which the rim has turned, > 0 clockwise like `motion.angular_velocity` "
        "(−θ, `/frame/angle`); where nothing is constrained, the mean rotation of the first body, "
        "likewise",
        [](const H& r) { return 0.0 - r.angle; }},  // avoids -0
    Column<H>{
        "center_x_m", "m",
        "center, fixed frame; where nothing is constrained, the center of mass of the first body",
        [](const H& r) { return r.center.x; }},
    Column<H>{"center_y_m", "m", "likewise", [](const H& r) { return r.center.y; }},
    Column<H>{"force_x", "N/m", "of the ground on the body, mean over the interval",
              [](const H& r) { return r.force.x; }},
    Column<H>{"force_y", "N/m", "likewise", [](const H& r) { return r.force.y; }},
    Column<H>{
        "torque", "N·m/m",
        "of the ground on the body about the center, > 0 counter-clockwise, mean over the interval",
        [](const H& r) { return r.torque; }},
    Column<H>{"contact_nodes", "1",
              "of the nodes that may touch, those with a normal force; at sharp corners of the "
              "ground each contact with one counts: a corner on an edge, and each facet of a node "
              "beside it",
              [](const H& r) { return static_cast<double>(r.nodes); }},
    Column<H>{"sticking_nodes", "1", "of these, those that stick",
              [](const H& r) { return static_cast<double>(r.sticking); }},
    Column<H>{"contact_length_m", "m",
              "of the deformed boundary: half of the edges beside each node with a normal force, "
              "summed; `nan` in the last row of a run that failed",
              [](const H& r) { return r.contact_length; }},
    Column<H>{"penetration_max_m", "m",
              "largest depth of a contact node in the ground in the interval; at the row's time "
              "also of corners and arcs of the ground in the body, behind the straight line from "
              "one contact node to the next",
              [](const H& r) { return r.penetration; }},
    Column<H>{
        "slip_ratio", "1",
        "(ωRₒ − V) / max(|V|, |ωRₒ|); 0 where both vanish, and where nothing is constrained. Rₒ of "
        "a mesh: the largest distance of a contact node from the center; V of a wheel in three "
        "dimensions: along t1",
        [](const H& r) { return r.slip_ratio; }},
    Column<H>{"kinetic", "J/m",
              "kinetic part of the energy E, half a step before `time_s`, with the scheme `hati` "
              "at `time_s`; with a `[rim]` of absolute velocities, without the rim's own",
              [](const H& r) { return r.balance.kinetic; }},
    Column<H>{"strain", "J/m", "strain part of the energy E, likewise",
              [](const H& r) { return r.balance.strain; }},
    Column<H>{
        "work_frame", "J/m",
        "of the inertia of the frame and of gravity; 0 with a `[rim]`. All works are cumulative "
        "from the start",
        [](const H& r) { return r.balance.works.frame; }},
    Column<H>{"work_contact", "J/m",
              "of the ground's impulses: `work_rim` − `dissipation_friction` − `loss_impact`",
              [](const H& r) { return r.balance.works.contact; }},
    Column<H>{"dissipation_friction", "J/m", "by friction",
              [](const H& r) { return r.balance.works.dissipation_friction; }},
    Column<H>{"loss_impact", "J/m", "in impacts",
              [](const H& r) { return r.balance.works.loss_impact; }},
    Column<H>{"work_rim", "J/m", "of the rim against the ground's impulses; 0 with a `[rim]`",
              [](const H& r) { return r.balance.works.rim; }},
    Column<H>{"dissipation_mass", "J/m", "by `damping.mass`",
              [](const H& r) { return r.balance.works.dissipation_mass; }},
    Column<H>{"dissipation_stiffness", "J/m", "by `damping.stiffness`",
              [](const H& r) { return r.balance.works.dissipation_stiffness; }},
    Column<H>{
        "work_scheme", "J/m",
        "created by the scheme `as-printed`; with a `[rim]` what the central differences of a "
        "turning body leave, of third order in a step; of a reduced wheel what the distances of "
        "its "
        "law differ from the work of the forces; else 0",
        [](const H& r) { return r.balance.works.scheme; }},
    Column<H>{"energy_residual", "J/m", "energy less all works: what the energy balance leaves",
              [](const H& r) { return r.balance.residual; }},
    Column<H>{"work_load", "J/m", "of pressures", [](const H& r) { return r.balance.works.load; }}};

constexpr std::array rim{
    Column<H>{
        "spin_rad_s", "rad/s",
        "angular velocity of the rim at `time_s`, > 0 clockwise: mean of the half steps before "
        "and after",
        [](const H& r) { return r.rim.spin; }},
    Column<H>{"speed_x", "m/s", "velocity of the center, likewise",
              [](const H& r) { return r.rim.velocity.x; }},
    Column<H>{"speed_y", "m/s", "likewise", [](const H& r) { return r.rim.velocity.y; }},
    Column<H>{
        "hub_force_x", "N/m",
        "of what holds the rim's center along x, on the rim, mean over the interval; from the "
        "ground's `force_x` it differs by the inertia and the weight of body and rim. 0 where "
        "`rim.free` has \"speed\": nothing holds it",
        [](const H& r) { return r.rim.force.x; }},
    Column<H>{
        "hub_force_y", "N/m",
        "likewise along y; 0 where `rim.free` has \"height\": then `rim.force_y`, gravity and "
        "supports are the load",
        [](const H& r) { return r.rim.force.y; }},
    Column<H>{"hub_torque", "N·m/m",
              "that holds the spin, > 0 drives towards +x, mean over the interval; 0 where "
              "`rim.free` has \"angular_velocity\"",
              [](const H& r) { return r.rim.torque; }},
    Column<H>{"kinetic_rim", "J/m", "kinetic energy of the rim with what is bonded to it",
              [](const H& r) { return r.balance.kinetic_rim; }},
    Column<H>{"support_energy", "J/m", "of the springs of `[rim.support]`",
              [](const H& r) { return r.balance.support; }},
    Column<H>{"work_gravity", "J/m", "of gravity on body and rim",
              [](const H& r) { return r.balance.works.gravity; }},
    Column<H>{"work_rim_load", "J/m", "of `rim.force_x` and `rim.force_y`",
              [](const H& r) { return r.balance.works.rim_load; }},
    Column<H>{"work_torque", "J/m", "of `rim.torque`",
              [](const H& r) { return r.balance.works.torque; }},
    Column<H>{"work_held", "J/m", "of what holds speed, height or spin as `[motion]` says",
              [](const H& r) { return r.balance.works.held; }},
    Column<H>{"dissipation_brake", "J/m", "by `rim.brake`",
              [](const H& r) { return r.balance.works.dissipation_brake; }},
    Column<H>{"dissipation_support", "J/m", "by the dashpots of `[rim.support]`",
              [](const H& r) { return r.balance.works.dissipation_support; }}};

/// Over the deformed surface; 0: nothing touches, NaN: its area is not known.
double mean_pressure(const H& r) {
  return r.contact_length == 0.0 ? 0.0 : r.force.y / r.contact_length;
}

constexpr std::array solid{
    Column<H>{"force_lateral", "N/m",
              "of the ground on the wheel along t2, to the right of its heading, mean over the "
              "interval",
              [](const H& r) { return r.force.z; }},
    Column<H>{"moment_aligning", "N·m/m",
              "of the ground on the wheel about the ground's normal through the center, likewise",
              [](const H& r) { return r.moment_aligning; }},
    Column<H>{"moment_overturning", "N·m/m",
              "about t1, along the heading, in the ground below the center, likewise",
              [](const H& r) { return r.moment_overturning; }},
    Column<H>{"moment_aligning_iso", "N·m/m",
              "`moment_aligning` about the contact centre of ISO 8855, where the line in the plane "
              "of the wheel from its center down meets the ground",
              [](const H& r) { return r.moments_iso.aligning; }},
    Column<H>{"moment_overturning_iso", "N·m/m", "`moment_overturning`, likewise",
              [](const H& r) { return r.moments_iso.overturning; }},
    Column<H>{"slip_angle", "rad", "`motion.slip_angle` at `time_s`",
              [](const H& r) { return r.slip_angle; }},
    Column<H>{"center_lateral", "m", "center, along t2", [](const H& r) { return r.center.z; }},
    Column<H>{"footprint_length_m", "m",
              "extent along t1 of the deformed surface in contact, gaps included: from the first "
              "to the last node with a normal force and half of the edges beside them, as "
              "`contact_area_m2` counts them; 0 where nothing touches",
              [](const H& r) { return r.footprint_length; }},
    Column<H>{"footprint_width_m", "m", "likewise across, along t2",
              [](const H& r) { return r.footprint_width; }},
    Column<H>{"pressure_mean_pa", "Pa",
              "`force_y` over `contact_area_m2`, in steps in time the mean force of the interval "
              "over the area at its end; 0 where nothing touches then",
              mean_pressure}};

constexpr std::array massless{
    Column<H>{"contact_iterations", "1",
              "that the contact law took in a step, most in the interval",
              [](const H& r) { return static_cast<double>(r.iterations); }},
    Column<H>{"contact_extensions", "1",
              "times that further nodes came into contact while the law of a step was solved, "
              "likewise",
              [](const H& r) { return static_cast<double>(r.extensions); }}};

constexpr std::array rubber{
    Column<H>{
        "internal_work", "J/m",
        "done against the forces of the elements, cords and air, from the energy that they store "
        "at the start on; at `time_s`, and `strain` is that of the half step before",
        [](const H& r) { return r.material.internal_work; }},
    Column<H>{"stored_energy", "J/m",
              "of the elements, cords and air at `time_s`, viscous branches included",
              [](const H& r) { return r.material.stored_energy; }},
    Column<H>{"dissipation_viscous", "J/m", "by the branches of viscous materials",
              [](const H& r) { return r.material.dissipation_viscous; }},
    Column<H>{"integration", "1",
              "(`internal_work` + `window_work` − `stored_energy` − `dissipation_viscous`) over "
              "the energy exchanged so far: what the steps miss of the forces, of second order in "
              "the step",
              [](const H& r) { return r.material.relative_integration(r.balance.exchanged); }}};

constexpr std::array window{
    Column<H>{"window_work", "J/m",
              "by the motion of the window of `inflation.window`: what rubber gains in energy as "
              "it enters less what it loses as it leaves; no part of the balance, but of "
              "`integration`",
              [](const H& r) { return r.material.window_work; }}};

constexpr std::array hati{
    Column<H>{"work_interface", "J/m",
              "of what joins the two parts of the body: round-off, no part of the balance",
              [](const H& r) { return r.balance.works.interface; }}};

constexpr std::array contact{
    Column<P>{"time_s", "s", "of the snapshot", [](const P& r) { return r.time; }},
    Column<P>{"node", "1", "number of the node",
              [](const P& r) { return static_cast<double>(r.node); }},
    Column<P>{"abscissa_m", "m",
              "length along the surface from the first point of `ground.profile`, negative before "
              "it; \"flat\" is [[-1, 0], [1, 0]], so there it is x + 1 m; `nan` of a node that the "
              "ground does not press, but a body",
              [](const P& r) { return r.abscissa; }},
    Column<P>{"x_m", "m", "position, fixed frame", [](const P& r) { return r.position.x; }},
    Column<P>{"y_m", "m", "likewise", [](const P& r) { return r.position.y; }},
    Column<P>{"pressure_pa", "Pa", "normal force over `length_m`",
              [](const P& r) { return r.traction.x; }},
    Column<P>{"shear_pa", "Pa", "tangential force likewise",
              [](const P& r) { return r.traction.y; }},
    Column<P>{
        "length_m", "m",
        "of the deformed boundary that the node stands for: half of the edges beside it; "
        "all of a snapshot make `contact_length_m` of history.csv, but where bodies touch each "
        "other",
        [](const P& r) { return r.extent; }}};

/// Columns of a wheel in three dimensions. x is along t1, y along the normal n of the ground.
constexpr std::array solid_contact{
    Column<P>{"time_s", "s", "of the snapshot", [](const P& r) { return r.time; }},
    Column<P>{"node", "1", "number of the node",
              [](const P& r) { return static_cast<double>(r.node); }},
    Column<P>{"abscissa_m", "m", "length along the profile of the ground, as in the plane",
              [](const P& r) { return r.abscissa; }},
    Column<P>{"x_m", "m",
              "place on the ground along t1, the heading, in the fixed frame: less `center_x_m` "
              "of history.csv it is the place ahead of the center",
              [](const P& r) { return r.position.x; }},
    Column<P>{"y_m", "m", "along the normal, which leans by `motion.camber`",
              [](const P& r) { return r.position.y; }},
    Column<P>{"z_m", "m",
              "along t2, to the right, in the fixed frame: less `center_lateral` it is the place "
              "beside the center",
              [](const P& r) { return r.position.z; }},
    Column<P>{"pressure_pa", "Pa", "normal force over `area_m2`",
              [](const P& r) { return r.traction.x; }},
    Column<P>{"shear_x_pa", "Pa",
              "shear of the ground on the wheel likewise, along the profile towards +x",
              [](const P& r) { return 0.0 - r.traction.y; }},
    Column<P>{"shear_lateral_pa", "Pa", "along t2, to the right",
              [](const P& r) { return r.traction.z; }},
    Column<P>{"sticks", "1", "1: the node sticks; 0: it slips",
              [](const P& r) { return r.sticks ? 1.0 : 0.0; }},
    Column<P>{"area_m2", "m2",
              "of the deformed surface that the node stands for; all of a snapshot make "
              "`contact_area_m2` of history.csv",
              [](const P& r) { return r.extent; }}};

constexpr Column<P> friction_power{
    "friction_power", "W/m2",
    "that friction takes at the node, over the deformed boundary that it stands for; of steps in "
    "time that of the step of the snapshot",
    [](const P& r) { return r.power; }};

/// A group of columns, and the feature of a run that adds it.
struct ColumnGroup {
  bool HistoryFeatures::*feature;
  std::span<const Column<H>> columns;
};

constexpr std::array groups{ColumnGroup{&HistoryFeatures::solid, solid},
                            ColumnGroup{&HistoryFeatures::rim, rim},
                            ColumnGroup{&HistoryFeatures::massless, massless},
                            ColumnGroup{&HistoryFeatures::rubber, rubber},
                            ColumnGroup{&HistoryFeatures::window, window},
                            ColumnGroup{&HistoryFeatures::hati, hati}};

}  // namespace

std::vector<ColumnLabel> history_labels(const HistoryFeatures& features) {
  std::vector<ColumnLabel> labels = labels_of(std::span<const Column<H>>(history));
  for (const ColumnGroup& group : groups)
    if (features.*group.feature)
      for (ColumnLabel& label : labels_of(group.columns)) labels.push_back(std::move(label));
  if (!features.solid) return labels;
  for (ColumnLabel& label : labels) {
    label.unit = unit_of(label.unit, true);
    if (label.name == "contact_length_m")
      label = {"contact_area_m2", "m2",
               "of the deformed surface: the share of each node with a normal force, summed"};
  }
  return labels;
}

void append_history(const HistoryFeatures& features, const HistoryRecord& record,
                    std::vector<double>& values) {
  append_values(std::span<const Column<H>>(history), record, values);
  for (const ColumnGroup& group : groups)
    if (features.*group.feature) append_values(group.columns, record, values);
}

const Column<ContactRecord>& friction_column() noexcept {
  return friction_power;
}

std::span<const Column<ContactRecord>> contact_columns(bool is_solid) noexcept {
  if (is_solid) return solid_contact;
  return contact;
}

}  // namespace rondo::study
