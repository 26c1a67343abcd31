// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/dynamic_members.hpp"

#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/analysis/build/tyre/inflation_members.hpp"
#include "rondo/analysis/elements/massless_boundary.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {
namespace {

using dynamics::Model;
using dynamics::RimBody;

constexpr JsonMember<RimBody> rim_members[] = {
    {"free", "array of string", "",
     "Motions that are free: \"speed\", \"height\", \"angular_velocity\"",
     [](const RimBody& rim) {
       Json free = Json::array();
       if (rim.free_x) free.push_back("speed");
       if (rim.free_y) free.push_back("height");
       if (rim.free_spin) free.push_back("angular_velocity");
       return free;
     }},
    {"mass", "number", "kg/m", "Mass, with that of the bonded nodes",
     [](const RimBody& rim) -> Json { return rim.mass; }},
    {"inertia", "number", "kg m", "Moment of inertia, with that of the bonded nodes",
     [](const RimBody& rim) -> Json { return rim.inertia; }},
};

constexpr JsonMember<Model> hati_members[] = {
    {"ratio", "integer", "", "Fine steps in a coarse one",
     [](const Model& m) -> Json { return m.subdomains->ratio; }},
    {"fine_step", "number", "s", "Step of the fine part",
     [](const Model& m) -> Json { return explicit_step(m); }},
    {"fine_dofs", "integer", "", "Degrees of freedom of the fine part",
     [](const Model& m) -> Json { return 2 * m.subdomains->fine.free.size(); }},
    {"interface_dofs", "integer", "", "Degrees of freedom of the nodes where the parts meet",
     [](const Model& m) -> Json { return 2 * m.subdomains->interface.size(); }},
};

struct Built {
  const Case& c;
  const Setup& s;
};

constexpr JsonMember<Built> file_of_mesh_members[] = {
    {"mesh_file", "string", "", "Only with `[mesh]` or `[section]`: the file that was read",
     [](const Built& b) {
       const MeshCase* const mesh = mesh_file_of(b.c);
       return mesh ? Json(as_utf8(mesh->file.string())) : absent();
     }},
};

constexpr JsonMember<Built> built_members[] = {
    {"bodies", "integer", "", "Parts of the mesh that no cell connects",
     [](const Built& b) -> Json { return count_bodies(b.s.model); }},
    {"free_bodies", "integer", "", "Bodies that nothing holds",
     [](const Built& b) -> Json { return b.s.model.free_bodies.size(); }},
    {"operator", "string", "", "\"cyclic\" or \"sparse\" ([performance.md](performance.md))",
     [](const Built& b) -> Json { return operator_name(b.s.model.stiffness_operator); }},
    {"threads", "integer", "", "Number of threads",
     [](const Built& b) -> Json { return b.s.model.threads; }},
    {"critical_step", "number", "s",
     "Largest stable step; null if all elements are implicit. With `time.scheme = \"hati\"` that "
     "of "
     "the fine part",
     [](const Built& b) -> Json { return b.s.critical.step; }},
    {"contact_mass", "string", "", "`solver.contact_mass`",
     [](const Built& b) -> Json { return contact_mass_name(b.c); }},
    {"critical_step_plain", "number", "s",
     "With implicit elements, contact nodes without mass, or \"hati\": the critical step without "
     "any of them",
     [](const Built& b) {
       const Model& m = b.s.model;
       const bool is_told = m.implicit || has_massless_contact(m) || m.subdomains;
       return is_told ? Json(b.s.critical_plain) : absent();
     }},
    {"implicit_dofs", "integer", "",
     "With [implicit elements](cases.md#solverimplicit-implicit-elements-in-the-explicit-step): "
     "degrees of freedom of their nodes",
     [](const Built& b) {
       return b.s.model.implicit ? Json(2 * b.s.model.implicit->nodes.size()) : absent();
     }},
    {"largest_frequency", "number", "rad/s", "Frequency that gives the critical step",
     [](const Built& b) -> Json { return b.s.critical.omega; }},
    {"step", "number", "s", "Step; with \"hati\" the coarse one",
     [](const Built& b) -> Json { return b.s.model.dt; }},
    {"steps", "integer", "", "Steps planned", [](const Built& b) -> Json { return b.s.n_steps; }},
    {"hati", "object", "", "Only with `time.scheme = \"hati\"`: its two parts",
     [](const Built& b) {
       return b.s.model.subdomains ? object_of(hati_members, b.s.model) : absent();
     },
     [] { return texts_of(hati_members); }},
    {"rim", "object", "", "Only with `[rim]`: the rim with what is bonded to it",
     [](const Built& b) {
       return b.s.model.rim ? object_of(rim_members, *b.s.model.rim) : absent();
     },
     [] { return texts_of(rim_members); }},
};

constexpr JsonMember<RunReport> time_members[] = {
    {"end_time", "number", "s", "Time reached",
     [](const RunReport& r) -> Json { return r.end_time; }},
    {"ns_per_dof_step", "number", "ns", "`loop_wall_s` over degrees of freedom × steps",
     [](const RunReport& r) -> Json { return r.ns_per_dof_step; }},
};

using E = DynamicEnd;
/// Whether friction is watched and a row has had some.
bool has_friction(const E& e) {
  return e.friction.watches() && e.contact.friction_bearable > 0.0;
}

constexpr JsonMember<E> contact_members[] = {
    {"steps_in_contact", "integer", "", "Steps with contact",
     [](const E& e) -> Json { return e.contact.contact_steps; }},
    {"nodes_max", "integer", "", "Most nodes in contact at once",
     [](const E& e) -> Json { return e.contact.nodes_max; }},
    {"free_velocity_max", "number", "m/s", "Largest |w_free|",
     [](const E& e) -> Json { return e.contact.free_velocity; }},
    {"pairs_solved", "integer", "", "Contacts of a node with two facets that were solved",
     [](const E& e) -> Json { return e.contact.pairs; }},
    {"pairs_not_converged", "integer", "",
     "Contacts of a node with two facets that did not converge",
     [](const E& e) -> Json { return e.contact.pairs_not_converged; }},
    {"clusters_solved", "integer", "",
     "Groups of contacts that share nodes and were solved together",
     [](const E& e) -> Json { return e.contact.clusters; }},
    {"clusters_not_converged", "integer", "",
     "Groups of contacts that did not converge; a residual of the law above its bound then ends "
     "the "
     "run. For wheels in three dimensions also corners of the ground that were not solved with the "
     "contacts beside them: they are left out of that step, and the run warns",
     [](const E& e) -> Json { return e.contact.clusters_not_converged; }},
    {"cluster_largest", "integer", "", "Contacts in the largest group",
     [](const E& e) -> Json { return e.contact.cluster_largest; }},
    {"cluster_iterations_max", "integer", "", "Iterations of the hardest group",
     [](const E& e) -> Json { return e.contact.cluster_iterations; }},
    {"extensions", "integer", "",
     "Times that further contact nodes without mass joined while a step was solved",
     [](const E& e) -> Json { return e.contact.extensions; }},
    {"extensions_max", "integer", "", "Most such extensions in a step",
     [](const E& e) -> Json { return e.contact.extensions_max; }},
    {"between_bodies_max", "integer", "", "Most nodes pressed against bodies at once",
     [](const E& e) -> Json { return e.contact.between_bodies; }},
    {"friction_steepness_max", "number", "",
     "Only where friction is a table, contact nodes have mass and a row of `history.csv` has "
     "contact: largest κ of a contact at these rows, the slope of its coefficient over the slip "
     "speed times its normal impulse over the mass of its node ([theory.md](theory.md), 4.3e)",
     [](const E& e) {
       return e.friction.limit() && has_friction(e) ? Json(e.contact.friction_steepness) : absent();
     }},
    {"friction_steepness_limit", "number", "",
     "Where friction is a table and contact nodes have mass: κ below which slips and coefficients "
     "do not alternate from step to step",
     [](const E& e) { return e.friction.limit() ? Json(*e.friction.limit()) : absent(); }},
    {"friction_alternating", "number", "",
     "Only where friction is a table and a row of `history.csv` has contact: share of the friction "
     "that alternates, by these rows; a warning above 0.01",
     [](const E& e) { return has_friction(e) ? Json(alternating_share(e.contact)) : absent(); }},
    {"problems_kept", "integer", "", "Files in `contact-problems/`",
     [](const E& e) -> Json { return e.problems_kept; }},
};
constexpr JsonMember<E> ended_members[] = {
    {"contact", "object", "", "Figures of the contact",
     [](const E& e) { return object_of(contact_members, e); },
     [] { return texts_of(contact_members); }},
};

}  // namespace

void describe_dynamic(const Case& c, const Setup& s, Json& json) {
  add_size(s.model.n_nodes(), count_dofs(s.model), json);
  add_members(file_of_mesh_members, {c, s}, json);
  if (s.model.solid) add_wheel(width_of(s.mesh), s.mesh.n_sectors, s.model.motion.camber, json);
  if (s.inflation) add_inflation(*s.inflation, json);
  add_members(built_members, {c, s}, json);
}

void summarise_dynamic(const DynamicEnd& end, Json& json) {
  add_steps_done(end.report, json);
  add_members(time_members, end.report, json);
  add_energy_residual(end.report, end.exchanged, json);
  add_contact_residual(end.report, json);
  add_penetration(end.report, json);
  add_members(ended_members, end, json);
}

std::vector<MemberText> dynamic_members() {
  return joined({texts_of(file_of_mesh_members), texts_of(built_members), texts_of(time_members),
                 texts_of(ended_members)});
}

}  // namespace rondo::study
