// SPDX-License-Identifier: BSD-3-Clause
// A disk pressed and drawn by the direct crush and by LATIN, with the candidates of docs/latin.md.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "rondo/mesh/disk.hpp"
#include "rondo/statics/crush.hpp"
#include "rondo/statics/latin/latin.hpp"
#include "rondo/statics/latin/pgd.hpp"
#include "rondo/statics/latin/springs.hpp"

namespace rondo::test {

/// Depth and slide at each increment [m].
struct CrushHistory {
  std::vector<double> depth, slide;
  [[nodiscard]] int size() const { return static_cast<int>(depth.size()); }
};

/// Piecewise linear through the points (share of the increments, depth, slide), from (0, 0, 0).
inline CrushHistory history_of(int increments, const std::vector<std::array<double, 3>>& points) {
  CrushHistory h;
  for (int k = 1; k <= increments; ++k) {
    const double s = static_cast<double>(k) / increments;
    std::array<double, 3> before{};
    for (const std::array<double, 3>& p : points) {
      if (s <= p[0] + 1e-12) {
        const double part = (s - before[0]) / (p[0] - before[0]);
        h.depth.push_back(before[1] + part * (p[1] - before[1]));
        h.slide.push_back(before[2] + part * (p[2] - before[2]));
        break;
      }
      before = p;
    }
  }
  return h;
}

inline CrushHistory pressing(int n, double depth) {
  return history_of(n, {{1.0, depth, 0.0}});
}
inline CrushHistory unloading(int n, double depth) {
  return history_of(n, {{0.5, depth, 0.0}, {1.0, 0.0, 0.0}});
}
inline CrushHistory sliding(int n, double depth, double slide) {
  return history_of(n, {{0.5, depth, 0.0}, {1.0, depth, slide}});
}
inline CrushHistory cyclic_drag(int n, double depth, double slide) {
  return history_of(n, {{0.25, depth, 0.0},
                        {0.375, depth, slide},
                        {0.625, depth, -slide},
                        {0.875, depth, slide},
                        {1.0, depth, 0.0}});
}

class LatinDisk {
 public:
  /// @param candidates number of the lowest ones, of `columns` around the disk
  explicit LatinDisk(int radial = 12, int columns = 180, std::size_t candidates = 51,
                     bool tread = false) {
    mesh::Disk disk;
    disk.outer_radius = 0.3;
    disk.inner_radius = 0.15;
    disk.radial = radial;
    disk.circumferential = columns;
    if (tread) disk.tread = {.pitches = columns / 3, .depth = 0.012, .land_columns = 2};
    mesh_ = mesh::make_disk(disk);
    k_ = fem::assemble_stiffness(mesh_, {&rubber_, 1});
    free_ = fem::free_nodes(mesh_);
    model_ = statics::make_crush_model(mesh_.coordinates, mesh_.boundary, 0.0);
    body_ = std::make_unique<statics::Condensation>(k_, free_, model_.nodes);
    std::vector<std::size_t> order(model_.nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return model_.clearance[a] < model_.clearance[b];
    });
    order.resize(std::min(candidates, order.size()));
    std::sort(order.begin(), order.end());
    body_->append(order);
    for (const std::size_t j : body_->set()) nodes_.push_back(model_.nodes[j]);
  }

  [[nodiscard]] statics::LatinProblem problem(const CrushHistory& h, double friction) const {
    statics::LatinProblem p{body_->compliance(), {}, friction};
    p.free.resize(p.compliance.rows(), h.size());
    for (int k = 0; k < h.size(); ++k)
      for (std::size_t j = 0; j < body_->set().size(); ++j) {
        const auto i = static_cast<std::size_t>(k);
        const auto row = static_cast<Eigen::Index>(2 * j);
        p.free(row, k) = model_.clearance[body_->set()[j]] - h.depth[i];
        p.free(row + 1, k) = -h.slide[i];
      }
    return p;
  }

  /// K + k HᵀH, factorised.
  [[nodiscard]] std::unique_ptr<statics::Condensation> stiffened(double direction) const {
    return std::make_unique<statics::Condensation>(statics::with_springs(k_, nodes_, direction),
                                                   free_, nodes_);
  }
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }
  [[nodiscard]] const mesh::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const fem::BlockCsr& stiffness() const { return k_; }
  [[nodiscard]] const statics::Condensation& body() const { return *body_; }

 private:
  fem::Material rubber_{2.0e7, 0.3, 1100.0, fem::Plane::strain};
  mesh::Mesh mesh_;
  fem::BlockCsr k_;
  std::vector<int> free_, nodes_;
  statics::CrushModel model_;
  std::unique_ptr<statics::Condensation> body_;
};

/// Forces of the problem, one increment after another. (2m, N)
inline Eigen::MatrixXd direct_forces(const statics::LatinProblem& p) {
  Eigen::MatrixXd r(p.free.rows(), p.free.cols());
  Eigen::VectorXd before = Eigen::VectorXd::Zero(p.free.rows());  // positions at the last increment
  statics::CondensedSolution solution;
  solution.force = before;
  for (Eigen::Index k = 0; k < r.cols(); ++k) {
    statics::CondensedProblem one{p.compliance, p.free.col(k), p.friction};
    for (Eigen::Index t = 1; t < r.rows(); t += 2) one.free[t] -= before[t];
    const statics::CondensedReport report = statics::solve_condensed(one, {}, solution);
    EXPECT_TRUE(report.converged) << k << ": " << report.residual;
    r.col(k) = solution.force;
    before = p.free.col(k) + p.compliance * solution.force;
  }
  return r;
}

/// Error of forces, in energy over all increments.
inline double error_of(const statics::LatinProblem& p, const Eigen::MatrixXd& r,
                       const Eigen::MatrixXd& direct) {
  const Eigen::MatrixXd off = r - direct;
  return std::sqrt((p.compliance * off).cwiseProduct(off).sum() /
                   (p.compliance * direct).cwiseProduct(direct).sum());
}

/// Number of singular values of the fields under the forces, in the energy norm, that leave a
/// relative error below the bound.
inline int pod_modes(const statics::LatinProblem& p, const Eigen::MatrixXd& direct, double bound) {
  const Eigen::MatrixXd l = p.compliance.llt().matrixL();
  const Eigen::VectorXd sigma =
      Eigen::BDCSVD<Eigen::MatrixXd>(l.transpose() * direct).singularValues();
  int modes = static_cast<int>(sigma.size());
  for (double tail = 0.0; modes > 0; --modes) {
    tail = std::hypot(tail, sigma[modes - 1]);
    if (tail >= bound * sigma.norm()) break;
  }
  return modes;
}

}  // namespace rondo::test
