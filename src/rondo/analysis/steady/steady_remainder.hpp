// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the inner forces of a rolling tyre have beyond those that are linear about its state
/// (docs/tyre.md), on all rows of a sector at all samples of a turn.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rondo/analysis/steady/steady_case.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/model/solid/swept_part.hpp"
#include "rondo/statics/local_stiffness.hpp"
#include "rondo/statics/steady/finite_rolling.hpp"

namespace rondo::study {

class SteadyRemainder final : public statics::RollingRemainder {
 public:
  /// Mesh, sector and part must outlive it. @param sector K about the state, of all that is linear
  /// in steady rolling. @param candidates rows that may
  /// touch. @param samples P of a sector's pass
  SteadyRemainder(const mesh::Mesh& mesh, const fem::SolidSector& sector,
                  const dynamics::SweptPart& part, std::vector<int> candidates, int samples,
                  int threads);

  bool find(const Eigen::MatrixXd& u, Eigen::MatrixXd& force) override;
  void take_stiffness(const Eigen::MatrixXd& u,
                      std::span<const statics::RollingPair> pressed) override;
  void correct(const Eigen::MatrixXd& left, Eigen::MatrixXd& u) override;
  [[nodiscard]] double energy() const override { return energy(0); }
  /// What is stored while sector 0 is `place` samples from its place in X [J].
  [[nodiscard]] double energy(int place) const {
    return of_[static_cast<std::size_t>(place)].energy;
  }

 private:
  /// The wheel at a place of a sector's pass.
  struct Place {
    dynamics::SweptWheel wheel;
    std::vector<Vec3> u, force, linear;                ///< (n)
    std::optional<statics::LocalStiffness> stiffness;  ///< of the part near the ground
    double energy = 0.0;
  };
  struct Near;
  /// unroll() turns the rows of a field at a place into all nodes, in the axes of the wheel; roll()
  /// turns them back.
  void unroll(const Eigen::MatrixXd& field, std::size_t place, std::span<Vec3> nodes) const;
  void roll(std::span<const Vec3> nodes, std::size_t place, Eigen::MatrixXd& field) const;
  [[nodiscard]] double angle(std::size_t place) const;
  /// Where a pair touches: the place of the pass, from 0 on, and the sector.
  [[nodiscard]] int place_of(const statics::RollingPair& pair) const;
  [[nodiscard]] int sector_of(const statics::RollingPair& pair) const;
  /// @return whether it is positive definite
  bool take_stiffness_at(std::size_t place, const Eigen::MatrixXd& u,
                         std::span<const statics::RollingPair> pressed, const Near& near);
  void find_at(std::size_t place, const Eigen::MatrixXd& u, Eigen::MatrixXd& force);

  const fem::SolidSector& sector_;
  std::vector<int> candidates_;
  int threads_;
  bool has_stiffness_ = false;
  std::vector<Place> of_;  ///< (P)
};

}  // namespace rondo::study
