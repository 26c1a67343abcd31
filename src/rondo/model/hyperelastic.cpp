// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/hyperelastic.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/model/internal_force.hpp"
#include "rondo/model/internal_work.hpp"

namespace rondo::dynamics {
namespace {

using fem::Hyperelasticity;

/// Rotations would cause strain in linear elements, and β would damp them.
void demand_rubber_alone(const Model& model, const Hyperelasticity& body) {
  if (model.free_bodies.empty()) return;
  RONDO_DEMAND(model.stiffness_damping == 0.0, model.stiffness_damping);
  const std::vector<char> alone = body.nodes_of_rubber_alone();
  for (const FreeBody& free : model.free_bodies)
    for (const int node : free.nodes) RONDO_DEMAND(alone[at(node)], node);
}

class Hyperelastic final : public InternalForce {
 public:
  Hyperelastic(const Model& model, std::shared_ptr<const Hyperelasticity> body,
               std::span<const Vec2> u0, std::span<const Pose> poses)
      : model_(model),
        body_(std::move(body)),
        poses_(poses.begin(), poses.end()),
        histories_(body_->relaxed(u0)),
        force_(model.n_nodes()),
        before_(model.n_nodes()) {
    RONDO_DEMAND(body_->n_nodes() == model.n_nodes(), body_->n_nodes(), model.n_nodes());
    RONDO_DEMAND(poses_.size() == model.free_bodies.size(), poses_.size());
    demand_rubber_alone(model, *body_);
    work_.start(u0, body_->gradient(u0, histories_, force_, pass_, model.threads).energy);
    report_.internal_work = report_.stored_energy = work_.value();
  }

  /// Branches relax half a step before the stress and half a step after it, at the strain of u.
  void evaluate(std::span<const Vec2> u) noexcept override {
    std::swap(force_, before_);
    relax(u);
    const fem::Look look = body_->gradient(u, histories_, force_, pass_, model_.threads);
    half_step_energy_ = work_.add(model_, u, before_, force_);
    report_ = {.internal_work = work_.value(),
               .stored_energy = look.energy,
               .window_work = 0.0,
               .dissipation_viscous = loss_.value(),
               .least_volume = look.least.ratio};
    relax(u);
    update_poses(model_, u, poses_);
  }
  [[nodiscard]] std::span<const Vec2> gradient() const noexcept override { return force_; }
  [[nodiscard]] double half_step_energy(std::span<const Vec2>,
                                        std::span<const Vec2>) const noexcept override {
    return half_step_energy_;
  }
  void damping(std::span<Vec2> out) noexcept override {
    const double rate = model_.stiffness_damping / model_.dt;
    for_free_nodes(model_, [&](std::size_t k) { out[k] = rate * (force_[k] - before_[k]); });
  }
  [[nodiscard]] std::span<const Pose> poses() const noexcept override { return poses_; }
  [[nodiscard]] MaterialReport material() const noexcept override { return report_; }

  void save(SavedState& saved) const override {
    saved.force = saved.gradient = force_;
    saved.energy.assign(poses_.size(), 0.0);  // free bodies have no separate energies
    saved.poses = poses_;
    const CompensatedSum& work = work_.sum();
    saved.internal_work = {work.sum(), work.correction(), loss_.sum(), loss_.correction()};
    saved.branches.clear();
    for (const Hyperelasticity::History& c : histories_)
      saved.branches.insert(saved.branches.end(), {c.xx, c.yy, c.xy});
  }
  void restore(const SavedState& saved) override {
    const Field& u = model_.rim ? saved.u_before : saved.u;
    RONDO_DEMAND(saved.force.size() == force_.size() && u.size() == force_.size() &&
                     saved.poses.size() == poses_.size() && saved.internal_work.size() == 4 &&
                     saved.branches.size() == 3 * histories_.size(),
                 saved.force.size(), u.size(), saved.branches.size());
    force_ = to_vector(saved.force.plane());
    poses_ = saved.poses;
    work_.restore(u.plane(), {saved.internal_work[0], saved.internal_work[1]});
    loss_ = {saved.internal_work[2], saved.internal_work[3]};
    for (std::size_t i = 0; i < histories_.size(); ++i)
      histories_[i] = {saved.branches[3 * i], saved.branches[3 * i + 1], saved.branches[3 * i + 2]};
  }

 private:
  void relax(std::span<const Vec2> u) {
    loss_.add(body_->relax(u, 0.5 * model_.dt, histories_, pass_, model_.threads));
  }

  const Model& model_;
  const std::shared_ptr<const Hyperelasticity> body_;
  Hyperelasticity::Pass pass_;
  std::vector<Pose> poses_;
  std::vector<Hyperelasticity::History> histories_;  ///< half a step after u
  std::vector<Vec2> force_, before_;                 ///< (n) f_{n+1}, f_n               [N/m]
  InternalWork<Vec2> work_;                          ///< A                              [J/m]
  CompensatedSum loss_;                              ///< of the branches                [J/m]
  double half_step_energy_ = 0.0;                    ///< [J/m]
  MaterialReport report_;
};

/// K of the linear cells.
fem::BlockCsr linear_stiffness(const mesh::Mesh& mesh, std::span<const fem::Material> materials) {
  std::vector<char> linear;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    linear.push_back(fem::material_of(mesh, materials, e).rubber ? 0 : 1);
  return fem::assemble_stiffness(mesh::mesh_of_cells(mesh, linear), materials);
}

}  // namespace

InternalForceMaker hyperelastic_maker(std::shared_ptr<const Hyperelasticity> body) {
  return [body = std::move(body)](const Model& model, std::span<const Vec2> u0,
                                  std::span<const Pose> poses) {
    return std::make_unique<Hyperelastic>(model, body, u0, poses);
  };
}

RubberPart rubber_part(const mesh::Mesh& mesh, std::span<const fem::Material> materials) {
  RubberPart part;
  std::vector<int> place;  // index for each material
  for (const fem::Material& m : materials) {
    place.push_back(m.rubber ? static_cast<int>(part.materials.size()) : -1);
    if (m.rubber) part.materials.push_back(*m.rubber);
  }
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const auto m =
        static_cast<std::size_t>(&fem::material_of(mesh, materials, e) - materials.data());
    if (place[m] < 0) continue;
    part.cells.push_back(mesh.cells[e]);
    part.material.push_back(place[m]);
  }
  part.linear = linear_stiffness(mesh, materials);
  return part;
}

}  // namespace rondo::dynamics
