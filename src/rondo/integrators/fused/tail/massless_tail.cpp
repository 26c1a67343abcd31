// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/tail/massless_tail.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/massless/ring_arc.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {
namespace {

/// Places of nodes in a set.
std::vector<std::size_t> places_of(const Model& model, const NodeSet& set,
                                   std::span<const int> nodes) {
  std::vector<int> place(model.n_nodes(), -1);
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set.node[i] >= 0) place[at(set.node[i])] = static_cast<int>(i);
  std::vector<std::size_t> places;
  for (const int node : nodes) {
    RONDO_DEMAND(place[at(node)] >= 0, node);
    places.push_back(at(place[at(node)]));
  }
  return places;
}

/// A node set and its fields, as last read.
struct Part {
  explicit Part(NodesInStep&& of)
      : nodes(std::move(of.nodes)), fields(*of.fields), u(size()), v(size()) {}
  [[nodiscard]] std::size_t size() const noexcept { return nodes.size(); }

  const NodeSet nodes;
  NodeFields& fields;
  PlaneField u, v;
};

class MasslessTail final : public StepTail {
 public:
  MasslessTail(const Model& model, NodesInStep ring, NodesInStep around, RingProduct product)
      : model_(model),
        contact_(model),
        ring_(std::move(ring)),
        around_(std::move(around)),
        ring_place_(places_of(model, ring_.nodes, contact_.nodes())),
        around_place_(places_of(model, around_.nodes, contact_.neighbours())),
        held_(model.contact->nodes.size(), 1),
        before_(ring_.size()),
        next_(ring_.size()),
        velocity_(ring_.size()),
        force_(damped() ? ring_.size() : 0),
        force_before_(force_.size()) {
    if (ring_.nodes.sectors > 0 && RingArc::fits(model)) find_arc(product);
    active_.reserve(model.contact->nodes.size());
    start();
  }

  /// Takes what it has written in the step before, or reads it where it has written nothing.
  void before() noexcept override {
    if (std::exchange(is_known_, true)) {
      std::swap(ring_.u, next_);
      std::swap(before_, velocity_);
      std::swap(force_before_, force_);
      return;
    }
    ring_.fields.read_displacement(ring_.u);
    ring_.fields.read_velocity(before_);
    if (damped()) ring_.fields.read_force(force_before_);
  }

  void after(const StepContext& step, PartialStep& part) noexcept override {
    part = {};
    read_around();
    find_ring(*step.contact);
    if (damped()) correct_dissipation(part.sums);
    ring_.fields.write(next_, velocity_);
    part.contact = contact_.report(*step.contact, step.frame.center.plane(), active_);
    if (model_.friction_work) add_friction(*step.contact);
  }

