// SPDX-License-Identifier: BSD-3-Clause
/// @file  The implicit part B of the scheme "hati" (docs/theory.md, 12.2): the trapezoidal rule
/// over a coarse step, factored once.
#pragma once
#include <Eigen/SparseLU>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/hati/fine_part.hpp"

namespace rondo::dynamics {

class CoarsePart {
 public:
  /// @pre as FinePart
  CoarsePart(const Model& whole, const PartFields& start);
  CoarsePart(const CoarsePart&) = delete;
  CoarsePart& operator=(const CoarsePart&) = delete;

  /// A coarse step from fields(), which stay as they are.
  /// @param pull Rᵀ(c̈ - g) over the step, mean                                        [m/s²]
  /// @param multiplier (interface) force on these nodes of A: B feels its opposite     [N/m]
  void attempt(Vec2 pull, std::span<const Vec2> multiplier);
  void accept();

  /// (interface) by which the nodes moved in the last attempt                         [m]
  [[nodiscard]] std::span<const Vec2> travel() const noexcept { return travel_; }
  /// Works of the step that was accepted last.
  [[nodiscard]] const Works& works() const noexcept { return works_; }
  [[nodiscard]] const PartFields& fields() const noexcept { return fields_; }
  void add_energy(double& kinetic, double& strain);
  void set(PartFields fields) {
    RONDO_DEMAND(fields.u.size() == whole_.n_nodes() && fields.v.size() == whole_.n_nodes(),
                 fields.u.size(), fields.v.size(), whole_.n_nodes());
    fields_ = std::move(fields);
  }

  /// As FinePart::respond().
  void respond(std::span<const Vec2> multiplier, std::span<Vec2> travel);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  [[nodiscard]] Matrix matrix() const;
  void find_load(Vec2 pull);
  void take_multiplier(std::span<const Vec2> multiplier);
  void solve();
  void find_travel(const PartFields& from, std::span<Vec2> travel) const noexcept;
  [[nodiscard]] Vec2 mean_velocity(const PartFields& from, std::size_t place) const noexcept;
  void find_works(Vec2 pull);

  const Model& whole_;
  const Subdomain& part_;
  const std::vector<int>& interface_;
  std::vector<int> place_;  ///< (interface) in part_.free
  double spin_;             ///< s, constant                                           [rad/s]
  PartFields fields_;
  const PartFields rest_;
  Vec2 pull_;
  std::vector<Vec2> travel_;
  std::vector<Vec2> at_, force_;   ///< (n) where K is applied, K of it
  Eigen::VectorXd load_, change_;  ///< (2 free) right-hand side, v̄ - v
  Eigen::SparseLU<Matrix> factor_;
  Works works_;
};

}  // namespace rondo::dynamics
