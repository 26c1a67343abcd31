// SPDX-License-Identifier: BSD-3-Clause
/// @file  A reduced wheel whose hub its caller leads, and who takes what it does to the hub
/// (docs/fmu.md, 1): nothing of FMI, but what an FMU of it is made around.
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

/// All that a wheel carries from one communication step to the next.
struct SavedWheel {
  Values values;
  double dt = 0.0;  ///< internal step taken; 0: none was made                            [s]
  double velocity_x = 0.0, velocity_y = 0.0, angular_velocity = 0.0;  ///< at the last end
  std::optional<rom::SavedReducedState> state;                        ///< none: no step was made
};

class Wheel {
 public:
  /// @param step_factor of `rondo run --reduced`
  Wheel(study::Case c, std::filesystem::path model, double step_factor);
  ~Wheel();
  Wheel(const Wheel&) = delete;
  Wheel& operator=(const Wheel&) = delete;

  /// What an FMU of it cannot be. @throws InputError, FileError
  void check();
  /// Largest internal step, and mass and inertia per metre, after begin().
  [[nodiscard]] double step() const noexcept;

  /// Made from the parameters and the inputs in `values`, at t = 0. Fills the rest of them: forces
  /// are those of a first step in which the hub goes on as it is, which is not kept.
  /// @throws InputError, FileError
  void begin(Values& values);
  /// A communication step: to the inputs in `values` at its end. @return what is wrong with it;
  /// empty: nothing. Forces and places are in `values` then. @pre refuse() does not
  [[nodiscard]] std::string go_on(Values& values, double length);
  /// The length is none that the internal step fits into, or the wheel turns by more than
  /// most_points in that; empty: neither. @param slack that the length may be off by        [s]
  [[nodiscard]] std::string refuse(const Values& values, double length, double slack) const;
  /// Contact points in an internal step that are refused; above 1 is warned of.
  static constexpr double most_points = 2.0;

  /// What was said since the last call: each only once.
  [[nodiscard]] std::vector<std::string> take_warnings();

  /// What was said is to be said again.
  void forget_warnings();

  /// @pre begin()
  [[nodiscard]] SavedWheel save(const Values& values) const;
  /// To the same bits. @pre it is of a wheel of the same case and model
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
