// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the inner forces of a rolling tyre have beyond those that are linear about its state
/// (docs/tyre.md), on all rows of a sector at all samples of a turn.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rondo/analysis/steady/steady_case.hpp"
#include "rondo/analysis/steady/touching_nodes.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/model/solid/swept_part.hpp"
#include "rondo/statics/steady/finite_rolling.hpp"
#include "rondo/statics/tangent_factors.hpp"

namespace rondo::study {

class SteadyRemainder final : public statics::RollingRemainder {
 public:
  /// Mesh, sector and part must outlive it. @param sector K about the state, of all that is linear
  /// in steady rolling. @param candidates rows that may touch. @param samples P of a sector's pass.
  /// @param damped how much of K its damping is like: the tangent has as much of it, without which
  /// Newton's steps are too long where the wheel is softer than that
  SteadyRemainder(const mesh::Mesh& mesh, const fem::SolidSector& sector,
                  const dynamics::SweptPart& part, std::vector<int> candidates, int samples,
                  double damped, int threads);

  bool find(const Eigen::MatrixXd& u, Eigen::MatrixXd& force) override;
  Eigen::MatrixXd linear(const Eigen::MatrixXd& u) override;
  bool take_tangent(const Eigen::MatrixXd& u, std::span<const statics::RollingPair> pairs) override;
  void move(const Eigen::MatrixXd& force, Eigen::MatrixXd& u) override;
  [[nodiscard]] Eigen::Matrix3d softness(const statics::RollingPair& of,
                                         const statics::RollingPair& by) const override;
  [[nodiscard]] double energy() const override { return energy(0); }
  /// What is stored while sector 0 is `place` samples from its place in X [J].
  [[nodiscard]] double energy(int place) const {
    return of_[static_cast<std::size_t>(place)].energy;
  }

 private:
  /// The wheel at a place of a sector's pass.
  struct Place {
    dynamics::SweptWheel wheel;
    std::vector<Vec3> u, force, linear;  ///< (n)
    TouchingNodes touching;
    std::optional<statics::TangentFactors> tangent;
    Eigen::MatrixXd compliance;  ///< of the touching nodes [m/N]
    double energy = 0.0;
  };
  /// unroll() turns the rows of a field at a place into all nodes, in the axes of the wheel; roll()
  /// turns them back.
  void unroll(const Eigen::MatrixXd& field, std::size_t place, std::span<Vec3> nodes) const;
  void roll(std::span<const Vec3> nodes, std::size_t place, Eigen::MatrixXd& field) const;
  [[nodiscard]] double angle(std::size_t place) const;
  /// Where a pair touches: the place of the pass, from 0 on, and the sector.
  [[nodiscard]] std::size_t place_of(const statics::RollingPair& pair) const;
  [[nodiscard]] std::size_t sector_of(const statics::RollingPair& pair) const;
  void include(std::span<const statics::RollingPair> pairs);
  void take_reference();
  /// The tangent at a place's u. @return factors, none: it is not positive definite
  std::optional<statics::TangentFactors> tangent_at(Place& of, std::size_t place,
                                                    const TouchingNodes& touching) const;
  void find_at(std::size_t place, const Eigen::MatrixXd& u, Eigen::MatrixXd& force);

  const fem::SolidSector& sector_;
  double of_rest_;  ///< share of K in the tangent
  std::vector<int> candidates_;
  int threads_;
  std::vector<char> moves_;    ///< (n)
  std::vector<int> order_;     ///< of the factors' unknowns
  TouchingNodes touching_;     ///< at any place
  Eigen::MatrixXd at_rest_;    ///< compliance of K at these [m/N]
  std::size_t n_at_rest_ = 0;  ///< number of nodes that it is of
  std::vector<Place> of_;      ///< (P)
};

}  // namespace rondo::study
