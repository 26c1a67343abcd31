// SPDX-License-Identifier: BSD-3-Clause
/// @file  A reduced wheel whose hub motion is prescribed by the caller, who receives the forces on
/// the hub (docs/fmu.md, 1). It does not depend on FMI, but an FMU of the wheel is built around it.
#pragma once
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/fmu/values.hpp"
#include "rondo/model/saved_state.hpp"
#include "rondo/output/run_options.hpp"
#include "rondo/rom/solid_wheel_run.hpp"

namespace rondo::fmu {

/// All data that a wheel carries from one communication step to the next.
struct SavedWheel {
  Values values;
  Values start;     ///< with which the wheel was made
  double dt = 0.0;  ///< internal step used; 0: no step was made                                [s]
  rom::HubVelocity hub;                       ///< at the last step's end
  std::optional<dynamics::SavedState> state;  ///< step, ring and ledger; none: no step was made
};

class Wheel {
 public:
  /// @param options modes and step of `rondo run --reduced`
  Wheel(study::Case c, study::RunOptions options);
  ~Wheel();
  Wheel(const Wheel&) = delete;
  Wheel& operator=(const Wheel&) = delete;

  /// Refuses what an FMU of the wheel does not support. @throws InputError, FileError
  void check();
  [[nodiscard]] Dimension dimension() const;
  /// Largest internal step [s], number of modes. @pre begin()
  [[nodiscard]] double step() const noexcept;
  [[nodiscard]] int n_modes() const;

  /// Creates the wheel from the parameters and inputs in `values`, at t = 0. Fills the others:
  /// forces are those of a first step with constant hub velocity, which is discarded.
  /// @throws InputError, FileError
  void begin(Values& values);
  /// Makes a communication step to the inputs in `values` at its end. @return what is wrong with
  /// it; empty: nothing, and `values` has the forces and positions. @pre refuse() returns empty
  [[nodiscard]] std::string go_on(Values& values, double length);
  /// Says if the internal step does not fit into the length, or the wheel would turn by more than
  /// most_sectors in it; empty: neither. @param slack allowed error of the length       [s]
  [[nodiscard]] std::string refuse(const Values& values, double length, double slack) const;
  /// More sectors of the mesh in an internal step are refused; more than good_sectors give a
  /// warning.
  static constexpr double most_sectors = 2.0, good_sectors = 0.67;

  /// The warnings since the last call, each only once.
  [[nodiscard]] std::vector<std::string> take_warnings();

  /// Allows warnings to be repeated.
  void forget_warnings();

  /// @pre begin()
  [[nodiscard]] SavedWheel save(const Values& values) const;
  /// Restores bit for bit. @pre `saved` is of a wheel of the same case and options
  /// @throws InputError: it is not
  void restore(const SavedWheel& saved, Values& values);

 private:
  struct Body;
  void make_integrator(double dt);
  [[nodiscard]] std::string refuse_length(double length, double slack) const;
  [[nodiscard]] double first_step(double length) const;
  [[nodiscard]] double sectors_passed(const Values& values, double dt) const;
  [[nodiscard]] static std::string passed_text(double sectors, double dt);
  void warn_of_step(const Values& values, double dt);
  [[nodiscard]] std::string make_steps(const Values& values, long long n);
  void warn(std::string text);
  void warn_of_spin(const Values& values);
  [[nodiscard]] std::string trouble(const dynamics::StepReport& made) const;

  const study::Case case_;
  const study::RunOptions options_;
  std::unique_ptr<Body> body_;
  std::set<std::string> said_;
  std::vector<std::string> warnings_;
};

}  // namespace rondo::fmu
