// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/rim.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/analysis/build/ground/held_ground.hpp"
#include "rondo/core/column.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::study {
namespace {

using dynamics::RimBody;

/// Sums over the clamped nodes, about the origin.
struct Bonded {
  double mass = 0.0;     ///< [kg/m]
  double inertia = 0.0;  ///< [kg·m]
  Vec2 moment;           ///< Σ m X [kg]
  double radius = 0.0;   ///< the largest |X| [m]
};

Bonded bonded_nodes(const mesh::Mesh& mesh, const std::vector<double>& mass) {
  RONDO_DEMAND(mass.size() == mesh.n_nodes(), mass.size(), mesh.n_nodes());
  Bonded b;
  for (const int node : mesh.clamped) {
    const Vec2 x = mesh.coordinates[at(node)];
    b.mass += mass[at(node)];
    b.inertia += mass[at(node)] * dot(x, x);
    b.moment += mass[at(node)] * x;
    b.radius = std::max(b.radius, norm(x));
  }
  return b;
}

void refuse_unbalanced(const Case& c, const Bonded& b) {
  constexpr double round_off = 1e-9;
  if (norm(b.moment) <= round_off * b.mass * b.radius) return;
  const Vec2 center = b.moment / b.mass;
  throw case_error(c, c.mesh ? "mesh.clamped" : "rim",
                   fmt::format("the center of mass of the nodes bonded to the rim is ({:.4g}, "
                               "{:.4g}) m, and a [rim] turns about the origin of the mesh",
                               center.x, center.y),
                   "a curve whose nodes are balanced about the origin, as evenly spaced ones on "
                   "circles, or no [rim]");
}

std::string free_text(const RimBody& rim) {
  std::string free, held;
  const auto add = [&](bool is_free, const char* name) {
    std::string& to = is_free ? free : held;
    to += (to.empty() ? "" : ", ") + std::string(name);
  };
  add(rim.free_x, "speed");
  add(rim.free_y, "height");
  add(rim.free_spin, "angular_velocity");
  return fmt::format("{}{}{}{}{}", free.empty() ? "" : "free ", free,
                     free.empty() || held.empty() ? "" : "; ", held.empty() ? "" : "held ", held);
}

/// Weight of rim and body at the end of the run.
Vec2 weight_of(const Case& c, const dynamics::Model& model) {
  double mass = model.rim->mass;
  for (const int node : model.free) mass += model.mass[at(node)];
  return mass * model.motion.gravity_at(c.time.end);
}

/// Those of what is free at the end of the run; the weight is of rim and body.
std::string load_text(const Case& c, const dynamics::Model& model) {
  const RimBody& rim = *model.rim;
  const double end = c.time.end;
  std::vector<std::string> loads;
  const auto add = [&](const char* name, double value, std::string_view unit) {
    loads.push_back(fmt::format("{} {:.6g} {}", name, value, unit));
  };
  const bool solid = model.solid.has_value();
  const std::string_view force = unit_of("N/m", solid), torque = unit_of("N", solid);
  if (rim.free_x) add("force_x", rim.force_x.at(end), force);
  if (rim.free_y) add("force_y", rim.force_y.at(end), force);
  if (rim.free_spin) add("torque", rim.torque.at(end), torque);
  if (rim.free_spin) add("brake", rim.brake.at(end), torque);
  const Vec2 weight = weight_of(c, model);
  if ((rim.free_x || rim.free_y) && norm(weight) > 0.0)
    loads.push_back(fmt::format("weight ({:.6g}, {:.6g}) {}", weight.x + 0.0, weight.y, force));
  return fmt::format("{}", fmt::join(loads, ", "));
}

void tell_support(const char* name, const dynamics::RimSupport& support, Setup& s) {
  if (support.stiffness == 0.0 && support.damping == 0.0) return;
  const bool solid = s.model.solid.has_value();
  s.figures.emplace_back(
      name,
      fmt::format("spring {:.6g} {} at rest at {:.6g} m, dashpot {:.6g} {}", support.stiffness,
                  unit_of("N/m2", solid), support.at, support.damping, unit_of("N s/m2", solid)));
}

}  // namespace

void add_rim(const Case& c, const mesh::Mesh& mesh, dynamics::Model& model) {
  if (!c.rim) return;
  const Bonded bonded = bonded_nodes(mesh, model.mass);
  refuse_unbalanced(c, bonded);
  RONDO_DEMAND(model.free_bodies.empty(), model.free_bodies.size());
  model.rim = c.rim;
  model.rim->mass += bonded.mass;
  model.rim->inertia += bonded.inertia;
}

