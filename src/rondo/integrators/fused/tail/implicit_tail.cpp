// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/tail/implicit_tail.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {
namespace {

/// Force of a load on one of the nodes, per pressure, in its components.
struct LoadOnNode {
  std::size_t place;
  int load;
  Vec2 force;  ///< [m]
};

std::vector<LoadOnNode> loads_on(const Model& model, const NodeSet& nodes) {
  std::vector<LoadOnNode> loads;
  if (model.pressures.empty()) return loads;
  std::vector<int> place(model.n_nodes(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.node[i] >= 0) place[static_cast<std::size_t>(nodes.node[i])] = static_cast<int>(i);
  for (const NodalLoad& l : nodal_loads(model)) {
    const int at = place[static_cast<std::size_t>(l.node)];
    if (at < 0) continue;
    const auto i = static_cast<std::size_t>(at);
    loads.push_back({i, l.load, conj(nodes.turn[i]) * l.force});
  }
  return loads;
}

class ImplicitTail final : public StepTail {
 public:
  ImplicitTail(const Model& model, NodeSet nodes, std::unique_ptr<ImplicitOperator> implicit,
               NodeFields& fields)
      : model_(model),
        fields_(fields),
        elements_(model, std::move(nodes), std::move(implicit), factored_spin(model)),
        loads_(loads_on(model, elements_.nodes())),
        u_(size()),
        v_(size()),
        explicit_(size()),
        force_(damped() ? size() : 0),
        force_before_(damped() ? size() : 0) {}

  void before() noexcept override {
    fields_.read_displacement(elements_.u());
    fields_.read_velocity(elements_.before());
    if (damped()) fields_.read_force(force_before_);
  }

  void after(const StepContext& step, PartialStep& part) noexcept override {
    part = {};
    RONDO_ASSERT(loads_.empty() || step.pressures, loads_.size());
    fields_.read_velocity(v_);
    explicit_ = v_;
    const ImplicitEnergy energy =
        elements_.solve(step.frame.spin, step.contact ? &*step.contact : nullptr, v_, part.contact);
    if (model_.friction_work && elements_.contact())
      elements_.contact()->add_friction(*step.contact, *model_.friction_work);
    const PlaneField& u = elements_.u();
    for (std::size_t i = 0; i < size(); ++i) {
      u_.x[i] = u.x[i] + model_.dt * v_.x[i];
      u_.y[i] = u.y[i] + model_.dt * v_.y[i];
    }
    fields_.write(u_, v_);
    correct_sums(step, part.sums);
    part.sums[kernels::sum_strain] += 2.0 * energy.strain;
    if (damped())
      part.sums[kernels::sum_stiffness] +=
          2.0 * energy.dissipation_stiffness / model_.stiffness_damping;
  }

  [[nodiscard]] const char* held() const noexcept override {
    return elements_.contact() ? elements_.contact()->is_held().data() : nullptr;
  }
  void save_active(std::vector<ActiveContact>& active) const override {
    if (!elements_.contact()) return;
    const std::vector<ActiveContact>& own = elements_.contact()->active();
    active.insert(active.end(), own.begin(), own.end());
  }
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return elements_.contact() ? elements_.contact()->coupled().difficult.take()
                               : std::vector<contact::ProblemFile>{};
  }
  void save(SavedState& saved) const override {
    if (!elements_.contact()) return;
    const auto& own = elements_.contact()->coupled().kept;
    saved.impulses.insert(saved.impulses.end(), own.begin(), own.end());
  }
  void restore(const SavedState& saved) override {
    if (elements_.contact()) elements_.contact()->coupled().kept = saved.impulses;
  }

 private:
  [[nodiscard]] std::size_t size() const noexcept { return elements_.nodes().size(); }
  [[nodiscard]] bool damped() const noexcept { return model_.stiffness_damping > 0.0; }

  /// The pass has taken the explicit velocities: what the others change in its sums.
  void correct_sums(const StepContext& step, StepSums& sums) noexcept {
    const kernels::StepFactors& f = step.factors;
    const Complex rate{f.rate_x, f.rate_y};
    const Vec2 pull{f.pull_x, f.pull_y};
    const NodeSet& nodes = elements_.nodes();
    const PlaneField &u = elements_.u(), &before = elements_.before();
    double frame = 0.0, mass = 0.0, stiffness = 0.0;
    if (damped()) fields_.read_force(force_);
    for (std::size_t i = 0; i < size(); ++i) {
      const Vec2 change = v_.at(i) - explicit_.at(i);
      const Vec2 arm = nodes.reference.at(i) + u.at(i);
      frame += nodes.mass[i] * dot(change, rate * arm + conj(nodes.turn[i]) * pull);
      mass += nodes.mass[i] * dot(change, v_.at(i) + explicit_.at(i) + 2.0 * before.at(i));
      if (damped()) stiffness += dot(change, force_.at(i) - force_before_.at(i));
    }
    sums[kernels::sum_frame] += frame;
    sums[kernels::sum_mass] += mass;
    sums[kernels::sum_stiffness] += stiffness;
    for (const LoadOnNode& l : loads_)
      sums[kernels::sum_load] +=
          step.pressures[l.load] * dot(v_.at(l.place) - explicit_.at(l.place), l.force);
  }

  const Model& model_;
  NodeFields& fields_;
  ImplicitElements elements_;
  const std::vector<LoadOnNode> loads_;
  PlaneField u_, v_, explicit_;
  PlaneField force_, force_before_;  ///< K u_{n+1}, K u_n, with β                    [N/m]
};

}  // namespace

std::unique_ptr<StepTail> implicit_tail(const Model& model, NodeSet nodes,
                                        std::unique_ptr<ImplicitOperator> implicit,
                                        NodeFields& fields) {
  RONDO_DEMAND(model.implicit && implicit && nodes.size() >= model.implicit->nodes.size(),
               model.implicit.has_value(), nodes.size());
  return std::make_unique<ImplicitTail>(model, std::move(nodes), std::move(implicit), fields);
}

}  // namespace rondo::dynamics
