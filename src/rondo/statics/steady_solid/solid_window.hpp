// SPDX-License-Identifier: BSD-3-Clause
/// @file  What may touch flat ground in steady rolling in three dimensions, condensed
/// (docs/wheel3d.md): pairs of a candidate and a sample. It hangs on the camber, but neither on
/// height, speed and slip angle nor on friction.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/statics/steady/rolling_window.hpp"
#include "rondo/statics/steady_solid/solid_harmonics.hpp"
#include "rondo/statics/steady_solid/solid_problem.hpp"

namespace rondo::statics {

class SolidWindow {
 public:
  /// The harmonics must outlive it. @param gravity along -n [m/s²]
  SolidWindow(const SolidHarmonics& harmonics, SlipDifference slip, double camber = 0.0,
              double gravity = 0.0);

  [[nodiscard]] const SolidHarmonics& harmonics() const noexcept { return harmonics_; }
  [[nodiscard]] const SolidRollingProblem& problem() const noexcept { return problem_; }
  [[nodiscard]] const std::vector<RollingPair>& pairs() const noexcept { return problem_.pairs; }
  [[nodiscard]] SolidGravity gravity() const noexcept { return gravity_; }
  /// Time of a sample [s].
  [[nodiscard]] double time() const noexcept { return problem_.time; }
  /// -1 or 1: of a sample, the one before.
  [[nodiscard]] int back() const noexcept { return back_; }

  /// Pairs whose undeformed place is no higher than `height` below the center, and some beside
  /// them.
  void include_below(double height);
  /// Pairs beside those there are, that the forces leave in the ground: they are included.
  /// @param force (3 pairs) [N] @return whether there were any
  bool include_touching(double height, const Eigen::VectorXd& force);
  /// Largest depth below the center of what nothing touches [m].
  [[nodiscard]] double lowest() const noexcept;

  /// e^{i 2π sample/L}: of the frame of a sector that has come so far from where it is in X.
  [[nodiscard]] Complex frame(int sample) const noexcept;

 private:
  [[nodiscard]] Vec3 free_place(const RollingPair& p) const noexcept;
  void fill_base(Eigen::Index pair);
  void fill_column(Eigen::Index of, Eigen::Index from);
  void include(const std::vector<RollingPair>& pairs);
  [[nodiscard]] std::size_t wrapped(int sample) const noexcept;

  const SolidHarmonics& harmonics_;
  SolidGravity gravity_;
  std::vector<Complex> frames_;              ///< (L)
  std::vector<double> weights_;              ///< of a point's own and its earlier displacements
  int back_;                                 ///< towards the sample before
  double turn_;                              ///< s of a sample's time                       [rad]
  std::vector<std::vector<char>> included_;  ///< (C, L)
  SolidRollingProblem problem_;
};

}  // namespace rondo::statics
