// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/implicit/ring_operator.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/implicit/circulant.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {
namespace {

constexpr std::size_t row_lanes = 8;

/// Blocks of K_I, in polar components; symmetric to the last bit.
RingBlocks blocks_of(const Model& model, const NodeSet& nodes) {
  const fem::BlockCsr& k = model.implicit->stiffness;
  const fem::SectorStiffness& sector = *model.sector;
  const auto n_rows = static_cast<Eigen::Index>(nodes.size() / nodes.row_size);
  const Eigen::Index size = 2 * n_rows;
  RingBlocks blocks{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size),
                    Eigen::MatrixXd::Zero(size, size)};
  std::vector<int> row_of(static_cast<std::size_t>(sector.nodes_per_sector), -1);
  for (std::size_t a = 0; a < static_cast<std::size_t>(n_rows); ++a)
    row_of[static_cast<std::size_t>(nodes.node[a * nodes.row_size])] = static_cast<int>(a);
  for (Eigen::Index a = 0; a < n_rows; ++a) {
    const auto node =
        static_cast<std::size_t>(nodes.node[static_cast<std::size_t>(a) * nodes.row_size]);
    for (auto at = k.row_start[node]; at < k.row_start[node + 1]; ++at) {
      const auto e = static_cast<std::size_t>(at);
      const int other = k.column[e], j = other / sector.nodes_per_sector;
      const Eigen::Index b = row_of[static_cast<std::size_t>(other % sector.nodes_per_sector)];
      RONDO_DEMAND(b >= 0 && (j <= 1 || j == sector.n_sectors - 1), other, j);
      Eigen::MatrixXd& block = j == 0 ? blocks.here : j == 1 ? blocks.right : blocks.left;
      const Complex turn = sector.turn[static_cast<std::size_t>(j)];
      const fem::BlockCsr::Block& v = k.values[e];
      for (const Eigen::Index c : {Eigen::Index{0}, Eigen::Index{1}}) {
        const double x = v[static_cast<std::size_t>(c)], y = v[static_cast<std::size_t>(c + 2)];
        block(c * n_rows + a, b) += x * turn.re + y * turn.im;
        block(c * n_rows + a, n_rows + b) += y * turn.re - x * turn.im;
      }
    }
  }
  blocks.here = (0.5 * (blocks.here + blocks.here.transpose())).eval();
  blocks.right = (0.5 * (blocks.right + blocks.left.transpose())).eval();
  blocks.left = blocks.right.transpose();
  return blocks;
}

/// A of (3.9).
RingBlocks step_blocks(const Model& model, const NodeSet& nodes, const RingBlocks& stiffness,
                       double spin) {
  const double dt = model.dt;
  const double share = 0.25 * dt * dt + 0.5 * dt * model.stiffness_damping;
  RingBlocks a{share * stiffness.left, share * stiffness.here, share * stiffness.right};
  const Complex by = velocity_update(model.scheme, dt, model.mass_damping, spin).a;
  const Eigen::Index n = a.here.rows() / 2;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Complex ma = nodes.mass[static_cast<std::size_t>(i) * nodes.row_size] * by;
    a.here(i, i) += ma.re;
    a.here(n + i, n + i) += ma.re;
    a.here(i, n + i) -= ma.im;
    a.here(n + i, i) += ma.im;
  }
  return a;
}

class Ring final : public ImplicitOperator {
 public:
  Ring(const Model& model, const NodeSet& nodes, const RingBlocks& stiffness, double spin,
       RingProduct loop)
      : n_rows_(static_cast<int>(nodes.size() / nodes.row_size)),
        sectors_(nodes.sectors),
        row_size_(nodes.row_size),
        left_(stiffness.left),
        here_(stiffness.here),
        right_(stiffness.right),
        factor_(sectors_, step_blocks(model, nodes, stiffness, spin), loop),
        product_(loop),
        in_(2 * n_rows_, sectors_),
        out_(2 * n_rows_, sectors_) {}

  void solve(PlaneField& x) noexcept override {
    take(x);
    factor_.solve(in_);
    give(in_, x);
  }
  void product(const PlaneField& v, PlaneField& out) noexcept override {
    take(v);
    in_.wrap(1);
    product_({.rows = 2 * n_rows_,
              .columns = 2 * n_rows_,
              .sectors = sectors_,
              .n_terms = 3,
              .with_self = false,
              .matrix = {left_.data(), here_.data(), right_.data()},
              .offset = {-1, 0, 1},
              .in = in_.row(0),
              .out = out_.row(0),
              .stride = in_.stride()});
    give(out_, out);
  }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  void take(const PlaneField& x) noexcept {
    RONDO_ASSERT(x.size() == static_cast<std::size_t>(n_rows_) * row_size_, x.size(), n_rows_);
    for (int a = 0; a < n_rows_; ++a) {
      const std::size_t from = static_cast<std::size_t>(a) * row_size_;
      std::copy_n(x.x.data() + from, sectors_, in_.row(a));
      std::copy_n(x.y.data() + from, sectors_, in_.row(n_rows_ + a));
    }
  }
  void give(const RingRows& rows, PlaneField& x) const noexcept {
    for (int a = 0; a < n_rows_; ++a) {
      const std::size_t to = static_cast<std::size_t>(a) * row_size_;
      std::copy_n(rows.row(a), sectors_, x.x.data() + to);
      std::copy_n(rows.row(n_rows_ + a), sectors_, x.y.data() + to);
    }
  }

  int n_rows_, sectors_;
  std::size_t row_size_;
  Matrix left_, here_, right_;  ///< blocks of K_I
  Circulant factor_;            ///< factor of A
  RingProduct product_;
  RingRows in_, out_;
};

}  // namespace

NodeSet ring_nodes(const Model& model, std::span<const int> nodes) {
  RONDO_DEMAND(model.sector.has_value(), nodes.size());
  const fem::SectorStiffness& k = *model.sector;
  NodeSet set;
  set.sectors = k.n_sectors;
  const auto n = static_cast<std::size_t>(k.n_sectors);
  set.row_size = (n + row_lanes - 1) / row_lanes * row_lanes;
  std::vector<int> rows;
  for (const int node : nodes)
    if (node < k.nodes_per_sector) rows.push_back(node);
  RONDO_DEMAND(rows.size() * n == nodes.size(), rows.size(), nodes.size());
  const std::size_t size = rows.size() * set.row_size;
  set.node.assign(size, -1);
  set.mass.assign(size, 0.0);
  set.reference = PlaneField(size);
  set.turn.assign(size, {1.0, 0.0});
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t i = a * set.row_size + j;
      const auto own = static_cast<std::size_t>(rows[a]);
      set.node[i] = static_cast<int>(j) * k.nodes_per_sector + rows[a];
      set.mass[i] = model.mass[own];  // of sector 0, as the steps take it
      set.reference.put(i, model.reference[own]);
      set.turn[i] = k.turn[j];
    }
  return set;
}

std::unique_ptr<ImplicitOperator> ring_operator(const Model& model, const NodeSet& nodes,
                                                double spin, RingProduct product) {
  RONDO_DEMAND(model.implicit && model.sector && nodes.sectors == model.sector->n_sectors &&
                   nodes.size() > 0 && nodes.size() % nodes.row_size == 0,
               nodes.sectors, nodes.size(), nodes.row_size);
  return std::make_unique<Ring>(model, nodes, blocks_of(model, nodes), spin, product);
}

}  // namespace rondo::dynamics
