// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/matrices/contact_rows.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

/// Position of a node relative to the center, co-rotating frame [m].
Vec3 arm_of(const dynamics::Model& m, FieldView u, std::size_t node) {
  Vec3 arm(m.reference[node], m.solid ? m.solid->axial[node] : 0.0);
  if (u.empty()) return arm;
  arm += {u[node][0], u[node][1], m.solid ? u[node][2] : 0.0};
  return arm;
}

void append(Vec3 a, std::size_t components, std::vector<double>& to) {
  const std::array<double, 3> part{a.x, a.y, a.z};
  to.insert(to.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(components));
}

}  // namespace

FramePlace frame_at(const dynamics::Model& model, double time, const std::string& option) {
  if (!(time >= 0.0) || !std::isfinite(time))
    throw request_error(option, fmt::format("{}", time), "is no time of the motion",
                        "a number of seconds, 0 or more");
  const bool moves = model.rim && (model.rim->free_x || model.rim->free_y || model.rim->free_spin);
  if (moves && time > 0.0)
    throw request_error(option, fmt::format("{}", time),
                        "forces move the rim: where it is then is known from a run alone",
                        "0; in Python the angle and center of a run");
  return {model.motion.angle(time), model.motion.center(time)};
}

ContactRows contact_rows(const Case& c, const dynamics::Model& model, const FramePlace& frame,
                         FieldView u) {
  if (!model.contact)
    throw case_error(c, "ground", "there is none, and so there are no contact rows",
                     "[ground] with profile = \"flat\", or another one");
  if (is_on_road_surface(c))
    throw case_error(
        c, "ground.road",
        "contact rows are those of a ground that is the same all across a wheel with a "
        "width, and a road is not",
        "the section of the road as ground.profile (docs/roads.md, section 4)");
  if (has_obstacles_of_own_axes(c))
    throw case_error(c, ground_key(c),
                     "contact rows are those of a ground that is the same along its edges, and "
                     "obstacles of several angles are not",
                     "one angle for all obstacles and ground.profile = \"flat\"");
  RONDO_DEMAND(u.empty() || (u.size() == model.n_nodes() && u.components == model.components()),
               u.size(), u.components, model.n_nodes());
  const std::size_t components = model.components();
  std::vector<int> place(model.n_nodes(), -1);
  for (std::size_t k = 0; k < model.free.size(); ++k)
    place[at(model.free[k])] = static_cast<int>(k);
  const GroundFrame ground(model.motion.camber);
  const contact::EdgeAxes& edges = model.contact->axes;
  const Complex turn = rotation(frame.angle);
  ContactRows out;
  std::vector<Eigen::Triplet<double>> entries;
  for (const int node : model.contact->nodes) {
    const Vec3 arm = turn * arm_of(model, u, at(node));
    const contact::Touch touch = model.contact->ground.facet_near(
        edges.from_ground(frame.center + ground.from_wheel(arm)).plane());
    const std::array<Vec3, 3> axes{edges.to_ground(touch.normal),
                                   edges.to_ground(turn90(touch.normal)),
                                   edges.to_ground({0.0, 0.0, 1.0})};
    append(ground.to_wheel(axes[0]), components, out.normal);
    append(conj(turn) * ground.to_wheel(axes[0]), components, out.normal_corotating);
    for (std::size_t d = 0; d < components; ++d) {
      std::vector<double> row;
      append(conj(turn) * ground.to_wheel(axes[d]), components, row);
      for (std::size_t i = 0; i < components; ++i)
        entries.emplace_back(static_cast<int>(components * out.gap.size() + d),
                             static_cast<int>(components) * place[at(node)] + static_cast<int>(i),
                             row[i]);
    }
    out.gap.push_back(touch.gap);
  }
  out.rows.resize(static_cast<Eigen::Index>(components * out.gap.size()),
                  static_cast<Eigen::Index>(components * model.free.size()));
  out.rows.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace rondo::study
