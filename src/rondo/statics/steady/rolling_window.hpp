// SPDX-License-Identifier: BSD-3-Clause
/// @file  What may touch flat ground in steady rolling, condensed (docs/theory.md, 11.2, and
/// docs/wheel3d.md): pairs of a candidate and a sample, whose gaps and slips are linear in the
/// forces of all. It depends on camber and weight, but neither on height, speed and slip angle nor
/// on friction, and is kept for all that differ in these alone.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/statics/steady/rolling_harmonics.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

/// How the slip of a material point is taken: from its place one sample before, or from two. In the
/// plane it is a difference of whole places; in space the turn is exact, and the difference is one
/// of displacements. A standing body, in space alone, does not pass samples: the way of a point is
/// its displacement less the one that count_from() gave, and the time of a sample is 1. A transient
/// takes the slip as "upwind" does, but the earlier place from the forces that roll_on_from() gave;
/// in space alone.
enum class SlipDifference { bdf2, upwind, standing, transient };

template <int D>
class RollingWindow {
 public:
  /// The harmonics must outlive it. @param camber γ [rad]; 0 in the plane. @param gravity along -n
  /// [m/s²]
  RollingWindow(const RollingHarmonics<D>& harmonics, SlipDifference slip, double camber = 0.0,
                double gravity = 0.0);

  [[nodiscard]] const RollingHarmonics<D>& harmonics() const noexcept { return harmonics_; }
  [[nodiscard]] const RollingProblem<D>& problem() const noexcept { return problem_; }
  [[nodiscard]] const std::vector<RollingPair>& pairs() const noexcept { return problem_.pairs; }
  [[nodiscard]] RollingGravity gravity() const noexcept { return gravity_; }
  /// Time of a sample [s].
  [[nodiscard]] double time() const noexcept { return problem_.time; }

  /// Includes pairs whose undeformed place is no higher than `height` below the center, and some
  /// beside them.
  void include_below(double height);
  /// Includes those that are not there yet.
  void include(const std::vector<RollingPair>& pairs);
  /// Includes pairs beside those there are, that the forces leave in the ground.
  /// @param force (D pairs) [N] @return whether there were any
  bool include_touching(double height, const Eigen::VectorXd& force);
  /// What forces on all rows make of the body besides spin, weight and contact: all gaps and ways
  /// change by it. @param spectrum (D n_local, L/2 + 1) by RollingHarmonics::response() [m]
  void take_response(Eigen::MatrixXcd spectrum);
  /// In space, what a force on a pair moves another by beyond what the harmonics say, in the frames
  /// of their sectors [m/N].
  using Softness = std::function<NodeMatrix<D>(const RollingPair& of, const RollingPair& by)>;
  /// From now on forces move all pairs by so much more; nothing is foreseen. @param softness empty:
  /// no more
  void soften(Softness softness);
  /// Until the next response, the softness counts for what forces differ from certain ones, under
  /// which the candidates are displaced by so much more than the harmonics say.
  /// @param force (D pairs) [N]. @param more (D n_local, L), a field [m]
  void foresee(const Eigen::VectorXd& force, const Eigen::MatrixXd& more);
  /// Ways of a standing body are counted from here; at first from where nothing is displaced.
  /// @param displacement (D C, L) of the candidates, in the frames of their sectors [m]
  void count_from(Eigen::MatrixXd displacement);
  /// Ways of a transient are counted from the displacements by these forces; at first by none.
  /// @param force (D pairs so far) [N]
  void roll_on_from(Eigen::VectorXd force);
  /// Empty: nothing was taken.
  [[nodiscard]] const Eigen::MatrixXcd& response() const noexcept { return response_; }
  /// Distance of the lowest contact node from the center where nothing touches, as spin, gravity
  /// and loads alone leave it; in space its depth below the center [m].
  [[nodiscard]] double lowest() const noexcept;

  /// e^{i 2π sample/L}: of the frame of a sector that has come so far from where it is in X.
  [[nodiscard]] Complex frame(int sample) const noexcept {
    return frames_[harmonics_.wrapped(sample)];
  }
  /// From that frame to the axes n, t1, t2 of the ground.
  [[nodiscard]] const NodeMatrix<D>& to_ground(int sample) const noexcept {
    return to_ground_[harmonics_.wrapped(sample)];
  }

 private:
  /// Displacement and way of a candidate, so many samples after a force on another, in the frame of
  /// the later sample.
  struct Kernel {
    NodeMatrix<D> moved, slipped;
  };
  [[nodiscard]] bool is_transient() const noexcept { return n_now_ < weights_.size(); }
  [[nodiscard]] Kernel kernel(std::size_t a, std::size_t b, int ahead) const noexcept;
  [[nodiscard]] Kernel kernel(const RollingPair& of, const RollingPair& by) const noexcept;
  void add_softness(const RollingPair& of, const RollingPair& by, Kernel& k) const;
  void find_kernels();
  [[nodiscard]] NodeVector<D> free_displacement(const RollingPair& p) const noexcept;
  [[nodiscard]] NodeVector<D> free_place(const RollingPair& p) const noexcept;
  [[nodiscard]] NodeVector<D> free_way(const RollingPair& p) const noexcept;
  [[nodiscard]] NodeVector<D> way_from_origin(const RollingPair& p) const noexcept;
  void foresee_nothing();
  void fill_bases();
  void fill_base(Eigen::Index pair);
  void fill_column(Eigen::Index of, Eigen::Index from);
  void fill_upstream(Eigen::Index of, Eigen::Index from);
  void fill_columns(Eigen::Index from);

  const RollingHarmonics<D>& harmonics_;
  RollingGravity gravity_;
  std::vector<Complex> frames_;           ///< (L)
  std::vector<NodeMatrix<D>> to_ground_;  ///< (L)
  std::vector<double> weights_;           ///< of a point's own and its earlier places
  std::size_t n_now_;  ///< so many of these places are by the forces of now; of a transient one
  double turn_;  ///< s of a sample's time; 0 of a standing body                            [rad]
  /// (C, C, L) in the plane, where they are few; the same for copies
  std::shared_ptr<const std::vector<Kernel>> kernels_;
  Eigen::MatrixXcd response_;
  Softness softness_;
  Eigen::MatrixXd more_;                     ///< (D C, L) of it, on the candidates; empty: none [m]
  Eigen::MatrixXd origin_;                   ///< (D C, L) of count_from(); empty: it does not stand
  std::vector<std::vector<char>> included_;  ///< (C, L)
  RollingProblem<D> problem_;
};

}  // namespace rondo::statics
