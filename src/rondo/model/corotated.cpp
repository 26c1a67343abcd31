// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/corotated.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

Vec2 arm_of(const Model& model, const FreeBody& body, std::size_t k) noexcept {
  return model.reference[k] - body.center;
}

template <class Work>
void for_nodes(const FreeBody& body, Work&& work) noexcept {
  for (const int node : body.nodes) work(static_cast<std::size_t>(node));
}

/// Rᵀ(u - shift) + (Rᵀ - 1)(X - X_c): differences of small numbers only.
Vec2 elastic_of(const Model& model, const FreeBody& body, const Pose& pose, std::size_t k,
                Vec2 u) noexcept {
  const double c = pose.rotation.re, s = pose.rotation.im;
  const Complex back_minus_one = {c > 0.0 ? -s * s / (1.0 + c) : c - 1.0, -s};
  return conj(pose.rotation) * (u - (pose.center - body.center)) +
         back_minus_one * arm_of(model, body, k);
}

/// Gradient of one body (9.5): R p minus the part due to the rotation of the frame with the nodes.
void body_gradient(const Model& model, const FreeBody& body, const Pose& pose,
                   std::span<const Vec2> elastic, std::span<const Vec2> product,
                   std::span<Vec2> gradient) noexcept {
  double moment = 0.0, inertia = 0.0;  // τ and |Z|
  for_nodes(body, [&](std::size_t k) {
    const Vec2 arm = arm_of(model, body, k), now = arm + elastic[k];
    moment += cross(now, product[k]);
    inertia += model.mass[k] * dot(arm, now);
  });
  const Complex turning = moment / inertia * turn90(pose.rotation);
  for_nodes(body, [&](std::size_t k) {
    gradient[k] = pose.rotation * product[k] - model.mass[k] * (turning * arm_of(model, body, k));
  });
}

}  // namespace

Pose mean_pose(const Model& model, const FreeBody& body, std::span<const Vec2> u,
               const Pose& before) noexcept {
  Vec2 moved;      // Σ m u
  Complex turned;  // Z = Σ m conj(X - X_c)(x - x_c)
  for_nodes(body, [&](std::size_t k) { moved += model.mass[k] * u[k]; });
  const Vec2 shift = moved / body.mass;
  for_nodes(body, [&](std::size_t k) {
    const Vec2 arm = arm_of(model, body, k);
    turned += model.mass[k] * rotation_between(arm, arm + (u[k] - shift));
  });
  Pose pose;
  pose.center = body.center + shift;
  pose.rotation = turned / norm(turned);
  const Complex step = pose.rotation * conj(before.rotation);
  pose.angle = before.angle + std::atan2(step.im, step.re);
  return pose;
}

void update_poses(const Model& model, std::span<const Vec2> u, std::span<Pose> poses) noexcept {
  RONDO_DEMAND(poses.size() == model.free_bodies.size(), poses.size());
  for (std::size_t b = 0; b < poses.size(); ++b)
    poses[b] = mean_pose(model, model.free_bodies[b], u, poses[b]);
}

Vec2 elastic_displacement(const Model& model, std::span<const Pose> poses, std::size_t node,
                          Vec2 u) noexcept {
  if (!in_fixed_frame(model, node)) return u;
  const auto b = static_cast<std::size_t>(model.free_body[node]);
  return elastic_of(model, model.free_bodies[b], poses[b], node, u);
}

void elastic_displacements(const Model& model, std::span<const Vec2> u, std::span<const Pose> poses,
                           std::span<Vec2> elastic) noexcept {
  std::copy(u.begin(), u.end(), elastic.begin());
  for (std::size_t b = 0; b < poses.size(); ++b)
    for_nodes(model.free_bodies[b], [&](std::size_t k) {
      elastic[k] = elastic_of(model, model.free_bodies[b], poses[b], k, u[k]);
    });
}

void to_gradient(const Model& model, std::span<const Vec2> elastic, std::span<const Vec2> product,
                 std::span<const Pose> poses, std::span<Vec2> gradient) noexcept {
  std::copy(product.begin(), product.end(), gradient.begin());
  for (std::size_t b = 0; b < poses.size(); ++b)
    body_gradient(model, model.free_bodies[b], poses[b], elastic, product, gradient);
}

}  // namespace rondo::dynamics
