// SPDX-License-Identifier: BSD-3-Clause
/// @file  What may touch flat ground in steady rolling, condensed (docs/theory.md, 11.2): pairs of
/// a candidate and a sample, whose gaps and slips are linear in the forces of all. It hangs neither
/// on height nor on speed nor on friction, and is kept for all that differ in these alone.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/statics/steady/rolling_harmonics.hpp"

namespace rondo::statics {

/// How the slip of a material point is taken: from its place one sample before, or from two.
enum class SlipDifference { bdf2, upwind };

/// A candidate at a sample; at sample 0 its sector is where it is in the reference.
struct RollingPair {
  std::size_t candidate = 0;
  int sample = 0;
};

class RollingWindow {
 public:
  /// The harmonics must outlive it.
  RollingWindow(const RollingHarmonics& harmonics, SlipDifference slip);

  [[nodiscard]] const RollingHarmonics& harmonics() const noexcept { return harmonics_; }
  [[nodiscard]] const std::vector<RollingPair>& pairs() const noexcept { return pairs_; }
  /// Time of a sample [s].
  [[nodiscard]] double time() const noexcept { return time_; }
  /// Of each pair (gap, way) without forces, the center at height 0 and at rest: gap + h and way +
  /// V time() are those of a moving one. (2 pairs) [m]
  [[nodiscard]] const Eigen::VectorXd& base() const noexcept { return base_; }
  /// Of (gap, way) by (r_n, r_x): rows and columns 2j, 2j + 1 of pair j. (2 pairs, 2 pairs) [m²/N]
  [[nodiscard]] const Eigen::MatrixXd& matrix() const noexcept { return matrix_; }
  /// Place of each pair along x from the center, without forces [m], and by them [m²/N].
  [[nodiscard]] const Eigen::VectorXd& base_x() const noexcept { return base_x_; }
  [[nodiscard]] const Eigen::MatrixXd& matrix_x() const noexcept { return matrix_x_; }

  /// Pairs whose undeformed place is no higher than `height` below the center, and some beside
  /// them.
  void include_below(double height);
  /// Pairs beside those there are, that the forces leave in the ground: they are included.
  /// @param force (2 pairs) [N/m] @return whether there were any
  bool include_touching(double height, const Eigen::VectorXd& force);

  [[nodiscard]] Complex frame(int sample) const noexcept;

 private:
  struct Place {
    double gap, way, x;
  };
  [[nodiscard]] Place place(const RollingPair& p) const noexcept;
  /// Rows (gap, way, x) by (r_n, r_x).
  [[nodiscard]] Eigen::Matrix<double, 3, 2> response(const RollingPair& p,
                                                     const RollingPair& of) const noexcept;
  void find_slip_kernels();
  void include(const std::vector<RollingPair>& pairs);

  const RollingHarmonics& harmonics_;
  std::vector<Complex> frames_;  ///< (L)
  std::vector<double> weights_;  ///< of a point's own and its earlier places
  int back_;                     ///< towards the sample before
  double time_;
  std::vector<Eigen::Matrix2d> moved_, slipped_;  ///< (C, C, L) of places and ways, sector frames
  std::vector<RollingPair> pairs_;
  std::vector<std::vector<char>> included_;  ///< (C, L)
  Eigen::VectorXd base_, base_x_;
  Eigen::MatrixXd matrix_, matrix_x_;
};

}  // namespace rondo::statics
