// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a case, solved: forces, power, and the fields at each place of a
/// sector's pass (docs/theory.md, 11.3 and 11.4).
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/steady/steady_body.hpp"
#include "rondo/output/columns.hpp"

namespace rondo::study {

/// Of the contact while a sector is at one place, or as means over its pass.
struct SteadySums {
  Vec2 force;                                    ///< of the ground, fixed axes        [N/m]
  double torque = 0.0;                           ///< about the center, counter-clockwise [N]
  int nodes = 0, sticking = 0;                   ///< not of means
  double stick_length = 0.0, slip_length = 0.0;  ///< of the deformed boundary          [m]
  double pressure = 0.0, shear = 0.0;            ///< largest                           [Pa]
  double friction = 0.0;                         ///< power taken by friction          [W/m]
  double slip = 0.0;                             ///< largest                          [m/s]
  double penetration = 0.0;                      ///< largest                            [m]
};

class SteadyState final : public RolledState {
 public:
  /// Solves. @throws InputError as SteadyBody::solve()
  SteadyState(const Case& c, const SteadyBody& body);

  [[nodiscard]] std::string trouble() const override;
  [[nodiscard]] double sample_time() const noexcept override { return window_.time(); }
  void fill(int place, Snapshot& snapshot) override;
  void displace(int place, Snapshot& snapshot) const override;
  void append_row(int place, const Snapshot& now, std::vector<double>& rows) const override;
  [[nodiscard]] SteadyResiduals residuals() const override {
    return {power_.residual, solution_.residual, mean_.penetration};
  }
  [[nodiscard]] double deflection() const override {
    return statics::lowest_place(window_) - solution_.height;
  }
  [[nodiscard]] const statics::RollingPower& power() const noexcept override { return power_; }
  [[nodiscard]] Json describe() const override;
  [[nodiscard]] std::vector<std::string> notes() const override;

 private:
  /// Of the rim, clockwise: what keeps the spin constant [N].
  [[nodiscard]] double torque() const noexcept { return solution_.forces.torque; }
  /// Power lost over speed: (ω T - V F_x) / |V|; NaN where V is 0 [N/m].
  [[nodiscard]] double resistance() const noexcept;
  [[nodiscard]] double slip_ratio() const noexcept;
  [[nodiscard]] HistoryRecord record(int place, const Snapshot& now) const;
  void solve();
  void refuse() const;
  void sum_up();
  void measure_extents();
  void unroll(const Eigen::MatrixXd& field, int place, double by, Field& nodes) const;
  [[nodiscard]] int sense() const noexcept { return spin() > 0.0 ? 1 : -1; }
  [[nodiscard]] double spin() const noexcept { return body_.harmonics->body().spin; }
  /// Where a pair is touched: place, and number in mesh.boundary.
  struct Where {
    int place = 0;
    std::size_t candidate = 0;
  };
  [[nodiscard]] Where where(std::size_t pair) const;
  [[nodiscard]] double height() const { return floor_of(case_) + solution_.height; }

  const Case& case_;
  const SteadyBody& body_;
  statics::RollingWindow window_;
  statics::RollingDrive drive_;
  statics::RollingSolution solution_;
  statics::RollingHarmonics::Block spectrum_;
  statics::RollingPower power_;
  Eigen::MatrixXd u_, rate_;               ///< (2 n_local, L); rates once a place is filled
  std::vector<std::size_t> candidate_of_;  ///< (n) place in mesh.boundary
  std::vector<double> extent_;             ///< (pairs) of the deformed boundary, where pressed [m]
  std::vector<SteadySums> sums_;           ///< (P)
  SteadySums mean_;
};

}  // namespace rondo::study
