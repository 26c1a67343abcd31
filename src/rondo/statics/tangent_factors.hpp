// SPDX-License-Identifier: BSD-3-Clause
/// @file  The tangent stiffness of a body that is held at some nodes, factored, and what forces at
/// a few of its nodes move these nodes by.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"

namespace rondo::statics {

/// The factors are made with one thread and have the same bits at any time.
class TangentFactors {
 public:
  /// @param moves (n) of the body's nodes, 0: the node is held. @param touching nodes that move and
  /// whose compliance is asked for. @param order of the unknowns, as order() of a stiffness of the
  /// same nodes gives it; empty: it is sought, which takes a third of the time of factor()
  TangentFactors(std::span<const char> moves, std::span<const std::size_t> touching,
                 std::vector<int> order = {});
  TangentFactors(TangentFactors&&) noexcept;
  TangentFactors& operator=(TangentFactors&&) noexcept;
  ~TangentFactors();

  /// Adds a block; those of nodes that are held are left out [N/m].
  void take(std::size_t force, std::size_t move, const Eigen::Matrix3d& block);
  /// False: what was taken is not positive definite.
  [[nodiscard]] bool factor();
  /// Order of the unknowns that fills the factors least. @pre factor() was called
  [[nodiscard]] const std::vector<int>& order() const noexcept;
  /// u += K^-1 force, at the nodes that move. @param force, u (n). @pre factor() was true
  void move(std::span<const Vec3> force, std::span<Vec3> u) const;
  /// What forces at the m touching nodes move them by, (3 m, 3 m) in their order [m/N].
  /// @pre factor() was true
  [[nodiscard]] Eigen::MatrixXd compliance() const;

 private:
  struct Part;
  std::unique_ptr<Part> part_;
};

}  // namespace rondo::statics
