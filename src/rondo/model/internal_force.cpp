// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/internal_force.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/model/internal_work.hpp"
#include "rondo/model/viscous_branches.hpp"

namespace rondo::dynamics {
namespace {

void demand_size(std::size_t n, const SavedState& saved) {
  RONDO_DEMAND(saved.force.size() == n && saved.gradient.size() == n, n, saved.force.size(),
               saved.gradient.size());
}

/// K u in the co-rotating frame.
class AssembledStiffness final : public InternalForce {
 public:
  AssembledStiffness(const Model& model, std::span<const Vec2> u0)
      : model_(model), force_(model.n_nodes()), before_(model.n_nodes()) {
    evaluate(u0);
  }

  void evaluate(std::span<const Vec2> u) noexcept override {
    std::swap(force_, before_);
    apply(model_.stiffness, u, force_, model_.threads);
  }
  [[nodiscard]] std::span<const Vec2> gradient() const noexcept override { return force_; }
  /// ½ u_{n+1}ᵀ K u_n
  [[nodiscard]] double half_step_energy(std::span<const Vec2> u,
                                        std::span<const Vec2>) const noexcept override {
    double energy = 0.0;
    for_free_nodes(model_, [&](std::size_t k) { energy += 0.5 * dot(u[k], before_[k]); });
    return energy;
  }
  void damping(std::span<Vec2> out) noexcept override {
    const double rate = model_.stiffness_damping / model_.dt;
    for_free_nodes(model_, [&](std::size_t k) { out[k] = rate * (force_[k] - before_[k]); });
  }
  void save(SavedState& saved) const override { saved.force = saved.gradient = force_; }
  void restore(const SavedState& saved) override {
    demand_size(model_.n_nodes(), saved);
    force_ = to_vector(saved.force.plane());
  }

 private:
  const Model& model_;
  std::vector<Vec2> force_, before_;  ///< (n) K u_{n+1}, K u_n                        [N/m]
};

/// K u and viscous branches, whose work is kept as that of rubber is (hyperelastic.cpp).
class ViscousStiffness final : public InternalForce {
 public:
  ViscousStiffness(const Model& model, std::span<const Vec2> u0)
      : model_(model),
        branches_(model.viscous, u0, model.dt, model.threads),
        force_(model.n_nodes()),
        before_(model.n_nodes()) {
    apply(model.stiffness, u0, force_, model.threads);
    work_.start(u0, elastic_energy(u0));
    report_.internal_work = report_.stored_energy = work_.value();
  }

  void evaluate(std::span<const Vec2> u) noexcept override {
    std::swap(force_, before_);
    apply(model_.stiffness, u, force_, model_.threads);
    const double elastic = elastic_energy(u);
    branches_.move(u);
    const std::span<const Vec2> more = branches_.force();
    for_free_nodes(model_, [&](std::size_t k) { force_[k] += more[k]; });
    half_step_energy_ = work_.add(model_, u, before_, force_);
    loss_.add(branches_.lost());
    report_ = {.internal_work = work_.value(),
               .stored_energy = elastic + branches_.stored(),
               .window_work = 0.0,
               .dissipation_viscous = loss_.value(),
               .least_volume = 1.0};
  }
  [[nodiscard]] std::span<const Vec2> gradient() const noexcept override { return force_; }
  [[nodiscard]] double half_step_energy(std::span<const Vec2>,
                                        std::span<const Vec2>) const noexcept override {
    return half_step_energy_;
  }
  /// β acts on K u alone, because the branches have a loss of their own.
  void damping(std::span<Vec2> out) noexcept override {
    const double rate = model_.stiffness_damping / model_.dt;
    const std::span<const Vec2> now = branches_.force(), before = branches_.force_before();
    for_free_nodes(model_, [&](std::size_t k) {
      out[k] = rate * ((force_[k] - now[k]) - (before_[k] - before[k]));
    });
  }
  [[nodiscard]] MaterialReport material() const noexcept override { return report_; }

  void save(SavedState& saved) const override {
    saved.force = saved.gradient = force_;
    const CompensatedSum& work = work_.sum();
    saved.internal_work = {work.sum(), work.correction(), loss_.sum(), loss_.correction()};
    saved.branches = branches_.save();
  }
  void restore(const SavedState& saved) override {
    demand_size(model_.n_nodes(), saved);
    RONDO_DEMAND(saved.internal_work.size() == 4, saved.internal_work.size());
    const Field& u = model_.rim ? saved.u_before : saved.u;
    force_ = to_vector(saved.force.plane());
    work_.restore(u.plane(), {saved.internal_work[0], saved.internal_work[1]});
    loss_ = {saved.internal_work[2], saved.internal_work[3]};
    branches_.restore(work_.u(), saved.branches);
  }

 private:
  /// ½ uᵀ K u, while the force is K u.
  [[nodiscard]] double elastic_energy(std::span<const Vec2> u) const noexcept {
    double energy = 0.0;
    for_free_nodes(model_, [&](std::size_t k) { energy += 0.5 * dot(u[k], force_[k]); });
    return energy;
  }

