// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/contract.hpp"
#include "rondo/integrators/implicit/block_lu.hpp"
#include "rondo/integrators/implicit/implicit_operator.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {
namespace {

/// K of these nodes alone, numbered by their places.
fem::BlockCsr part_of(const fem::BlockCsr& k, const NodeSet& nodes) {
  std::vector<int> place(k.n_rows(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    place[static_cast<std::size_t>(nodes.node[i])] = static_cast<int>(i);
  RONDO_DEMAND(nodes.sectors == 0 && nodes.mass.size() == nodes.size(), nodes.sectors,
               nodes.mass.size());  // no places of no node
  fem::BlockCsr part;
  part.row_start.push_back(0);
  for (const int node : nodes.node) {
    const auto row = static_cast<std::size_t>(node);
    for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
      const auto b = static_cast<std::size_t>(at);
      const int column = place[static_cast<std::size_t>(k.column[b])];
      RONDO_DEMAND(column >= 0, node, k.column[b]);
      part.column.push_back(column);
      part.values.push_back(k.values[b]);
    }
    part.row_start.push_back(static_cast<std::int64_t>(part.column.size()));
  }
  return part;
}

class Assembled final : public ImplicitOperator {
 public:
  Assembled(const Model& model, const NodeSet& nodes, double spin)
      : stiffness_(part_of(model.implicit->stiffness, nodes)) {
    const double dt = model.dt;
    const double share = 0.25 * dt * dt + 0.5 * dt * model.stiffness_damping;
    const Complex a = velocity_update(model.scheme, dt, model.mass_damping, spin).a;
    fem::BlockCsr matrix = stiffness_;
    for (std::size_t row = 0; row < nodes.size(); ++row)
      for (auto at = matrix.row_start[row]; at < matrix.row_start[row + 1]; ++at) {
        BlockLu::Block& block = matrix.values[static_cast<std::size_t>(at)];
        for (double& value : block) value *= share;
        if (matrix.column[static_cast<std::size_t>(at)] != static_cast<int>(row)) continue;
        const Complex ma = nodes.mass[row] * a;
        block[0] += ma.re;
        block[1] += ma.im;
        block[2] -= ma.im;
        block[3] += ma.re;
      }
    factor_ = BlockLu(matrix);
  }

  void solve(PlaneField& x) noexcept override {
    RONDO_ASSERT(x.size() == factor_.size(), x.size(), factor_.size());
    factor_.solve(x.x, x.y);
  }
  void product(const PlaneField& v, PlaneField& out) noexcept override {
    RONDO_ASSERT(v.size() == stiffness_.n_rows() && out.size() == v.size(), v.size(), out.size());
    for (std::size_t row = 0; row < v.size(); ++row) {
      Vec2 sum;
      for (auto at = stiffness_.row_start[row]; at < stiffness_.row_start[row + 1]; ++at) {
        const auto b = static_cast<std::size_t>(at);
        const BlockLu::Block& k = stiffness_.values[b];
        const Vec2 w = v.at(static_cast<std::size_t>(stiffness_.column[b]));
        sum += {k[0] * w.x + k[2] * w.y, k[1] * w.x + k[3] * w.y};
      }
      out.put(row, sum);
    }
  }

 private:
  fem::BlockCsr stiffness_;  ///< K_I of the nodes
  BlockLu factor_;           ///< factor of A
};

}  // namespace

NodeSet node_set(const Model& model, std::span<const int> nodes) {
  NodeSet set;
  set.node.assign(nodes.begin(), nodes.end());
  const std::size_t n = set.node.size();
  set.reference = PlaneField(n);
  set.turn.assign(n, {1.0, 0.0});
  for (std::size_t i = 0; i < n; ++i) {
    const auto node = static_cast<std::size_t>(set.node[i]);
    RONDO_ASSERT(node < model.n_nodes(), set.node[i], model.n_nodes());
    set.mass.push_back(model.mass[node]);
    set.reference.put(i, model.reference[node]);
  }
  return set;
}

double factored_spin(const Model& model) noexcept {
  return frame_step(model.motion, 0, model.dt).spin;
}

std::unique_ptr<ImplicitOperator> assembled_operator(const Model& model, const NodeSet& nodes,
                                                     double spin) {
  RONDO_DEMAND(
      model.implicit && model.dt > 0.0 && model.implicit->stiffness.n_rows() == model.n_nodes(),
      model.implicit.has_value(), model.dt, model.n_nodes());
  return std::make_unique<Assembled>(model, nodes, spin);
}

}  // namespace rondo::dynamics
