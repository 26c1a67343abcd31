// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stiffness of a part of a body, all else being held.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"

namespace rondo::statics {

/// Its factors are by BLAS: with one thread they have the same bits at any time (OneBlasThread).
class LocalStiffness {
 public:
  /// @param moves (n) of the body's nodes, 0: it is held
  explicit LocalStiffness(std::span<const char> moves);
  LocalStiffness(LocalStiffness&&) noexcept;
  LocalStiffness& operator=(LocalStiffness&&) noexcept;
  ~LocalStiffness();

  /// Adds a block; those of nodes that are held are left out [N/m].
  void take(std::size_t force, std::size_t move, const Eigen::Matrix3d& block);
  /// False: what was taken is not positive definite.
  [[nodiscard]] bool factor();
  /// u -= K^-1 force, at the nodes that move. @param force, u (n). @pre factor() was true
  void correct(std::span<const Vec3> force, std::span<Vec3> u) const;

 private:
  struct Part;
  std::unique_ptr<Part> part_;
};

}  // namespace rondo::statics
