// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/base/shared_members.hpp"

namespace rondo::study {
namespace {

struct Size {
  std::size_t nodes, dofs;
};
constexpr JsonMember<Size> size_members[] = {
    {"nodes", "integer", "", "Nodes of the mesh", [](const Size& s) -> Json { return s.nodes; }},
    {"dofs", "integer", "", "Free degrees of freedom",
     [](const Size& s) -> Json { return s.dofs; }},
};

struct Wheel {
  std::optional<double> width;
  int sectors;
  double camber;
};
constexpr JsonMember<Wheel> wheel_members[] = {
    {"dimensions", "integer", "", "3; only for a [3D wheel](#wheels-in-three-dimensions)",
     [](const Wheel&) -> Json { return 3; }},
    {"width", "number", "m", "Extent of a 3D wheel along the axle; not in steady rolling",
     [](const Wheel& w) { return w.width ? Json(*w.width) : absent(); }},
    {"sectors", "integer", "", "Columns or pitches around a 3D wheel",
     [](const Wheel& w) -> Json { return w.sectors; }},
    {"camber", "number", "rad", "Camber of a 3D wheel",
     [](const Wheel& w) -> Json { return w.camber; }},
};

constexpr JsonMember<RunReport> steps_members[] = {
    {"steps_done", "integer", "", "Steps, increments or samples of a sector that were done",
     [](const RunReport& r) -> Json { return r.steps; }},
};

constexpr JsonMember<RunReport> contact_residual_members[] = {
    {"contact_residual_max", "number", "",
     "Largest residual of the contact law, computed independently of the solver, over the largest "
     "|w_free| so far; in a crush and in steady rolling over the largest force",
     [](const RunReport& r) -> Json { return r.contact_residual_max; }},
};

struct Balanced {
  const RunReport& r;
  std::optional<double> exchanged;
};
constexpr JsonMember<Balanced> energy_members[] = {
    {"energy_residual_relative", "number", "",
     "Largest imbalance of the energy balance (ledger) over the energy exchanged so far; in steady "
     "rolling of the balance of powers, over the largest of them",
     [](const Balanced& b) -> Json { return b.r.energy_residual_relative; }},
    {"energy_residual_bound", "number", "",
     "[Bound](#what-ends-a-run) of `energy_residual_relative`",
     [](const Balanced& b) -> Json { return b.r.energy_residual_bound; }},
    {"energy_exchanged", "number", "J/m",
     "Largest value of |E| + Σ |cumulative work of each term|; not in steady rolling",
     [](const Balanced& b) { return b.exchanged ? Json(*b.exchanged) : absent(); }},
};

constexpr JsonMember<RunReport> penetration_members[] = {
    {"penetration_max_m", "number", "m",
     "Largest depth of a contact node in the ground or in a body",
     [](const RunReport& r) -> Json { return r.penetration_max_m; }},
};

constexpr JsonMember<double> solve_members[] = {
    {"solve_wall_s", "number", "s",
     "Wall time of the solver: of steady rolling, or of the iterations of LATIN and of forming "
     "fields",
     [](const double& seconds) -> Json { return seconds; }},
};

}  // namespace

void add_size(std::size_t nodes, std::size_t dofs, Json& json) {
  add_members(size_members, {nodes, dofs}, json);
}

void add_wheel(std::optional<double> width, int sectors, double camber, Json& json) {
  add_members(wheel_members, {width, sectors, camber}, json);
}

void add_steps_done(const RunReport& report, Json& json) {
  add_members(steps_members, report, json);
}

void add_contact_residual(const RunReport& report, Json& json) {
  add_members(contact_residual_members, report, json);
}

void add_energy_residual(const RunReport& report, std::optional<double> exchanged, Json& json) {
  add_members(energy_members, {report, exchanged}, json);
}

void add_penetration(const RunReport& report, Json& json) {
  add_members(penetration_members, report, json);
}

void add_solve_wall(double seconds, Json& json) {
  add_members(solve_members, seconds, json);
}

std::vector<MemberText> shared_members() {
  return joined({texts_of(size_members), texts_of(wheel_members), texts_of(steps_members),
                 texts_of(energy_members), texts_of(contact_residual_members),
                 texts_of(penetration_members), texts_of(solve_members)});
}

}  // namespace rondo::study
