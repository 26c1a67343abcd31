// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a case in three dimensions, solved: forces, power, and the fields at
/// each place of a sector's pass (docs/wheel3d.md).
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/steady/solid_steady_body.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/statics/steady_solid/solid_power.hpp"

namespace rondo::study {

/// Of the contact while a sector is at one place, or as means over its pass.
struct SolidSteadySums {
  Vec3 force;   ///< of the ground, along n, t1 and t2                                     [N]
  Vec3 moment;  ///< about the center's projection on the ground, axes of the wheel      [N·m]
  double torque = 0.0;                       ///< about the axle, counter-clockwise      [N·m]
  int nodes = 0, sticking = 0;               ///< not of means
  double stick_area = 0.0, slip_area = 0.0;  ///< of the deformed surface                [m²]
  double pressure = 0.0, shear = 0.0;        ///< largest                                 [Pa]
  double friction = 0.0;                     ///< power taken by friction                  [W]
  double slip = 0.0;                         ///< largest                                [m/s]
  double penetration = 0.0;                  ///< largest                                  [m]
};

class SolidSteadyState final : public RolledState {
 public:
  /// Solves. @throws InputError as SolidSteadyBody::solve()
  SolidSteadyState(const Case& c, const SolidSteadyBody& body);

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
  [[nodiscard]] Json describe() const override;
  [[nodiscard]] std::vector<std::string> notes() const override;

 private:
  /// Of the rim, clockwise: what keeps the spin constant [N·m].
  [[nodiscard]] double torque() const noexcept { return solution_.forces.torque; }
  /// Power lost over speed: (ω T - V·F) / |V|; NaN where V is 0 [N].
  [[nodiscard]] double resistance() const noexcept;
  [[nodiscard]] double slip_ratio() const noexcept;
  [[nodiscard]] double height() const { return floor_of(case_) + solution_.height; }
  [[nodiscard]] HistoryRecord record(int place, const Snapshot& now) const;
  void solve();
  void refuse() const;
  [[nodiscard]] std::string not_solved() const;
  void sum_up();
  void measure_extents();
  void add(std::size_t pair, double share, SolidSteadySums& sums) const;
  void unroll(const Eigen::MatrixXd& field, int place, double by, Field& nodes) const;
  [[nodiscard]] int sense() const noexcept { return spin() > 0.0 ? 1 : -1; }
  [[nodiscard]] double spin() const noexcept { return body_.harmonics->body().spin; }
  /// Where a pair is touched: place, and number in mesh.boundary.
  struct Where {
    int place = 0;
    std::size_t candidate = 0;
  };
  [[nodiscard]] Where where(std::size_t pair) const;
  [[nodiscard]] Vec3 force(std::size_t pair) const;
  [[nodiscard]] double slip(std::size_t pair) const;

  const Case& case_;
  const SolidSteadyBody& body_;
  statics::SolidWindow window_;
  statics::SolidRollingDrive drive_;
  statics::SolidRollingSolution solution_;
  statics::SolidHarmonics::Block spectrum_;
  statics::RollingPower power_;
  Eigen::MatrixXd u_, rate_;               ///< (3 n_local, L); rates once a place is filled
  std::vector<std::size_t> candidate_of_;  ///< (n) place in mesh.boundary
  std::vector<double> extent_;         ///< (pairs) of the deformed boundary, where pressed [m²]
  std::vector<SolidSteadySums> sums_;  ///< (P)
  SolidSteadySums mean_;
};

}  // namespace rondo::study
