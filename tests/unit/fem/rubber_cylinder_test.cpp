// SPDX-License-Identifier: BSD-3-Clause
/// A cylinder of Mooney-Rivlin rubber crushed between rigid planes without friction (Sussman and
/// Bathe, Comput. Struct. 26 (1987) 357; the values are those of the data set of solids4foam).
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <set>

#include "unit/fem/rubber_fixture.hpp"

namespace rubber_cylinder_test {

using namespace rondo;
using namespace rondo::fem;

namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double radius = 0.2;
constexpr int most = 100;  ///< Newton steps

/// A square onto a quarter of the circle.
mesh::Mesh quarter(int n) {
  mesh::Mesh m = patch_mesh(n, Cells::quadrilaterals);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      m.coordinates[static_cast<std::size_t>(j * (n + 1) + i)] = {
          radius * x * std::sqrt(1.0 - 0.5 * y * y), radius * y * std::sqrt(1.0 - 0.5 * x * x)};
    }
  return m;
}

/// A quarter of the cylinder below a plane that comes down: nodes on it by an active set.
class Crushed {
 public:
  explicit Crushed(int n)
      : n_(n), mesh_(quarter(n)), body_(mesh_, std::vector{rubber()}), u_(mesh_.n_nodes()) {
    for (int k = 0; k <= n; ++k) {
      around_.insert(n * (n + 1) + k);
      around_.insert(k * (n + 1) + n);
    }
  }

  /// Force on the whole cylinder [N/m].
  double bring_to(double approach) {
    plane_ = radius - approach;
    int iteration = 0;
    while (find_pressed(gradient_of(body_, u_)) && iteration < most) {
      for (; iteration < most; ++iteration) {
        const std::vector<Vec2> f = gradient_of(body_, u_);
        if (closed() && to_do(f).norm() < 1e-8 * as_vector(f).norm()) break;
        improve();
      }
    }
    EXPECT_LT(iteration, most);
    double force = 0.0;
    const std::vector<Vec2> f = gradient_of(body_, u_);
    for (const int node : pressed_) force -= 2.0 * f[static_cast<std::size_t>(node)].y;
    return force;
  }

 private:
  static Material rubber() {
    Rubber r;
    r.law = RubberLaw::mooney_rivlin;
    r.c10 = 0.293e6;
    r.c01 = 0.177e6;
    r.bulk_modulus = 1410e6;
    return material_with(r);
  }
  [[nodiscard]] Vec2 place(int node) const {
    const auto k = static_cast<std::size_t>(node);
    return mesh_.coordinates[k] + u_[k];
  }
  [[nodiscard]] bool closed() const {
    return std::ranges::all_of(
        pressed_, [&](int node) { return std::abs(place(node).y - plane_) < 1e-12 * radius; });
  }
  /// Nodes in or on the plane that it does not pull; true where they are others than before.
  bool find_pressed(const std::vector<Vec2>& f) {
    std::set<int> now;
    for (const int node : around_) {
      const bool held = pressed_.count(node) > 0;
      if (held ? f[static_cast<std::size_t>(node)].y < 0.0
               : place(node).y > plane_ + 1e-12 * radius)
        now.insert(node);
    }
    const bool others = now != pressed_;
    pressed_ = now;
    return others || !closed();
  }
  [[nodiscard]] bool moves(int dof) const {
    const int node = dof / 2, i = node % (n_ + 1), j = node / (n_ + 1);
    return dof % 2 == 0 ? i > 0 : j > 0 && pressed_.count(node) == 0;
  }
  [[nodiscard]] Eigen::VectorXd to_do(const std::vector<Vec2>& f) const {
    Eigen::VectorXd rest = -as_vector(f);
    for (int dof = 0; dof < rest.size(); ++dof)
      if (!moves(dof)) rest[dof] = 0.0;
    return rest;
  }
  void improve() {
    const Matrix k = free_matrix(body_.tangent(u_), free_nodes(mesh_));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(k.rows());
    for (const int node : pressed_) step[2 * node + 1] = plane_ - place(node).y;
    Eigen::VectorXd rest = -as_vector(gradient_of(body_, u_)) - k * step;
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < k.outerSize(); ++column)
      for (Matrix::InnerIterator it(k, column); it; ++it)
        if (moves(static_cast<int>(it.row())) && moves(column))
          entries.emplace_back(it.row(), column, it.value());
    for (int dof = 0; dof < rest.size(); ++dof)
      if (!moves(dof)) {
        entries.emplace_back(dof, dof, 1.0);
        rest[dof] = 0.0;
      }
    Matrix a(k.rows(), k.cols());
    a.setFromTriplets(entries.begin(), entries.end());
    step += Eigen::SimplicialLDLT<Matrix>(a).solve(rest);
    double part = 1.0;
    const std::vector<Vec2> before = u_;
    do {
      for (std::size_t i = 0; i < u_.size(); ++i)
        u_[i] = before[i] + part * Vec2{step[static_cast<Eigen::Index>(2 * i)],
                                        step[static_cast<Eigen::Index>(2 * i + 1)]};
      part *= 0.5;
    } while (!std::isfinite(energy_of(body_, u_)) && part > 1e-3);
  }

  int n_;
  mesh::Mesh mesh_;
  Hyperelasticity body_;
  std::vector<Vec2> u_;
  std::set<int> around_, pressed_;
  double plane_ = radius;
};

}  // namespace

TEST(RubberProblems, ACrushedCylinder) {
  Crushed cylinder(12);
  constexpr double step = 0.0005;
  double approach = 0.0;
  for (const auto& [to, force] : {std::pair{0.019, 0.056e6},
                                  {0.046, 0.216e6},
                                  {0.069, 0.503e6},
                                  {0.087, 0.906e6},
                                  {0.100, 1.418e6}}) {
    double found = 0.0;
    for (; approach < to - 1e-9; approach = std::min(to, approach + step))
      found = cylinder.bring_to(std::min(to, approach + step));
    EXPECT_NEAR(found, force, 0.02 * force) << to;
  }
}

}  // namespace rubber_cylinder_test
