// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a case, solved: forces, power, and the fields at each place of a
/// sector's pass (docs/theory.md, 11.3 and 11.4).
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/steady/steady_body.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/output/snapshot.hpp"
#include "rondo/statics/steady/rolling_power.hpp"

namespace rondo::study {

/// Of the contact while a sector is at one place, or as means over its pass.
struct SteadySums {
  Vec2 force;                                    ///< of the ground, fixed axes        [N/m]
  double torque = 0.0;                           ///< about the center, counter-clockwise [N]
  int nodes = 0, sticking = 0;                   ///< not of means
  double stick_length = 0.0, slip_length = 0.0;  ///< tributary lengths, summed          [m]
  double pressure = 0.0, shear = 0.0;            ///< largest                           [Pa]
  double friction = 0.0;                         ///< power taken by friction          [W/m]
  double slip = 0.0;                             ///< largest                          [m/s]
  double penetration = 0.0;                      ///< largest                            [m]
};

class SteadyState {
 public:
  /// Solves. @throws InputError: nothing touches; the speed of what slides as a whole is asked for.
  /// @pre the body has its harmonics, and outlives the object
  SteadyState(const Case& c, const SteadyBody& body);

  /// What is wrong; empty: solved.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] const statics::RollingSolution& solution() const noexcept { return solution_; }
  [[nodiscard]] const statics::RollingPower& power() const noexcept { return power_; }
  [[nodiscard]] const SteadySums& mean() const noexcept { return mean_; }
  /// Of the rim, clockwise: what keeps the spin constant [N].
  [[nodiscard]] double torque() const noexcept;
  /// Power lost over speed: (ω T - V F_x) / |V|; NaN where V is 0 [N/m].
  [[nodiscard]] double resistance() const noexcept;
  [[nodiscard]] double slip_ratio() const noexcept;
  /// Height, speed and slip, for the user.
  [[nodiscard]] std::string motion_text() const;
  /// Length of a pass over the number of its places [s].
  [[nodiscard]] double sample_time() const noexcept { return window_.time(); }

  /// While sector 0 is `place` samples beyond the lowest point, in the sense of the spin.
  [[nodiscard]] const SteadySums& sums(int place) const;
  /// @param now as filled for it
  [[nodiscard]] HistoryRecord record(int place, const Snapshot& now) const;
  void fill(int place, Snapshot& snapshot);
  /// @param u (n) [m]
  void displace(int place, std::vector<Vec2>& u) const;
  /// For run.json.
  [[nodiscard]] Json describe() const;

 private:
  void solve();
  void refuse() const;
  void sum_up();
  void find_fields();
  void unroll(const Eigen::MatrixXd& field, int place, double by, std::vector<Vec2>& out) const;
  [[nodiscard]] int sense() const noexcept { return spin() > 0.0 ? 1 : -1; }
  [[nodiscard]] double spin() const noexcept { return body_.harmonics->body().spin; }
  /// Where a pair is touched: place and sector.
  struct Where {
    int place = 0;
    std::size_t sector = 0, node = 0, candidate = 0;
  };
  [[nodiscard]] Where where(std::size_t pair) const;
  [[nodiscard]] Vec2 center(int place) const;

  const Case& case_;
  const SteadyBody& body_;
  statics::RollingWindow window_;
  statics::RollingDrive drive_;
  statics::RollingSolution solution_;
  statics::RollingHarmonics::Block spectrum_;
  statics::RollingPower power_;
  Eigen::MatrixXd u_, rate_;               ///< (2 n_local, L); rates once a place is filled
  std::vector<std::size_t> candidate_of_;  ///< (n) place in mesh.boundary
  std::vector<SteadySums> sums_;           ///< (P)
  SteadySums mean_;
};

}  // namespace rondo::study
