// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini–Coulomb contact of nodes without mass over a step (docs/reduced.md): gaps, and
/// distances slid, at its end. All contacts are coupled by a dense compliance that is not
/// symmetric. Newton's method on statuses (Alart, Curnier, CMAME 92 (1991) 353), and Lemke's
/// pivoting where it cycles.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "rondo/contact/law.hpp"

namespace rondo::rom {

/// A contact; the tangent of the ground is its normal turned by -90°, so that it points ahead.
struct GapContact {
  double free_gap = 0.0;         ///< gap where nothing presses                                [m]
  double free_slip = 0.0;        ///< and the distance slid along the tangent                  [m]
  double normal = 0.0;           ///< force; in: where to start                              [N/m]
  double shear = 0.0;            ///< along the tangent                                      [N/m]
  double friction = 0.0;         ///< μ >= 0; where it changes, that at the next two
  double slip_at = 0.0;          ///< |slip|                                                   [m]
  double normal_at = 0.0;        ///< [N/m]
  double by_slip = 0.0;          ///< derivative of μ by |slip|                              [1/m]
  double by_normal = 0.0;        ///< and by the normal force                                [m/N]
  double gap = 0.0, slip = 0.0;  ///< with the forces                                    [m]
  contact::Status status = contact::Status::open;
  double side = 0.0;  ///< slips: shear = -side μ normal
};

/// Room for the largest problem: solving allocates nothing unless pivoting is needed.
class GapLaw {
 public:
  explicit GapLaw(std::size_t most_contacts);

  /// (2m, 2m) displacement along normal and tangent of each contact by forces along these of each,
  /// to be filled before solve().
  [[nodiscard]] Eigen::Map<Eigen::MatrixXd> compliance(std::size_t n_contacts);

  struct Report {
    int iterations = 0;
    bool pivoted = false;
    double residual = 0.0;  ///< of the law, over the largest force                     [-]
  };
  /// 0 <= normal ⊥ gap >= 0; |shear| <= μ normal, opposed to the slip. Where μ changes, its product
  /// with the force is taken along its tangent, and there is no pivoting: the residual tells
  /// whether this was solved.
  Report solve(std::span<GapContact> contacts);

 private:
  void settle(std::span<GapContact> contacts);
  void follow_tangents(std::span<const GapContact> contacts, Eigen::Map<Eigen::MatrixXd>& a);
  [[nodiscard]] bool judge(std::span<GapContact> contacts, bool all) const;
  void move(std::span<GapContact> contacts);
  void pivot(std::span<GapContact> contacts);
  [[nodiscard]] double residual(std::span<const GapContact> contacts) const;

  std::size_t most_;
  std::vector<double> compliance_, matrix_;
  std::vector<double> unknown_, force_;
  std::vector<Eigen::Index> rows_;  ///< of the compliance, of the unknown forces
  Eigen::Index size_ = 0;
  double mean_ = 0.0;  ///< of the compliance's diagonal                             [m²/N]
};

}  // namespace rondo::rom
