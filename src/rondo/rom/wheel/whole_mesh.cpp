// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/whole_mesh.hpp"

#include <memory>
#include <numeric>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/statics/condensation.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXd;

/// K - s²M.
fem::BlockCsr softened(const WholeMesh& whole, std::span<const double> mass, double square) {
  fem::BlockCsr k = whole.stiffness;
  for (const int node : whole.free) {
    fem::BlockCsr::Block& block = *fem::find_block(k, node, node);
    block[0] -= square * mass[at(node)];
    block[3] -= square * mass[at(node)];
  }
  return k;
}

/// (rows) of a field on all nodes.
VectorXd rows_of(std::span<const int> nodes, std::span<const Vec2> field) {
  VectorXd out(static_cast<Index>(2 * nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const Vec2 x = field[at(nodes[a])];
    out.segment<2>(static_cast<Index>(2 * a)) << x.x, x.y;
  }
  return out;
}

/// What forces do beyond the modes, in the whole body.
class Beyond {
 public:
  Beyond(const Ring& ring, const WholeMesh& whole, std::span<const RingHarmonic> harmonics,
         std::span<const double> mass, double square)
      : rows_(ring.stiffness.nodes),
        contact_nodes_(nodes_of(ring)),
        body_(softened(whole, mass, square), whole.free, contact_nodes_) {
    RONDO_DEMAND(harmonics.size() <= 1, harmonics.size());
    if (harmonics.empty()) return;
    shapes_ = harmonics[0].shapes.real();
    contact_ = harmonics[0].contact.real();
    softness_ = (harmonics[0].squares.array() - square).inverse();
  }
  [[nodiscard]] statics::Condensation& body() noexcept { return body_; }

  /// (2C, 2C) G. @pre all contact nodes are in the set of the body
  [[nodiscard]] Eigen::MatrixXd compliance() const {
    // Contact frames of flat ground are (u_y, -u_x).
    const Eigen::MatrixXd& of_ground = body_.compliance();
    Eigen::MatrixXd g(of_ground.rows(), of_ground.cols());
    for (Index i = 0; i < g.rows(); ++i)
      for (Index j = 0; j < g.cols(); ++j)
        g(i, j) = ((i + j) % 2 == 0 ? 1.0 : -1.0) * of_ground(i ^ 1, j ^ 1);
    if (shapes_.size() > 0) g -= contact_ * softness_.asDiagonal() * contact_.transpose();
    return 0.5 * (g + g.transpose());
  }
  /// (rows) by forces on all nodes, of which the modes take φᵀ f.
  [[nodiscard]] VectorXd displacement(std::span<const Vec2> force, const VectorXd& on_modes) const {
    VectorXd u = rows_of(rows_, body_.displacement(force));
    if (shapes_.size() > 0) u -= shapes_ * softness_.cwiseProduct(on_modes);
    return u;
  }
  /// (rows) by forces on the contact nodes. @param force (2C)
  [[nodiscard]] VectorXd by_contact(const VectorXd& force) const {
    std::vector<Vec2> all(body_.n_nodes());
    for (std::size_t c = 0; c < contact_nodes_.size(); ++c) {
      const auto row = static_cast<Index>(2 * c);
      all[at(contact_nodes_[c])] = {force[row], force[row + 1]};
    }
    return displacement(all, contact_.transpose() * force);
  }

 private:
  static std::vector<int> nodes_of(const Ring& ring) {
    std::vector<int> nodes;
    for (const int a : ring.contact)
      nodes.push_back(static_cast<int>(ring.stiffness.node(at(a), 0)));
    return nodes;
  }

  const std::vector<int> rows_, contact_nodes_;  ///< nodes of the mesh
  statics::Condensation body_;
  Eigen::MatrixXd shapes_, contact_;  ///< (rows, r), (2C, r)
  VectorXd softness_;                 ///< (r) 1/(ω² - s²)
};

}  // namespace

fem::SectorStiffness one_sector(const WholeMesh& whole) {
  fem::SectorStiffness s;
  const std::size_t n = whole.stiffness.n_rows();
  s.n_sectors = 1;
  s.nodes_per_sector = static_cast<int>(n);
  s.nodes.assign(whole.free.begin(), whole.free.end());
  s.turn = {Complex{1.0, 0.0}};
  std::vector<int> row(n, -1);
  for (std::size_t a = 0; a < s.nodes.size(); ++a) row[at(s.nodes[a])] = static_cast<int>(a);
  s.row_start.push_back(0);
  for (const int node : s.nodes) {
    const auto first = static_cast<std::size_t>(whole.stiffness.row_start[at(node)]),
               last = static_cast<std::size_t>(whole.stiffness.row_start[at(node) + 1]);
    for (std::size_t e = first; e < last; ++e)
      s.entries.push_back({row[at(whole.stiffness.column[e])], 0, whole.stiffness.values[e]});
    s.row_start.push_back(s.entries.size());
  }
  return s;
}

std::vector<RingHarmonic> whole_modes(const Ring& ring, const WholeMesh& whole,
                                      const ModeChoice& choice) {
  std::vector<double> mass(whole.stiffness.n_rows());
  for (std::size_t a = 0; a < ring.mass.size(); ++a) mass[ring.stiffness.node(a, 0)] = ring.mass[a];
  if (choice.wanted <= 0) return {};
  const modal::Modes found =
      modal::mesh_modes({whole.mesh, whole.stiffness, mass}, 0.0, choice.wanted);
  if (found.unstable > 0) return {};  // whole_residual() tells
  Index n = 0;
  for (const modal::Mode& mode : found.modes) {
    if (mode.omega > choice.highest && n >= choice.fewest) break;
    ++n;
  }
  if (n == 0) return {};
  VectorXd squares(n);
  MatrixXcd shapes(ring.n_rows(), n);
  for (Index j = 0; j < n; ++j) {
    const modal::Mode& mode = found.modes[at(j)];
    squares[j] = mode.omega * mode.omega;
    shapes.col(j) = rows_of(ring.stiffness.nodes, mode.real.plane()).cast<std::complex<double>>();
  }
  return {make_harmonic(ring, 0, std::move(squares), std::move(shapes))};
}

RingResidual whole_residual(const Ring& ring, const WholeMesh& whole,
                            std::span<const RingHarmonic> harmonics, double spin_squared) {
  std::vector<double> mass(whole.stiffness.n_rows());
  std::vector<Vec2> pull(mass.size());
  for (std::size_t a = 0; a < ring.mass.size(); ++a) {
    const std::size_t node = ring.stiffness.node(a, 0);
    mass[node] = ring.mass[a];
    pull[node] = spin_squared * ring.mass[a] * ring.place[a];
  }
  const auto beyond = std::make_shared<Beyond>(ring, whole, harmonics, mass, spin_squared);
  RingResidual out;
  out.n_sectors = 1;
  out.size = ring.n_contact();
  if (!beyond->body().factorised()) {
    out.made_static = {0};
    return out;
  }
  std::vector<std::size_t> all(ring.contact.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  beyond->body().append(all);
  const Eigen::MatrixXd g = beyond->compliance();
  out.blocks.assign(g.data(), g.data() + g.size());
  const VectorXd on_modes =
      harmonics.empty() ? VectorXd() : VectorXd(spin_squared * harmonics[0].reference.real());
  out.centrifugal = beyond->displacement(pull, on_modes);
  beyond->body().clear();
  out.by_contact = [beyond](const VectorXd& force) { return beyond->by_contact(force); };
  return out;
}

}  // namespace rondo::rom
