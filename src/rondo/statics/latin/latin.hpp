// SPDX-License-Identifier: BSD-3-Clause
/// @file  LATIN for the quasi-static crush: all increments at once, alternating between the contact
/// laws, which are local, and elasticity, which is linear (docs/latin.md). Method: Ladevèze
/// 1999; Giacoma, Dureisseix, Gravouil, Rochette 2014, doi:10.1002/nme.4590.
///
/// Histories are matrices (2m, N): a column an increment, and of its rows a pair for each of the m
/// candidates of a condensation, normal and tangential, in the contact frame (statics/crush.hpp):
/// forces r [N/m]; places w, which are the gap and the slip since first touch [m].
#pragma once
#include <Eigen/Core>

namespace rondo::statics {

struct LatinProblem {
  Eigen::MatrixXd compliance;  ///< (2m, 2m) G                                          [m²/N]
  Eigen::MatrixXd free;        ///< (2m, N) places without forces                       [m]
  double friction = 0.0;       ///< μ >= 0
};

/// Forces and places at all increments.
struct LatinPair {
  Eigen::MatrixXd force, place;
};

/// A search direction that suits: 1/√(λ_1 λ_n) of the compliance's eigenvalues, and two thirds of
/// it where the body slides [N/m²]. @pre the compliance is positive definite
[[nodiscard]] double chosen_direction(const Eigen::MatrixXd& compliance, bool slides);

/// The pair nearest to (force, place) along the direction k that obeys the laws, (L.3).
void obey_laws(const LatinPair& elastic, double direction, double friction, LatinPair& lawful);

/// The law's residual over all increments, (L.7): about the relative error of the forces.     [-]
[[nodiscard]] double history_residual(const LatinProblem& problem, const LatinPair& pair);

/// The residual of each increment: the largest of its candidates over the largest force of all
/// increments, (6.4d). (N)
[[nodiscard]] Eigen::VectorXd increment_residuals(const LatinProblem& problem,
                                                  const LatinPair& pair);

/// Elasticity seen from the candidates: u = A⁻¹ Hᵀ b with A = K + k HᵀH.
class Elasticity {
 public:
  Elasticity() = default;
  Elasticity(const Elasticity&) = delete;
  Elasticity& operator=(const Elasticity&) = delete;
  virtual ~Elasticity() = default;
  /// @param load b (2m, N) [N/m], indicator of the iteration before
  /// @param displacement H u (2m, N) [m]
  virtual void solve(const Eigen::MatrixXd& load, double indicator,
                     Eigen::MatrixXd& displacement) = 0;
  /// The forces that hold exactly the displacement last found (2m, N) [N/m].
  [[nodiscard]] virtual Eigen::MatrixXd balanced_force(
      const Eigen::MatrixXd& load, const Eigen::MatrixXd& displacement) const = 0;
};

/// By the dense compliance.
class CondensedElasticity final : public Elasticity {
 public:
  CondensedElasticity(const Eigen::MatrixXd& compliance, double direction);
  void solve(const Eigen::MatrixXd& load, double indicator, Eigen::MatrixXd& displacement) override;
  [[nodiscard]] Eigen::MatrixXd balanced_force(const Eigen::MatrixXd& load,
                                               const Eigen::MatrixXd& displacement) const override;

 private:
  double direction_;
  Eigen::MatrixXd stiffened_;  ///< H A⁻¹ Hᵀ (2m, 2m) [m²/N]
};

struct LatinReport {
  int iterations = 0;
  double indicator = 1.0;  ///< η: distance of the two pairs, below the error by 2 to 5   [-]
  double residual = 1.0;   ///< history_residual of the balanced pair                     [-]
};

/// The alternation. @pre direction > 0, 0 < relaxation <= 1
class Latin {
 public:
  Latin(const LatinProblem& problem, Elasticity& elasticity, double direction, double relaxation);
  /// Laws, then elasticity.
  LatinReport iterate();
  /// In balance, before relaxation; the laws hold but for the residual.
  [[nodiscard]] const LatinPair& balanced() const noexcept { return balanced_; }
  /// Relaxed: what the next iteration starts from.
  [[nodiscard]] const LatinPair& pair() const noexcept { return elastic_; }
  /// Obeys the laws; not in balance.
  [[nodiscard]] const LatinPair& lawful() const noexcept { return lawful_; }

 private:
  const LatinProblem& problem_;
  Elasticity& elasticity_;
  double direction_, relaxation_;
  LatinReport report_;
  LatinPair elastic_, lawful_, balanced_;
  Eigen::MatrixXd load_, displacement_;
};

}  // namespace rondo::statics