  const Model& model_;
  ViscousBranches<fem::BlockCsr> branches_;
  std::vector<Vec2> force_, before_;  ///< (n) f_{n+1}, f_n                              [N/m]
  InternalWork<Vec2> work_;           ///< A                                             [J/m]
  CompensatedSum loss_;               ///< of the branches                               [J/m]
  double half_step_energy_ = 0.0;     ///< [J/m]
  MaterialReport report_;
};

/// Free bodies, possibly beside clamped ones: small strain in the frame of each body's mean
/// rotation (corotated.hpp).
class Corotated final : public InternalForce {
 public:
  Corotated(const Model& model, std::span<const Vec2> u0, std::span<const Pose> poses)
      : model_(model),
        poses_(poses.begin(), poses.end()),
        elastic_(model.n_nodes()),
        product_(model.n_nodes()),
        before_(model.n_nodes()),
        gradient_(model.n_nodes()),
        gradient_before_(model.n_nodes()),
        energy_(model.free_bodies.size()),
        energy_before_(model.free_bodies.size()) {
    RONDO_DEMAND(poses_.size() == energy_.size(), poses_.size(), energy_.size());
    evaluate(u0);
  }

  void evaluate(std::span<const Vec2> u) noexcept override {
    std::swap(product_, before_);
    std::swap(gradient_, gradient_before_);
    std::swap(energy_, energy_before_);
    update_poses(model_, u, poses_);
    elastic_displacements(model_, u, poses_, elastic_);
    apply(model_.stiffness, elastic_, product_, model_.threads);
    to_gradient(model_, elastic_, product_, poses_, gradient_);
    find_energies();
  }
  [[nodiscard]] std::span<const Vec2> gradient() const noexcept override { return gradient_; }
  /// ½ u_{n+1}ᵀ K u_n; for free bodies the equivalent by energies and their derivatives (9.7).
  [[nodiscard]] double half_step_energy(std::span<const Vec2> u,
                                        std::span<const Vec2> v) const noexcept override {
    double strain = 0.0;
    for_free_nodes(model_, [&](std::size_t k) {
      if (!in_fixed_frame(model_, k))
        strain += 0.5 * dot(u[k], before_[k]);
      else
        strain -= 0.25 * model_.dt * dot(v[k], gradient_[k] - gradient_before_[k]);
    });
    for (std::size_t b = 0; b < energy_.size(); ++b)
      strain += 0.5 * (energy_[b] + energy_before_[b]);
    return strain;
  }
  /// β K ė, rotated and balanced like the elastic force, so that it has no moment either (9.6).
  void damping(std::span<Vec2> out) noexcept override {
    const double rate = model_.stiffness_damping / model_.dt;
    for_free_nodes(model_, [&](std::size_t k) { before_[k] = rate * (product_[k] - before_[k]); });
    to_gradient(model_, elastic_, before_, poses_, out);
  }
  [[nodiscard]] std::span<const Pose> poses() const noexcept override { return poses_; }
  void save(SavedState& saved) const override {
    saved.force = product_;
    saved.gradient = gradient_;
    saved.energy = energy_;
    saved.poses = poses_;
  }
  void restore(const SavedState& saved) override {
    demand_size(model_.n_nodes(), saved);
    RONDO_DEMAND(saved.energy.size() == energy_.size() && saved.poses.size() == energy_.size(),
                 saved.energy.size(), saved.poses.size());
    product_ = to_vector(saved.force.plane());
    gradient_ = saved.gradient;
    energy_ = saved.energy;
    poses_ = saved.poses;
  }

 private:
  /// ½ Σ eᵀ K e of each free body.
  void find_energies() noexcept {
    for (std::size_t b = 0; b < energy_.size(); ++b) {
      energy_[b] = 0.0;
      for (const int node : model_.free_bodies[b].nodes) {
        const auto k = static_cast<std::size_t>(node);
        energy_[b] += 0.5 * dot(elastic_[k], product_[k]);
      }
    }
  }

  const Model& model_;
  std::vector<Pose> poses_;
  std::vector<Vec2> elastic_;                     ///< (n) e                            [m]
  std::vector<Vec2> product_, before_;            ///< (n) K e_{n+1}, K e_n             [N/m]
  std::vector<Vec2> gradient_, gradient_before_;  ///< (n)                              [N/m]
  std::vector<double> energy_, energy_before_;    ///< (free_bodies) ½ eᵀ K e           [J/m]
};

}  // namespace

std::unique_ptr<InternalForce> make_internal_force(const Model& model, std::span<const Vec2> u0,
                                                   std::span<const Pose> poses) {
  if (model.internal_force) return model.internal_force(model, u0, poses);
  RONDO_DEMAND(!model.rubber);  // it has its own internal force
  RONDO_DEMAND(model.stiffness.row_start.size() == model.n_nodes() + 1, model.n_nodes());
  if (!model.viscous.empty()) return std::make_unique<ViscousStiffness>(model, u0);
  if (model.free_bodies.empty()) return std::make_unique<AssembledStiffness>(model, u0);
  return std::make_unique<Corotated>(model, u0, poses);
}

}  // namespace rondo::dynamics
