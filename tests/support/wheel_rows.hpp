// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rows of V22 to V24: the runs, the measured quantities, and the results of an
/// independent program with the same equations, on three resolutions (docs/validation.md).
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <numbers>
#include <ostream>

#include "support/wheel.hpp"

namespace rondo::test {

/// A column of the tables.
enum class Column { full, half, fine };
inline constexpr std::array all_columns{Column::full, Column::half, Column::fine};

inline const char* column_name(Column c) {
  return c == Column::full ? "full_step" : c == Column::half ? "half_step" : "fine_mesh";
}
inline Settings resolution(Column c) {
  if (c == Column::half) return {"time.safety=0.4"};
  if (c == Column::fine) return {"disk.mesh.radial=24", "disk.mesh.circumferential=360"};
  return {};
}

/// Expected value in each column; NaN: not known.
struct Figure {
  const char* name;
  double full, half, fine;
  double
      edge;  ///< what a step more or less at the ends of the window does, or the last digit given

  [[nodiscard]] double expected(Column c) const {
    return c == Column::full ? full : c == Column::half ? half : fine;
  }
  /// Both programs make the same steps, but may count other steps in a window, and a node may touch
  /// one step later. The tolerance is the effect of half the step, a tenth of the effect of half
  /// the mesh size, and that of the window.
  [[nodiscard]] double tolerance() const {
    const double of_mesh = std::isnan(fine) ? 0.0 : 0.1 * std::abs(full - fine);
    return std::abs(full - half) + of_mesh + edge;
  }
};

struct WheelRow {
  const char* name;
  Settings settings;
  double end;  ///< [s]
  /// Values in the order of the figures.
  std::function<std::vector<double>(Wheel&)> measure;
  std::vector<Figure> figures;
};

inline void PrintTo(const WheelRow& row, std::ostream* out) {
  *out << row.name;
}

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// ---- V22: rolling under load -------------------------------------------------------------------

inline std::vector<double> rolling_figures(Wheel& wheel) {
  const WheelMeans m = wheel.means(0.2, 0.3);
  return {m.spin, 10.0 / m.spin, m.height, m.force.x, m.force.y};
}
inline std::vector<double> torque_figures(Wheel& wheel) {
  const WheelMeans m = wheel.means(0.2, 0.3);
  return {m.spin, m.force.x};
}

/// Force of the ground over slip while the brake torque grows, as means over eight node spacings,
/// which leave 4e-4 of oscillation; then the locked wheel slides.
class BrakeRamp {
 public:
  void see(const dynamics::StepReport& r) {
    if (r.frame.time > 0.08 && r.frame.time <= 0.1) {
      ++free_steps_;
      free_spin_ += (r.rim.spin - free_spin_) / free_steps_;
    }
    if (locked_at == 0.0 && r.rim.spin == 0.0) locked_at = r.frame.time;
    window_.push_back({-r.frame.angle, r.rim.spin, r.contact.impulse.plane()});
    while (window_.back().angle - window_.front().angle > 16.0 * std::numbers::pi / 180.0)
      window_.pop_front();
    if (r.frame.time > 0.11) see_window();
  }
  std::vector<double> traction;  ///< F_x/F_y at slips of 1, 2, 4, 6 %
  double peak = 0.0;             ///< largest -F_x/F_y
  double locked_at = 0.0;        ///< [s]

 private:
  struct Step {
    double angle, spin;
    Vec2 impulse;
  };
  void see_window() {
    double spin = 0.0;
    Vec2 sum;
    for (const Step& s : window_) {
      spin += s.spin / static_cast<double>(window_.size());
      sum += s.impulse;
    }
    const double slip = 1.0 - spin / free_spin_, ratio = sum.x / sum.y;
    peak = std::max(peak, -ratio);
    constexpr std::array at{0.01, 0.02, 0.04, 0.06};
    if (traction.size() < at.size() && slip >= at[traction.size()]) {
      const double part = (at[traction.size()] - slip_before_) / (slip - slip_before_);
      traction.push_back(ratio_before_ + part * (ratio - ratio_before_));
    }
    slip_before_ = slip;
    ratio_before_ = ratio;
  }