  [[nodiscard]] const char* held() const noexcept override { return held_.data(); }
  void save_active(std::vector<ActiveContact>& active) const override {
    active.insert(active.end(), active_.begin(), active_.end());
  }
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return contact_.coupled().difficult.take();
  }
  void save(SavedState& saved) const override { saved.ring = contact_.save(); }
  void restore(const SavedState& saved) override {
    contact_.restore(saved.ring);
    is_known_ = false;
  }

 private:
  [[nodiscard]] bool damped() const noexcept { return model_.stiffness_damping > 0.0; }

  /// Which of the rows around are which of the arc's.
  void find_arc(RingProduct product) {
    arc_.emplace(model_, product);
    const fem::SectorStiffness& k = *model_.sector;
    for (const int row : arc_->rows_around())
      for (std::size_t i = 0; i < around_.size(); i += around_.nodes.row_size)
        if (around_.nodes.node[i] == k.nodes[at(row)]) around_row_.push_back(i);
    RONDO_DEMAND(around_row_.size() == arc_->rows_around().size(), around_row_.size());
  }

  /// u_1 and v_{1/2} of the ring, and its contacts at t_1, from u_0: the fields are half a step on.
  void start() {
    const FrameStep frame = frame_step(model_.motion, 0, model_.dt);
    const VelocityUpdate update =
        velocity_update(model_.scheme, model_.dt, model_.mass_damping, frame.spin);
    before();
    for (std::size_t i = 0; i < ring_.size(); ++i)
      ring_.u.put(i, ring_.u.at(i) - model_.dt * before_.at(i));
    read_around();
    find_ring(ContactStep(model_, frame, update));
    ring_.fields.write(next_, velocity_);
    is_known_ = false;  // but for the force
  }

  void add_friction(const ContactStep& step) noexcept {
    for (const ActiveContact& c : active_) {
      const Vec2 arm = model_.reference[at(contact_.nodes()[c.candidate])] +
                       contact_.motion().place[c.candidate];
      model_.friction_work->add(step.rotation * arm, {&c, 1});
    }
  }

  void read_around() noexcept {
    around_.fields.read_displacement(around_.u);
    if (damped()) around_.fields.read_velocity(around_.v);
  }

  /// u_{n+2} and v_{n+3/2} of the ring, from u_{n+1} in ring_.u.
  void find_ring(const ContactStep& step) noexcept {
    if (arc_ && follow_arc(step)) {
      const double rate = 1.0 / model_.dt;
      for (std::size_t i = 0; i < ring_.size(); ++i) {
        velocity_.x[i] = rate * (next_.x[i] - ring_.u.x[i]);
        velocity_.y[i] = rate * (next_.y[i] - ring_.u.y[i]);
      }
      for (const RingContact& c : contact_.now().contacts) show(at(c.node));
      return;
    }
    show_all();
    contact_.solve(step);
    for (std::size_t k = 0; k < ring_place_.size(); ++k) {
      const std::size_t i = ring_place_[k];
      velocity_.put(i, conj(ring_.nodes.turn[i]) * std::as_const(contact_).velocity()[k]);
      next_.put(i, ring_.u.at(i) + model_.dt * velocity_.at(i));
    }
  }

  /// False: the arc does not do it.
  bool follow_arc(const ContactStep& step) noexcept {
    const auto n = at(model_.sector->n_sectors);
    const double beta = model_.stiffness_damping;
    const auto rows = static_cast<int>(around_row_.size());
    for (int a = 0; a < rows; ++a) {
      const std::size_t from = around_row_[at(a)];
      double *x = arc_->around().row(a), *y = arc_->around().row(rows + a);
      std::copy_n(around_.u.x.data() + from, n, x);
      std::copy_n(around_.u.y.data() + from, n, y);
      for (std::size_t j = 0; damped() && j < n; ++j) {
        x[j] += beta * around_.v.x[from + j];
        y[j] += beta * around_.v.y[from + j];
      }
    }
    if (!arc_->solve(step, ring_.u, contact_.next(), {next_, found_})) return false;
    contact_.take_over(found_);
    return true;
  }

  /// Shows a candidate's motion to the report.
  void show(std::size_t k) noexcept {
    const std::size_t i = ring_place_[k];
    const Complex turn = ring_.nodes.turn[i];
    contact_.motion().place[k] = turn * ring_.u.at(i);
    contact_.motion().before[k] = turn * before_.at(i);
    contact_.velocity()[k] = turn * velocity_.at(i);
  }

  void show_all() noexcept {
    RingMotion& motion = contact_.motion();
    for (std::size_t k = 0; k < ring_place_.size(); ++k) {
      const std::size_t i = ring_place_[k];
      motion.place[k] = ring_.nodes.turn[i] * ring_.u.at(i);
      motion.before[k] = ring_.nodes.turn[i] * before_.at(i);
    }
    for (std::size_t k = 0; k < around_place_.size(); ++k) {
      const std::size_t i = around_place_[k];
      motion.place[ring_place_.size() + k] = around_.nodes.turn[i] * around_.u.at(i);
      motion.rate[k] = around_.nodes.turn[i] * around_.v.at(i);
    }
  }

  /// The pass has moved the ring as if it had no force: what that was in its sums.
  void correct_dissipation(StepSums& sums) noexcept {
    ring_.fields.read_velocity(ring_.v);
    ring_.fields.read_force(force_);
    double x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      x += (velocity_.x[i] - ring_.v.x[i]) * (force_.x[i] - force_before_.x[i]);
      y += (velocity_.y[i] - ring_.v.y[i]) * (force_.y[i] - force_before_.y[i]);
    }
    sums[kernels::sum_stiffness] += x + y;
  }

  const Model& model_;
  MasslessContact contact_;
  std::optional<RingArc> arc_;
  RingContacts found_;
  Part ring_, around_;
  const std::vector<std::size_t> ring_place_, around_place_;  ///< by candidate, by neighbour
  std::vector<std::size_t> around_row_;                       ///< where the arc's rows around begin
  const std::vector<char> held_;
  PlaneField before_;                ///< v_{n+1/2} of the ring
  PlaneField next_, velocity_;       ///< u_{n+2}, v_{n+3/2} of the ring
  PlaneField force_, force_before_;  ///< K u_{n+1}, K u_n, with β                    [N/m]
  std::vector<ActiveContact> active_;
  bool is_known_ = false;  ///< u_{n+1}, v_{n+1/2} and K u_n of the ring are those of the last step
};

}  // namespace

std::unique_ptr<StepTail> massless_tail(const Model& model, NodesInStep ring, NodesInStep around,
                                        RingProduct product) {
  RONDO_DEMAND(has_massless_contact(model) && model.contact && ring.fields && around.fields,
               ring.nodes.size(), around.nodes.size());
  RONDO_DEMAND(ring.nodes.size() >= model.contact->nodes.size() && product, ring.nodes.size(),
               model.contact->nodes.size());
  return std::make_unique<MasslessTail>(model, std::move(ring), std::move(around), product);
}

std::vector<int> massless_nodes(const Model& model) {
  std::vector<int> nodes = model.contact->nodes;
  std::ranges::sort(nodes);
  return nodes;
}

std::vector<int> nodes_around(const Model& model) {
  return nodes_beside(model.stiffness, model.contact->nodes);
}

std::vector<int> sectors_around(const Model& model) {
  RONDO_DEMAND(model.sector && model.contact, model.n_nodes());
  const fem::SectorStiffness& k = *model.sector;
  std::vector<char> is_around(at(k.nodes_per_sector), 0);
  for (const int node : nodes_around(model)) is_around[at(node % k.nodes_per_sector)] = 1;
  std::vector<int> nodes;
  for (int node = 0; node < k.n_sectors * k.nodes_per_sector; ++node)
    if (is_around[at(node % k.nodes_per_sector)]) nodes.push_back(node);
  return nodes;
}

}  // namespace rondo::dynamics
