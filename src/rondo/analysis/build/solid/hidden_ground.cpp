// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/solid/hidden_ground.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/contact/intrusion.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

using contact::least_hidden;

/// Largest depth that is accepted, over the spacing of the nodes. An arc whose radius is one
/// spacing hides 0.134, and 0.1345 in the straight pieces by which it is measured.
constexpr double most_hidden = 0.14;

/// The mesh whose nodes are no farther apart than this [m].
std::string finer_mesh(const Case& c, const Setup& s, double spacing) {
  const bool even = c.section.has_value() || !c.disk.tread;
  const std::string_view key = c.section ? "section.sectors" : "disk.mesh.circumferential";
  const double columns = c.section ? c.section->sectors : c.disk.circumferential;
  if (!even) return fmt::format("more columns of disk.tread: nodes {:.3g} m apart", spacing);
  return fmt::format("{} of at least {:.0f}", key,
                     std::ceil(columns * s.model.contact->ground.spacing() / spacing));
}

std::string where(const contact::Intrusion& of) {
  return fmt::format("({:.6g}, {:.6g}) m", of.at.x, of.at.y);
}

InputError hidden_obstacle(const Case& c, const Setup& s, const contact::Intrusion& of) {
  const double spacing = s.model.contact->ground.spacing();
  return case_error(
      c, "ground.profile",
      fmt::format("an obstacle {:.3g} m high at {} is shorter than the contact nodes are apart "
                  "along the tread, {:.3g} m: it may pass between them without a force, because a "
                  "wheel in three dimensions touches the ground at its nodes only",
                  of.depth, where(of), spacing),
      "an obstacle several times as long; a mesh whose nodes are several times closer; or no "
      "disk.width: plane bodies feel it between their nodes");
}

InputError hidden_corner(const Case& c, const Setup& s, const contact::Intrusion& of) {
  const double spacing = s.model.contact->ground.spacing(), fillet = c.ground->shape.fillet;
  std::string allowed = fmt::format("a ground.fillet of at least {:.3g} m", spacing);
  if (fillet > 0.0) allowed += "; " + finer_mesh(c, s, fillet);
  return case_error(
      c, fillet > 0.0 ? "ground.fillet" : "ground.profile",
      fmt::format("between two contact nodes, {:.3g} m apart along the tread, the ground at {} may "
                  "stand {:.3g} m deep in the wheel without a force, because a wheel in three "
                  "dimensions touches the ground at its nodes only",
                  spacing, where(of), of.depth),
      allowed + "; or no disk.width: plane bodies feel it between their nodes");
}

}  // namespace

void check_hidden_ground(const Case& c, Setup& s) {
  RONDO_DEMAND(s.model.solid.has_value(), s.model.n_nodes());
  if (!s.model.contact || !(s.model.contact->ground.spacing() > 0.0)) return;
  const double spacing = s.model.contact->ground.spacing();
  const contact::Hidden hidden = contact::hidden_between_nodes(s.model.contact->ground, spacing);
  if (hidden.whole.depth > least_hidden * spacing) throw hidden_obstacle(c, s, hidden.whole);
  if (hidden.deepest.depth > most_hidden * spacing) throw hidden_corner(c, s, hidden.deepest);
  if (!(hidden.deepest.depth > least_hidden * spacing)) return;
  s.warnings.push_back(fmt::format(
      "ground.profile: between two contact nodes, {:.3g} m apart along the tread, the ground at {} "
      "may stand {:.2g} m deep in the wheel: peaks of the forces depend on where the nodes "
      "happen to be. Runs with motion.start_x moved by parts of the spacing show how much; "
      "ground.fillet of {:.2g} m or more, or a finer mesh, makes it less",
      spacing, where(hidden.deepest), hidden.deepest.depth, spacing / (8.0 * least_hidden)));
}

}  // namespace rondo::study
