// SPDX-License-Identifier: BSD-3-Clause
/// @file  One contact of the law of contact in space (cone_law.hpp).
#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>

#include "rondo/contact/law.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo::rom {

/// A contact. Vectors named `free` and `moved` are along (normal, first tangent, second tangent),
/// forces along the axes in which the compliance is.
struct ConeContact {
  int place = 0;                ///< of the contact in the window of the compliance
  Vec3 free;                    ///< gap and distances slid where nothing presses             [m]
  std::array<Vec3, 3> axes;     ///< normal and tangents, in the axes of the compliance
  std::array<Vec3, 3> lift{};   ///< what unit accelerations of a rim do to it, likewise
  std::array<Vec3, 3> reply{};  ///< what its force does to these: their products
  double friction = 0.0;        ///< μ; out: that of the force, where it follows a law
  Vec3 force;                   ///< in: where to start                                       [N]
  Vec3 moved;                   ///< gap and distances slid with the forces                   [m]
  contact::Status status = contact::Status::open;
};

/// A contact while it is solved; all along its own axes.
struct ConeLocal {
  Eigen::Matrix3d own, inverse;  ///< compliance of the contact with itself                [m/N]
  Eigen::Vector3d force;         ///< [N]
  double friction = 0.0;         ///< μ
  Eigen::Vector3d moved;         ///< gap and distances slid with the forces of all           [m]
};

/// The force of one contact, the others being as they are. The direction of sliding begins as that
/// of the force it has, and turns by Newton's method until a turn is below 1e-5.
/// @param free gap and distances slid without its force
[[nodiscard]] Eigen::Vector3d solve_alone(const ConeLocal& contact, double friction,
                                          const Eigen::Vector3d& free) noexcept;

/// μ of a contact by its number, the distance slid and the normal force [m], [N].
using ConeFriction = std::function<double(std::size_t, double, double)>;

/// Finds the force of one contact together with its coefficient, which depends on the slip and the
/// force, and leaves the coefficient in the contact.
/// @param number of the contact
[[nodiscard]] Eigen::Vector3d solve_following(const ConeFriction& friction, std::size_t number,
                                              ConeLocal& contact, const Eigen::Vector3d& free);

/// Components along the axes of a contact of a vector in the axes of the compliance.
template <class Number>
[[nodiscard]] Eigen::Vector3d along(const ConeContact& c, const Number* vector) noexcept {
  const Vec3 a{static_cast<double>(vector[0]), static_cast<double>(vector[1]),
               static_cast<double>(vector[2])};
  return {dot(c.axes[0], a), dot(c.axes[1], a), dot(c.axes[2], a)};
}
/// A vector along the axes of a contact, in the axes of the compliance.
[[nodiscard]] inline Vec3 turned_back(const ConeContact& c, const Eigen::Vector3d& a) noexcept {
  return a[0] * c.axes[0] + a[1] * c.axes[1] + a[2] * c.axes[2];
}
[[nodiscard]] inline Eigen::Vector3d vector_of(Vec3 a) noexcept {
  return {a.x, a.y, a.z};
}

}  // namespace rondo::rom
