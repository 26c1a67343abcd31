// SPDX-License-Identifier: BSD-3-Clause
/// @file  A reduced wheel whose hub motion is prescribed by the caller, who receives the forces on
/// the hub (docs/fmu.md, 1). It does not depend on FMI, but an FMU of the wheel is built around it.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/fmu/values.hpp"
#include "rondo/rom/saved_reduced.hpp"

namespace rondo::fmu {

/// All data that a wheel carries from one communication step to the next.
struct SavedWheel {
  Values values;
  double dt = 0.0;  ///< internal step used; 0: no step was made                                [s]
  double velocity_x = 0.0, velocity_y = 0.0, angular_velocity = 0.0;  ///< at the last step's end
  std::optional<rom::SavedReducedState> state;                        ///< none: no step was made
};

class Wheel {
 public:
  /// @param step_factor that of `rondo run --reduced`
  Wheel(study::Case c, std::filesystem::path model, double step_factor);
  ~Wheel();
  Wheel(const Wheel&) = delete;
  Wheel& operator=(const Wheel&) = delete;

  /// Refuses what an FMU of the wheel does not support. @throws InputError, FileError
  void check();
  /// Largest internal step, and mass and inertia per metre of width. @pre begin()
  [[nodiscard]] double step() const noexcept;

  /// Creates the wheel from the parameters and inputs in `values`, at t = 0. Fills the others:
  /// forces are those of a first step with constant hub velocity, which is discarded.
  /// @throws InputError, FileError
  void begin(Values& values);
  /// Makes a communication step to the inputs in `values` at its end. @return what is wrong with
  /// it; empty: nothing, and `values` has the forces and positions. @pre refuse() returns empty
  [[nodiscard]] std::string go_on(Values& values, double length);
  /// Says if the internal step does not fit into the length, or the wheel would turn by more than
  /// most_points in it; empty: neither. @param slack allowed error of the length       [s]
  [[nodiscard]] std::string refuse(const Values& values, double length, double slack) const;
  /// More contact points per internal step are refused; more than 1 gives a warning.
  static constexpr double most_points = 2.0;

  /// The warnings since the last call, each only once.
  [[nodiscard]] std::vector<std::string> take_warnings();

  /// Allows warnings to be repeated.
  void forget_warnings();

  /// @pre begin()
  [[nodiscard]] SavedWheel save(const Values& values) const;
  /// Restores bit for bit. @pre `saved` is of a wheel of the same case and model
  /// @throws InputError: it is not
  void restore(const SavedWheel& saved, Values& values);

 private:
  struct Body;
  struct Sums;
  void make_integrator(double dt);
  [[nodiscard]] std::string refuse_length(double length, double slack) const;
  [[nodiscard]] double first_step(double length) const;
  [[nodiscard]] double points_passed(const Values& values, double dt) const;
  [[nodiscard]] static std::string points_text(double points, double dt);
  void warn_of_points(const Values& values, double dt);
  [[nodiscard]] std::string make_steps(const Values& values, long long n);
  void fill(const Values& from, double length, Values& to) const;
  void warn(std::string text);
  void warn_of_ranges(const Values& values);
  [[nodiscard]] std::string trouble() const;

  const study::Case case_;
  const std::filesystem::path model_;
  const double step_factor_;
  std::unique_ptr<Body> body_;
  std::set<std::string> said_;
  std::vector<std::string> warnings_;
};

}  // namespace rondo::fmu
