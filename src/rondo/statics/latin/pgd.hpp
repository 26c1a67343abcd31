// SPDX-License-Identifier: BSD-3-Clause
/// @file  LATIN-PGD: elasticity at all increments by few products of a field in space and a
/// function of the increments, which are found on the way (docs/latin.md, LATIN-PGD). Method:
/// Giacoma, Dureisseix, Gravouil, Rochette 2014, doi:10.1002/nme.4590.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/statics/condensation.hpp"
#include "rondo/statics/latin/latin.hpp"

namespace rondo::statics {

struct PgdOptions {
  double direction = 0.0;   ///< k > 0                                                   [N/m²]
  double tolerance = 1e-3;  ///< of the iterations
  double downsizing = 0.3;  ///< modes below 0.3 times it times the indicator go; 0: none do
};

/// Fields of a body, columns (2n): x, y of each node; with what they are on the candidates.
struct Fields {
  Eigen::MatrixXd field;    ///< (2n, r) φ                                                [m]
  Eigen::MatrixXd contact;  ///< (2m, r) Hφ                                               [m]
  Eigen::MatrixXd load;     ///< (2m, r) f with Aφ = Hᵀf                                  [N/m]
};

/// u ≈ Σ φ_i σ_i ψ_i(k): φ orthonormal in A, ψ orthonormal over the increments.
struct Separated {
  Fields modes;
  Eigen::VectorXd sigma;     ///< (r) falling                                     [(J/m)^½]
  Eigen::MatrixXd temporal;  ///< (N, r)                                                  [-]
};

class Pgd final : public Elasticity {
 public:
  /// @param stiffened K + k HᵀH of the body, factorised; it outlives this
  /// @param nodes (m) of the candidates, in the order of the histories' rows
  Pgd(const Condensation& stiffened, std::vector<int> nodes, const PgdOptions& options);

  /// Fields to begin with, whose loads are on the candidates alone: nothing is downsized then.
  /// Those that depend on others are left out. @pre no mode yet
  void begin_with(const Fields& fields);

  void solve(const Eigen::MatrixXd& load, double indicator, Eigen::MatrixXd& displacement) override;
  [[nodiscard]] Eigen::MatrixXd balanced_force(const Eigen::MatrixXd& load,
                                               const Eigen::MatrixXd& displacement) const override;

  [[nodiscard]] int modes() const noexcept { return static_cast<int>(rotation_.cols()); }
  [[nodiscard]] int most_modes() const noexcept { return most_modes_; }
  [[nodiscard]] int solves() const noexcept { return solves_; }
  /// The displacement found last, without the modes below `share` of its norm in A.
  [[nodiscard]] Separated separated(double share) const;
  /// All that was solved for or begun with, orthonormal in A: for another run to begin with.
  [[nodiscard]] Fields basis() const;

 private:
  void enrich(const Eigen::MatrixXd& load, double indicator);
  void add_mode(const Eigen::VectorXd& load);
  void downsize(double indicator);
  void watch(double indicator);
  void take_all(const Fields& fields);
  void append(const Eigen::VectorXd& field, const Eigen::VectorXd& load);

  const Condensation& body_;
  std::vector<int> nodes_;
  PgdOptions options_;
  bool keeps_all_ = false;  ///< begun with fields
  double best_ = 2.0;       ///< indicator so far, in steps of a tenth
  int waited_ = 0;          ///< iterations since
  int solves_ = 0, most_modes_ = 0;
  Fields solved_;                   ///< as they were solved, s of them
  Eigen::MatrixXd rotation_;        ///< (s, r) the modes' fields are solved_.field · rotation_
  Eigen::MatrixXd contact_, load_;  ///< (2m, r) of the modes
  Eigen::MatrixXd temporal_;        ///< (N, r) Ψ
};

/// Least number of the first values, one at least, whose rest has a norm of at most `share` of all.
/// @param sigma falling
[[nodiscard]] Eigen::Index values_kept(const Eigen::VectorXd& sigma, double share);

/// Orthonormal in A, without what depends on the rest.
[[nodiscard]] Fields orthonormal(const Fields& fields);

}  // namespace rondo::statics