void set_rim_loads(const Case& c, dynamics::Model& model) {
  if (!c.rim) return;
  RONDO_DEMAND(model.rim.has_value(), c.rim->mass);  // by add_rim()
  const double mass = model.rim->mass, inertia = model.rim->inertia;
  model.rim = c.rim;
  model.rim->mass = mass;
  model.rim->inertia = inertia;
}

namespace {

dynamics::RimFrequencies frequencies_of(const dynamics::Model& model,
                                        const dynamics::StiffnessProduct& product) {
  RONDO_DEMAND(model.rim && model.mass.size() == model.n_nodes(), model.mass.size(),
               model.n_nodes());
  const RimBody& rim = *model.rim;
  dynamics::RimDofs dofs;
  if (rim.free_x) dofs.inertia[0] = rim.mass;
  if (rim.free_y) dofs.inertia[1] = rim.mass;
  if (rim.free_spin) dofs.inertia[2] = rim.inertia;
  dofs.spring = {rim.support_x.stiffness, rim.support_y.stiffness};
  return dynamics::rim_frequencies(product, model.mass, model.reference, model.free, dofs);
}

}  // namespace

dynamics::CriticalStep step_with_rim(const dynamics::Model& model,
                                     const dynamics::StiffnessProduct& product,
                                     const dynamics::CriticalStep& held,
                                     dynamics::LaggedDamping damping) {
  return dynamics::with_rim(held, frequencies_of(model, product), damping);
}

dynamics::CriticalStep step_with_rim(const dynamics::Model& model,
                                     const dynamics::CriticalStep& held,
                                     dynamics::LaggedDamping damping) {
  const auto product = [&](std::span<const Vec2> u, std::span<Vec2> out) {
    apply_stiffness(model, u, out);
  };
  const dynamics::RimFrequencies frequencies = frequencies_of(model, product);
  return model.sector ? dynamics::with_rim(held, *model.sector, model.mass, frequencies, damping)
                      : dynamics::with_rim(held, frequencies, damping);
}

HubWatch::HubWatch(const Setup& setup) : setup_(setup) {
  const dynamics::Model& model = setup.model;
  if (!model.rim || !model.rim->free_y || !model.contact) return;
  wall_ = wall_of(setup.mesh);
  held_ = held_radius(setup.mesh);
}

HubWatch::Seen HubWatch::look(Vec3 center, double time) {
  if (!wall_ && held_ == 0.0) return {};
  const double above = dynamics::distance_in_space(*setup_.model.contact, center);
  if (!wall_ && above < held_)
    return {
        {},
        fmt::format("the hub is {:.4g} m above the ground, and nodes that are held are {:.4g} m "
                    "from it: they are in the ground, which does nothing to them",
                    above, held_)};
  if (!wall_) return {};
  const double deflection = wall_->radius - above, share = deflection / wall_->thickness;
  const std::string told = fmt::format(
      "the hub is {:.4g} m above the ground, {:.3g} % of the {:.4g} m of the wall below "
      "its free radius",
      above, 100.0 * share, wall_->thickness);
  if (share >= 1.0)
    return {{},
            told +
                ": the rim is in the ground, which it does not touch in the model; less of "
                "rim.force_y, or a stiffer body"};
  if (told_ || share <= deep_share || fem::has_rubber(setup_.materials)) return {};
  told_ = true;
  return {fmt::format("t = {:.9g} s: {}: the law of the material is for small strains", time, told),
          {}};
}

std::optional<double> load_on_ground(const Case& c, const dynamics::Model& model) {
  RONDO_DEMAND(model.rim.has_value(), model.n_nodes());
  if (model.rim->support_y.stiffness != 0.0) return std::nullopt;
  return -model.rim->force_y.at(c.time.end) - weight_of(c, model).y;
}

void tell_rim(const Case& c, Setup& s) {
  RONDO_DEMAND(c.rim && s.model.rim && s.model.rim->mass >= c.rim->mass, c.rim.has_value(),
               s.model.rim.has_value());
  const RimBody& rim = *s.model.rim;
  const bool solid = s.model.solid.has_value();
  s.figures.emplace_back("rim", free_text(rim));
  s.figures.emplace_back("rim mass",
                         fmt::format("{:.6g} {}, of which {:.6g} of bonded nodes", rim.mass,
                                     unit_of("kg/m", solid), rim.mass - c.rim->mass));
  s.figures.emplace_back("rim inertia",
                         fmt::format("{:.6g} {}, of which {:.6g} of bonded nodes", rim.inertia,
                                     unit_of("kg m", solid), rim.inertia - c.rim->inertia));
  if (const std::string loads = load_text(c, s.model); !loads.empty())
    s.figures.emplace_back("load at the end", loads);
  if (rim.free_x) tell_support("support along x", rim.support_x, s);
  if (rim.free_y) tell_support("support along y", rim.support_y, s);
}

}  // namespace rondo::study
