// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/ground/ground_inside.hpp"
#include "rondo/analysis/build/overlap.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/analysis/build/steady_start.hpp"
#include "rondo/contact/intrusion.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {
namespace {

/// Finds the stationary state of rubber at finite strain, else that by K.
statics::StationarySpin find_stationary(const Case& c, const Setup& s, double spin) {
  const dynamics::Model& m = s.model;
  if (s.rubber)
    return statics::stationary_spin(*s.rubber, m.mass, m.reference, held_nodes(m), spin);
  if (m.solid)
    return statics::stationary_spin(m.solid->sector, m.mass, m.reference, spin,
                                    c.inflation ? spin_at_rest(c) : 0.0);
  if (by_harmonics(m)) return statics::stationary_spin(*m.sector, m.mass, m.reference, spin);
  return statics::stationary_spin(m.stiffness, m.mass, m.reference, held_nodes(m), spin);
}

/// Sets the stationary state of what is held; free bodies stay as they are.
void set_stationary(const Case& c, Setup& s, SharedBody* shared) {
  const double spin = -c.motion.angular_velocity.at(0.0);
  if (shared && !shared->stationary.empty() && shared->spin == spin) {
    RONDO_DEMAND(shared->stationary.size() == s.model.n_nodes(), shared->stationary.size(),
                 s.model.n_nodes());
    s.displacement = shared->stationary;
    return;
  }
  statics::StationarySpin stationary = find_stationary(c, s, spin);
  if (stationary.status != statics::SpinStatus::solved)
    throw case_error(c, "motion.angular_velocity",
                     "no stationary state: at this rotation speed the centrifugal softening "
                     "exceeds the stiffness",
                     "a lower rotation speed, or a stiffer material");
  s.displacement = std::move(stationary.u);
  RONDO_DEMAND(s.displacement.size() == s.model.n_nodes() &&
                   s.displacement.components() == s.model.components(),
               s.displacement.size(), s.displacement.components(), s.model.n_nodes());
  if (!shared) return;
  shared->spin = spin;
  shared->stationary = s.displacement;
}

/// How deep the worst node is, compared with its elements.
struct Depth {
  double deepest = 0.0;  ///< [m]
  double worst = 0.0;    ///< depth over the size of the node's elements
  double allowed = 0.0;  ///< half the size of the worst node's elements [m]
  bool free = false;     ///< the worst node is of a free body

  void add(double depth, double size, bool is_free) {
    RONDO_ASSERT(size > 0.0, size);
    deepest = std::max(deepest, depth);
    if (depth / size <= worst) return;
    worst = depth / size;
    allowed = 0.5 * size;
    free = is_free;
  }
};

/// (n) fixed frame; of a wheel in three dimensions along t1, n and t2 [m].
std::vector<Vec3> start_positions(const Setup& s) {
  const Vec2 center = s.model.motion.center(0.0).plane();
  if (s.model.solid) return solid_positions(s);
  const std::span<const Vec2> u = s.displacement.plane();
  std::vector<Vec3> x(s.model.n_nodes());
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = (in_fixed_frame(s.model, k) ? Vec2{} : center) + s.model.reference[k] + u[k];
  return x;
}

/// (n) of a plane body [m]
std::vector<Vec2> in_plane(const std::vector<Vec3>& x) {
  std::vector<Vec2> out;
  std::ranges::transform(x, std::back_inserter(out), [](Vec3 place) { return place.plane(); });
  return out;
}

Depth deepest_start(const Setup& s, const std::vector<double>& size, const std::vector<Vec3>& x) {
  const dynamics::ContactModel& contact = *s.model.contact;
  Depth depth;
  RONDO_DEMAND(size.size() == s.model.n_nodes() && x.size() == s.model.n_nodes(), size.size(),
               x.size(), s.model.n_nodes());
  for (const int candidate : contact.nodes) {
    const std::size_t node = at(candidate);
    depth.add(-distance_in_space(contact, x[node]), size[node], in_fixed_frame(s.model, node));
  }
  return depth;
}

/// The advice for a start inside the ground. @param free the body is
std::string other_start(const Case& c, bool free) {
  if (free) return "start above the ground (initial.position, initial.turn)";
  return c.rim && c.rim->free_y
             ? "start above the ground or touching it (motion.height, motion.start_x)"
             : "start above the ground (motion.height, motion.start_x) and come down by a table";
}

/// A node deeper than half an element would get an impulse that means nothing: refused. One less
/// deep is held where it is, for the law acts on velocities: said. Returns the largest depth [m].
double check_nodes(const Case& c, const std::vector<double>& size, const std::vector<Vec3>& x,
                   Setup& s) {
  const Depth depth = deepest_start(s, size, x);
  if (depth.worst > 0.5)
    throw case_error(
        c, depth.free ? "initial.position" : "motion.height",
        fmt::format("the body starts {:.4g} m deep inside the ground, more than half an element "
                    "({:.4g} m)",
                    depth.deepest, depth.allowed),
        other_start(c, depth.free));
  if (!(depth.deepest > 1e-9 * extent_of(s.mesh))) return 0.0;
  if (has_massless_contact(s.model))
    throw case_error(
        c, "motion.height",
        fmt::format("the body starts {:.4g} m inside the ground, out of which contact "
                    "nodes without mass would be pushed in one step: that creates "
                    "energy",
                    depth.deepest),
        "start above the ground or touching it, initial.state = \"steady-rolling\", or "
        "solver.contact_mass = \"lumped\"");
  s.warnings.push_back(
      fmt::format("the body starts {:.4g} m inside the ground: contact keeps it "
                  "from going deeper, but does not push it out",
                  depth.deepest));
  return depth.deepest;
}

/// The bend of the ground that is deepest behind an edge around a wheel in three dimensions, over
/// the length of the edge. Its side view has no other cells that the ground may stand in. A road
/// has no bends: where it does not fit the elements, wheel_road.hpp warns.
GroundInside find_bend_inside(const Setup& s, const std::vector<Vec3>& places) {
  GroundInside out;
  const dynamics::ContactModel& contact = *s.model.contact;
  for (std::size_t set = 0; set < profile_count(contact); ++set)
    for (const auto& [a, b] : contact.edges) {
      const Vec2 from = on_profile(contact, set, places[at(a)]),
                 to = on_profile(contact, set, places[at(b)]);
      const contact::Intrusion found = contact::deepest_inside(profile_of(contact, set), from, to,
                                                               norm(s.model.reference[at(a)]));
      const double length = norm(to - from);
      if (found.depth / length > out.depth / out.size) out = {found.depth, length, found.at, a};
    }
  return out;
}

/// Ground between the nodes that stands as deep in a cell is met by no node: refused as well.
/// @param told depth that the nodes were said to be in the ground [m]
void check_ground_inside(const Case& c, const std::vector<double>& size,
                         const std::vector<Vec3>& places, double told, Setup& s) {
  const GroundInside found =
      s.model.solid ? find_bend_inside(s, places) : find_ground_inside(s, in_plane(places), size);
  const std::string where = fmt::format("({:.6g}, {:.6g})", found.place.x, found.place.y);
  if (found.depth > 0.5 * found.size) {
    const bool free = in_fixed_frame(s.model, at(found.node));
    throw case_error(
        c, free ? "initial.position" : "motion.height",
        fmt::format(
            "the ground stands {:.4g} m deep inside the body at the start, at {} m, between "
            "the nodes of its boundary: more than half an element ({:.4g} m)",
            found.depth, where, 0.5 * found.size),
        other_start(c, free));
  }
  if (!(found.depth > told + 1e-9 * extent_of(s.mesh))) return;
  s.warnings.push_back(
      fmt::format("the ground stands {:.4g} m deep inside the body at the start, at {} m, between "
                  "the nodes of its boundary: contact does not push it out",
                  found.depth, where));
}

/// The plane velocity of all that is free, of a wheel in three dimensions.
void move_along(Vec2 velocity, Setup& s) {
  for (Field* field : {&s.velocity, &s.half_velocity})
    if (!field->empty())
      for_free_nodes(s.model, [&](std::size_t k) { field->space()[k] += Vec3(velocity, 0.0); });
}

}  // namespace

