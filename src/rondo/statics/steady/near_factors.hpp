// SPDX-License-Identifier: BSD-3-Clause
/// @file  Dense systems that differ little from one to the next, as those of Newton's method do.
/// Source: GMRES of Saad, Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856, preconditioned from the
/// right by the factors of an earlier system in single precision, and repeated on what is left
/// (iterative refinement: Carson, Higham, SIAM J. Sci. Comput. 40 (2018) A817). A step of Newton's
/// method far from its end leaves more of its system (Dembo, Eisenstat, Steihaug, SIAM J. Numer.
/// Anal. 19 (1982) 400).
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace rondo::statics {

/// A x = b of unknowns with names, by which those of another system are found. Row i has the name
/// of unknown i.
struct NamedSystem {
  const Eigen::MatrixXd& matrix;           ///< (n, n)
  const std::vector<Eigen::Index>& names;  ///< (n) >= 0, each once
  /// (n) that bring all rows to one unit: what is left of a system is measured so
  const Eigen::VectorXd& weights;
};

class NearFactors {
 public:
  /// What is left of a system over its right side, where factors in double precision leave as much.
  static constexpr double as_good_as_direct = 1e-13;

  /// Solves with the factors that there are, or with those of this system, which are then kept. At
  /// least nine tenths of what was left of the system are gone, and more the less that was.
  /// Empty: neither factors do it; the system is singular or nearly so.
  /// @param from where the search starts (n)
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(const NamedSystem& system,
                                                     const Eigen::VectorXd& right,
                                                     const Eigen::VectorXd& from);

  /// Whether the last system that was solved is solved as well as with factors of its own.
  [[nodiscard]] bool is_exact() const noexcept { return left_ <= as_good_as_direct; }
  /// How many systems were factorised.
  [[nodiscard]] int made() const noexcept { return made_; }

 private:
  bool make(const NamedSystem& system);
  void renumber(const NamedSystem& system);
  [[nodiscard]] Eigen::VectorXd applied(const Eigen::VectorXd& v) const;
  [[nodiscard]] Eigen::VectorXd correction(const NamedSystem& system, const Eigen::VectorXd& left,
                                           double enough, Eigen::Index& steps) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> refined(const NamedSystem& system,
                                                       const Eigen::VectorXd& right,
                                                       Eigen::VectorXd x);

  Eigen::MatrixXf factors_;
  std::vector<int> pivots_;
  std::vector<Eigen::Index> names_;   ///< of the factors
  std::vector<Eigen::Index> places_;  ///< (n) of the system's unknowns in the factors; -1: nowhere
  Eigen::VectorXd diagonal_;          ///< (n) of the system, weighted
  int made_ = 0;
  double left_ = 0.0;  ///< of the last system, over its right side
};

}  // namespace rondo::statics
