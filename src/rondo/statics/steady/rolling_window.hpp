// SPDX-License-Identifier: BSD-3-Clause
/// @file  What may touch flat ground in steady rolling, condensed (docs/theory.md, 11.2): pairs of
/// a candidate and a sample, whose gaps and slips are linear in the forces of all. It hangs neither
/// on height nor on speed nor on friction, and is kept for all that differ in these alone.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/statics/steady/rolling_harmonics.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

/// How the slip of a material point is taken: from its place one sample before, or from two.
enum class SlipDifference { bdf2, upwind };

class RollingWindow {
 public:
  /// The harmonics must outlive it.
  RollingWindow(const RollingHarmonics& harmonics, SlipDifference slip);

  [[nodiscard]] const RollingHarmonics& harmonics() const noexcept { return harmonics_; }
  [[nodiscard]] const RollingProblem& problem() const noexcept { return problem_; }
  [[nodiscard]] const std::vector<RollingPair>& pairs() const noexcept { return problem_.pairs; }
  /// Time of a sample [s].
  [[nodiscard]] double time() const noexcept { return problem_.time; }

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
  /// Of candidate a, `ahead` samples after a force on b, in the frame of the later sample: its
  /// displacement and its way, 2×2 column-major.
  struct Kernel {
    std::array<double, 4> moved, slipped;
  };
  [[nodiscard]] Place place(const RollingPair& p) const noexcept;
  [[nodiscard]] const Kernel& kernel(const RollingPair& p, const RollingPair& of) const noexcept;
  void find_kernels();
  void include(const std::vector<RollingPair>& pairs);
  void fill_column(Eigen::Index of, Eigen::Index from);

  const RollingHarmonics& harmonics_;
  std::vector<Complex> frames_;                         ///< (L)
  std::vector<double> weights_;                         ///< of a point's own and its earlier places
  int back_;                                            ///< towards the sample before
  std::shared_ptr<const std::vector<Kernel>> kernels_;  ///< (C, C, L); the same for copies
  std::vector<std::vector<char>> included_;             ///< (C, L)
  RollingProblem problem_;
};

}  // namespace rondo::statics