void set_initial_fields(const Case& c, Setup& s, SharedBody* shared) {
  const dynamics::Model& model = s.model;
  RONDO_DEMAND(model.dt > 0.0, model.dt);
  s.displacement = s.velocity = Field(model.n_nodes(), model.components());
  if (c.initial.state == InitialState::stationary) set_stationary(c, s, shared);
  if (c.initial.state == InitialState::steady_rolling) set_steady_rolling(c, s);
  if (model.solid) return move_along(c.initial.velocity, s);
  const auto& g = c.initial.displacement_gradient;
  const std::vector<RigidMotion> motions = motions_of(c, s.mesh, model);
  const std::span<Vec2> u = s.displacement, v = s.velocity, half = s.half_velocity;
  const std::size_t n = model.n_nodes();
  RONDO_DEMAND(u.size() == n && v.size() == n && (half.empty() || half.size() == n) &&
                   motions.size() == model.free_bodies.size(),
               n, u.size(), v.size(), half.size(), motions.size());
  for (const int node : model.free) {
    const std::size_t k = at(node);
    const Vec2 x = model.reference[k];
    u[k] += Vec2{g[0][0] * x.x + g[0][1] * x.y, g[1][0] * x.x + g[1][1] * x.y};
    v[k] += c.initial.velocity;  // θ(0) = 0: both frames have the same axes
    if (!half.empty()) half[k] += c.initial.velocity;
    if (!in_fixed_frame(model, k)) continue;
    const std::size_t b = at(model.free_body[k]);
    const double spin = -motions[b].angular_velocity;  // counter-clockwise
    v[k] = motions[b].velocity + spin * turn90(x - model.free_bodies[b].center);
  }
}

void check_start(const Case& c, Setup& s) {
  RONDO_DEMAND(s.displacement.size() == s.model.n_nodes() &&
                   s.displacement.components() == s.model.components(),
               s.displacement.size(), s.model.n_nodes());
  const std::vector<double> size = element_sizes(s.mesh);
  const std::vector<Vec3> places = start_positions(s);
  if (s.model.contact) {
    const double told = check_nodes(c, size, places, s);
    check_ground_inside(c, size, places, told, s);
  }
  if (s.mesh.is_solid()) return;  // its elements lie beside each other as they are made
  refuse_overlaps(c, {s.mesh, in_plane(places), s.model.surfaces.has_value()}, s.warnings);
}

}  // namespace rondo::study
