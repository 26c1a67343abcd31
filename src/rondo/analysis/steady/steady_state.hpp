// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a case, solved: forces, power, and the fields at each place of a
/// sector's pass (docs/theory.md, 11.3 and 11.4, and docs/wheel3d.md), in the plane (D = 2), where
/// all is per metre of width, or in space.
#pragma once
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/steady/slip_error.hpp"
#include "rondo/analysis/steady/steady_body.hpp"
#include "rondo/mesh/deformed_boundary.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/statics/steady/finite_rolling.hpp"
#include "rondo/statics/steady/law/rolling_friction.hpp"

namespace rondo::study {

/// The contact while a sector is at one place, or its means over the pass.
struct SteadySums {
  statics::RollingForces forces;       ///< without the torque of the weight
  int nodes = 0, sticking = 0;         ///< not of means
  double stick = 0.0, slip = 0.0;      ///< deformed length [m], in space area [m²], of those nodes
  double pressure = 0.0, shear = 0.0;  ///< largest                                    [Pa]
  double friction = 0.0;               ///< power taken by friction                     [W]
  double speed = 0.0;                  ///< largest slip                              [m/s]
  double penetration = 0.0;            ///< largest                                     [m]
  /// Coefficients of friction of those nodes.
  double least_friction = std::numeric_limits<double>::infinity(), most_friction = 0.0;
  double length = 0.0, width = 0.0;  ///< of the footprint, in space only             [m]
};

template <int D>
class SteadyState final : public RolledState {
 public:
  /// Solves. @throws InputError as SteadyBody::solve()
  SteadyState(const Case& c, const SteadyBody<D>& body);

  [[nodiscard]] std::string trouble() const override;
  [[nodiscard]] double sample_time() const noexcept override { return window_.time(); }
  void fill(int place, Snapshot& snapshot) override;
  void displace(int place, Snapshot& snapshot) const override;
  void append_row(int place, const Snapshot& now, std::vector<double>& rows) const override;
  [[nodiscard]] SteadyResiduals residuals() const override {
    return {power_.residual, solution_.residual, mean_.penetration};
  }
  [[nodiscard]] double deflection() const override { return window_.lowest() - solution_.height; }
  [[nodiscard]] const statics::RollingPower& power() const noexcept override { return power_; }
  [[nodiscard]] std::string warning() const override {
    return slip_warning(case_, slip_error_, solution_.forces);
  }
  void describe(Json& json) const override;
  [[nodiscard]] const SlipStep* slip_step() const noexcept override {
    return slip_step_ ? &*slip_step_ : nullptr;
  }
  [[nodiscard]] std::vector<std::string> notes() const override;

 private:
  using Vec = typename statics::RollingBody<D>::Vec;
  /// The torque on the rim, clockwise, that keeps the spin constant [N m].
  [[nodiscard]] double torque() const noexcept { return solution_.forces.torque; }
  /// What is known of coefficients that did not settle.
  [[nodiscard]] std::string friction_not_found() const;
  /// Power lost over speed: (ω T - V·F - φ V M_n) / |V|; NaN where V is 0 [N].
  [[nodiscard]] double resistance() const noexcept;
  [[nodiscard]] double slip_ratio() const noexcept;
  [[nodiscard]] HistoryRecord record(int place, const Snapshot& now) const;
  [[nodiscard]] statics::RollingSolution solved(statics::RollingWindow<D>& window) const;
  void solve_finite();
  /// Gives another window the state, with its tangent.
  void linearise(statics::RollingWindow<D>& other) const;
  void solve();
  void estimate_slip_error();
  void refuse() const;
  void step_slip();
  [[nodiscard]] std::string nothing_touches() const;
  [[nodiscard]] std::string why_it_slides() const;
  [[nodiscard]] std::string not_solved() const;
  /// What is lost and where; empty: it does not move.
  [[nodiscard]] std::string resistance_note() const;
  void sum_up();
  void measure_extents();
  void measure_footprint(int place, const mesh::DeformedBoundary& boundary, FieldView u);
  void add(std::size_t pair, double share, SteadySums& sums) const;
  void unroll(const Eigen::MatrixXd& field, int place, double by, Field& nodes) const;
  [[nodiscard]] int sense() const noexcept { return spin() > 0.0 ? 1 : -1; }
  [[nodiscard]] double spin() const noexcept { return body_.harmonics->body().spin; }
  /// The sample of the pass at which a pair touches, and its node by number in mesh.boundary.
  struct Where {
    int place = 0;
    std::size_t candidate = 0;
  };
  [[nodiscard]] Where where(std::size_t pair) const;
  [[nodiscard]] double height() const { return floor_of(case_) + solution_.height; }
  /// The force of a pair along n, t1 and, in space, t2 [N].
  [[nodiscard]] statics::NodeVector<D> force(std::size_t pair) const {
    return solution_.force.segment<D>(static_cast<Eigen::Index>(D * pair));
  }
  /// The slip of a pair: in the plane along t1 with its sign, in space its length [m/s].
  [[nodiscard]] double slip(std::size_t pair) const;

  const Case& case_;
  const SteadyBody<D>& body_;
  statics::RollingWindow<D> window_;
  std::optional<statics::RollingFriction> law_;  ///< none: friction is constant
  statics::RollingDrive drive_;
  statics::RollingSolution solution_;
  Eigen::MatrixXcd spectrum_;
  std::optional<statics::FiniteRolling> finite_;          ///< none: the motion is linear
  std::unique_ptr<statics::RollingRemainder> remainder_;  ///< until the state is found
  std::vector<double> energies_;  ///< (P) stored at each place, if it is not [J]
  statics::RollingPower power_;
  std::optional<SlipError> slip_error_;    ///< none: not asked for, or not found
  std::optional<SlipStep> slip_step_;      ///< none: not asked for
  Eigen::MatrixXd u_, rate_;               ///< (D n_local, L); rates once a place is filled
  std::vector<std::size_t> candidate_of_;  ///< (n) place in mesh.boundary
  std::vector<double> extent_;             ///< (pairs) deformed length or area, where pressed
  std::vector<SteadySums> sums_;           ///< (P)
  SteadySums mean_;
};

}  // namespace rondo::study
