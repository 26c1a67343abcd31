// SPDX-License-Identifier: BSD-3-Clause
/// @file  Viscous branches of a body of small strain in time (docs/rolling-resistance.md): each has
/// displacements q of its own, which follow those of the body, τ q' = u - q, by the midpoint rule.
/// Its force is r V (u - q). What it stores and loses in a step then splits the work of the mean of
/// its forces at both ends exactly, and the loss is never negative.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/viscosity.hpp"

namespace rondo::dynamics {

template <class Stiffness>
struct ViscousVector;
template <>
struct ViscousVector<fem::BlockCsr> {
  using type = Vec2;
};
template <>
struct ViscousVector<fem::SolidSector> {
  using type = Vec3;
};

/// @tparam Stiffness BlockCsr in the plane, per metre of width; SolidSector in space
template <class Stiffness>
class ViscousBranches {
 public:
  using Parts = std::span<const fem::ViscousPart<Stiffness>>;
  using Vec = typename ViscousVector<Stiffness>::type;

  /// All branches are relaxed at u. The parts must outlive it. @param dt > 0, of a step [s]
  ViscousBranches(Parts parts, std::span<const Vec> u, double dt, int threads);

  /// Moves on by a step, to displacements u.
  void move(std::span<const Vec> u) noexcept;
  /// (n) Of all branches at the last u, and at the one before [N].
  [[nodiscard]] std::span<const Vec> force() const noexcept { return total_; }
  [[nodiscard]] std::span<const Vec> force_before() const noexcept { return total_before_; }
  /// Stored at the last u [J].
  [[nodiscard]] double stored() const noexcept { return stored_; }
  /// Lost in the last step, >= 0 [J].
  [[nodiscard]] double lost() const noexcept { return lost_; }

  /// q of each branch, component by component [m].
  [[nodiscard]] std::vector<double> save() const;
  /// @param u the last one that move() has had. @param numbers as save() gave them
  void restore(std::span<const Vec> u, std::span<const double> numbers);
  /// Size of what save() returns, for n nodes.
  [[nodiscard]] static std::size_t numbers(Parts parts, std::size_t n) noexcept;

 private:
  struct Branch {
    const Stiffness& stiffness;
    double modulus, time;
    std::vector<Vec> q;       ///< (n)
    std::vector<Vec> strain;  ///< (n) u - q
    std::vector<Vec> force;   ///< (n) V (u - q) of strain 1
  };
  void add_up() noexcept;
  void product(const Stiffness& v, std::span<const Vec> u, std::span<Vec> out) const noexcept;

  double dt_;
  int threads_;
  std::vector<Vec> u_;  ///< (n) the last one
  std::vector<Branch> branches_;
  std::vector<Vec> strain_, force_;        ///< (n) of a branch at the new u
  std::vector<Vec> total_, total_before_;  ///< (n)
  double stored_ = 0.0, lost_ = 0.0;
};

}  // namespace rondo::dynamics