  std::deque<Step> window_;
  double free_spin_ = 0.0, slip_before_ = 0.0, ratio_before_ = 0.0;
  int free_steps_ = 0;
};

inline std::vector<double> lock_figures(Wheel& wheel) {
  BrakeRamp ramp;
  wheel.look(0.0, 0.56, [&](const dynamics::StepReport& r) { ramp.see(r); });
  std::vector<double> found = ramp.traction;
  found.insert(found.end(), {ramp.peak, ramp.locked_at, wheel.run().report().rim.spin});
  return found;
}

inline std::vector<WheelRow> loaded_rows() {
  return {
      {"rolling",
       {},
       0.3,
       rolling_figures,
       {{"spin", 33.7529, 33.7530, 33.7837, 1e-4},
        {"rolling_radius", 0.296270, 0.296270, 0.296000, 1e-6},
        {"height", 0.291665, 0.291668, 0.291673, 1e-6},
        {"force_x", -236.66, -236.45, -224.89, 0.17},
        {"force_y", 149993, 149995, 149999, 1.8}}},  // 4.5e3 N/m of swing over 5,026 steps, twice
      {"braked",
       {"rim.brake=[[0, 0], [0.05, 0], [0.1, 1e4]]"},
       0.3,
       torque_figures,
       {{"spin", 33.0074, 33.0074, 33.0249, 1e-4}, {"force_x", -34227, -34227, -34263, 1.0}}},
      {"driven",
       {"rim.torque=[[0, 0], [0.05, 0], [0.1, 1e4]]"},
       0.3,
       torque_figures,
       {{"spin", 34.4381, 34.4381, 34.4736, 1e-4}, {"force_x", 33651, 33651, 33706, 1.0}}},
      {"lock",
       {"rim.brake=[[0, 0], [0.1, 0], [0.5, 3.2e4]]"},
       0.56,
       lock_figures,
       {{"slip_1", -0.08637, -0.08632, unknown, 4e-4},
        {"slip_2", -0.18326, -0.18321, unknown, 4e-4},
        {"slip_4", -0.34801, -0.34784, unknown, 4e-4},
        {"slip_6", -0.47075, -0.47069, unknown, 4e-4},
        {"peak", 0.6000, 0.6000, unknown, 5e-5},
        {"locked_at", 0.542535, 0.542535, unknown, 2e-5},
        {"spin_after", 0.0, 0.0, unknown, 0.0}}},
  };
}

// ---- V24: obstacles ----------------------------------------------------------------------------

/// Extremes while the wheel passes the cleat, after it has settled, and its impulse.
inline std::vector<double> cleat_figures(Wheel& wheel, bool at_load) {
  double highest = 0.0, force = 0.0, slowest = 1e9, fastest = 0.0, impulse = 0.0;
  wheel.look(0.05, 0.18, [&](const dynamics::StepReport& r) {
    highest = std::max(highest, r.frame.center.y);
    force = std::max(force, r.contact.impulse.y / wheel.dt());
    slowest = std::min(slowest, r.rim.spin);
    fastest = std::max(fastest, r.rim.spin);
    impulse += r.contact.impulse.y;
  });
  if (at_load) return {highest, slowest, fastest, impulse};
  return {force, slowest, fastest};
}

inline const Settings cleat{
    "motion.speed=5", "motion.angular_velocity=16.87",
    "ground.profile=[[-10, 0], [0.5, 0], [0.52, 0.01], [0.56, 0.01], [0.58, 0], [10, 0]]",
    "ground.fillet=0.02"};

inline std::vector<WheelRow> obstacle_rows() {
  return {
      {"cleat_at_load",
       with(cleat, {"rim.support.y.damping=1e4"}),
       0.18,
       [](Wheel& wheel) { return cleat_figures(wheel, true); },
       {{"height", 0.300387, 0.300396, 0.300334, 1e-6},
        {"slowest", 16.4178, 16.4184, 16.4280, 1e-4},
        {"fastest", 17.7121, 17.7119, 17.7141, 1e-4},
        {"impulse_y", 19402.5, 19401.5, 19401.5, 0.1}}},
      {"cleat_at_height",
       with(cleat, {"rim.free=[\"angular_velocity\"]", "rim.force_y=0", "rim.support.y.damping=0",
                    "motion.height=[[0, 0.3], [0.03, 0.2917]]"}),
       0.18,
       [](Wheel& wheel) { return cleat_figures(wheel, false); },
       {{"force_y", 285349, 285412, 286556, 1.0},
        {"slowest", 15.9173, 15.9175, 15.9339, 1e-4},
        {"fastest", 17.9915, 17.9916, 18.0209, 1e-4}}},
  };
}

// ---- V23: free motion --------------------------------------------------------------------------

inline const std::string all_free = "rim.free=[\"speed\", \"height\", \"angular_velocity\"]";

inline std::vector<double> acceleration_figure(Wheel& wheel) {
  return {wheel.acceleration(0.3, 0.6)};
}
inline std::vector<double> launch_figures(Wheel& wheel) {
  const double a = wheel.acceleration(0.3, 0.5);
  return {a, wheel.run().report().rim.velocity.x};
}
inline std::vector<double> landing_figures(Wheel& wheel) {
  const double spin = wheel.means(0.1, 0.12).spin;
  return {spin, wheel.run().balance().works.dissipation_friction};
}

/// Values in the air after the first contact. The rim oscillates on the body; means over any part
/// of the flight agree to 4e-4 m/s and 8e-4 rad/s.
inline std::vector<double> drop_figures(Wheel& wheel) {
  Vec2 impulse;
  wheel.look(0.0, 0.15,
             [&](const dynamics::StepReport& r) { impulse += r.contact.impulse.plane(); });
  const WheelMeans m = wheel.means(0.15, 0.2);
  return {m.speed, m.spin, impulse.x, impulse.y, wheel.run().report().frame.center.y};
}

inline std::vector<WheelRow> free_rows() {
  return {
      {"incline",
       {all_free, "motion.slope=0.08726646259971647", "motion.gravity=9.81", "rim.force_y=0",
        "rim.mass=2000", "rim.inertia=60", "ground.friction=0.8", "damping.mass=0",
        "rim.support.y.damping=3e5", "motion.speed=1", "motion.angular_velocity=3.33889816361"},
       0.6,
       acceleration_figure,
       {{"acceleration", 0.624636, 0.624638, unknown, 3e-6}}},
      {"drop",
       {all_free, "motion.gravity=9.81", "rim.force_y=0", "ground.friction=0.5", "damping.mass=0",
        "rim.support.y.damping=0", "motion.height=0.35", "motion.speed=2",
        "motion.angular_velocity=-20"},
       0.2,
       drop_figures,
       {{"speed", 0.944586, 0.944705, 0.944175, 4e-4},
        {"spin", -12.6492, -12.6503, -12.6500, 8e-4},
        {"impulse_x", -351.77, -351.73, -351.95, 0.01},
        {"impulse_y", 703.54, 703.46, 703.89, 0.01},
        {"height", 0.347107, 0.347094, 0.347195, 1e-6}}},
      {"landing",
       {"motion.speed=20", "motion.angular_velocity=0", "ground.friction=0.5",
        "rim.force_y=[[0, 0], [0.02, -1e5]]"},
       0.12,
       landing_figures,
       {{"spin", 67.4667, 67.4670, 67.5145, 1e-4}, {"friction", 32607, 32608, 32661, 1.0}}},
      {"launch",
       {all_free, "motion.speed=0", "motion.angular_velocity=0",
        "rim.torque=[[0, 0], [0.05, 0], [0.06, 1e4]]"},
       0.5,
       launch_figures,
       {{"acceleration", 66.780, 66.778, unknown, 1e-3}, {"speed", 29.958, 29.956, unknown, 1e-3}}},
  };
}

inline std::vector<WheelRow> all_rows() {
  std::vector<WheelRow> all;
  for (const auto& rows : {loaded_rows(), free_rows(), obstacle_rows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

/// Makes the run and checks it; the figures are written to the record of the test.
inline void expect_row(const WheelRow& row, Column column) {
  Wheel wheel(with(row.settings, resolution(column)));
  const std::vector<double> found = row.measure(wheel);
  ASSERT_EQ(found.size(), row.figures.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Figure& figure = row.figures[i];
    testing::Test::RecordProperty(figure.name, fmt::format("{:.8g}", found[i]));
    if (std::isnan(figure.expected(column))) continue;
    EXPECT_NEAR(found[i], figure.expected(column), figure.tolerance()) << figure.name;
  }
  EXPECT_GE(wheel.run().report().frame.time, row.end);
  EXPECT_LT(wheel.run().balance().relative, 1e-12);
}

}  // namespace rondo::test
