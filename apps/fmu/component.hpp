// SPDX-License-Identifier: BSD-3-Clause
/// @file  An instance of the FMU: its wheel, and the order of calls (FMI 2.0.4, 4.2.4).
#pragma once
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "fmi2.hpp"
#include "rondo/fmu/wheel.hpp"

namespace rondo::fmu {

enum class Phase { instantiated, initializing, stepping, terminated, failed };

class Component {
 public:
  /// @param resources folder of the FMU. @throws InputError, FileError
  Component(const std::string& name, const std::string& resources, const std::string& guid,
            const fmi2CallbackFunctions& callbacks, bool logs);
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  ~Component();

  fmi2Status enter_initialization();
  fmi2Status exit_initialization();
  fmi2Status terminate();
  fmi2Status reset();
  fmi2Status get(const fmi2ValueReference* references, std::size_t n, double* values);
  fmi2Status set(const fmi2ValueReference* references, std::size_t n, const double* values);
  fmi2Status step(double at, double length);
  /// @param stop infinite: no stop time
  fmi2Status setup(double start, double stop);
  fmi2Status set_logging(bool on, std::size_t n, const fmi2String* categories);
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] bool is_terminated() const noexcept { return phase_ == Phase::failed; }

  fmi2Status save(fmi2FMUstate* state);
  fmi2Status restore(fmi2FMUstate state);
  /// @return fmi2Error: the state is not of this instance, or is freed
  fmi2Status free(fmi2FMUstate* state) noexcept;
  fmi2Status serialized_size(fmi2FMUstate state, std::size_t* n);
  fmi2Status serialize(fmi2FMUstate state, char* bytes, std::size_t n);
  fmi2Status deserialize(const char* bytes, std::size_t n, fmi2FMUstate* state);

  /// Logs the message and returns fmi2Error.
  fmi2Status error(const std::string& message);
  fmi2Status warning(const std::string& message);

 private:
  struct State {
    SavedWheel wheel;
    double time = 0.0;
    Phase phase = Phase::instantiated;
    bool stale = true;
  };
  fmi2Status hand_over(std::unique_ptr<State> saved, fmi2FMUstate* state);
  const char* no_place_for_state(const fmi2FMUstate* state) const noexcept;
  void log(fmi2Status status, const char* category, const std::string& message);
  fmi2Status tell_warnings();
  fmi2Status fail(const std::string& message);
  void refresh();

  const std::string name_;
  const fmi2CallbackFunctions callbacks_;
  bool logs_;
  std::set<std::string> categories_;  ///< empty: all
  std::string guid_;
  std::span<const Variable> variables_;
  Values start_, values_;
  std::unique_ptr<Wheel> wheel_;
  Phase phase_ = Phase::instantiated;
  bool stale_ = true;  ///< the wheel must still be made from the values
  double time_ = 0.0;
  double stop_ = std::numeric_limits<double>::infinity();
};

/// The instance of a pointer; null: there is none, or it is freed.
[[nodiscard]] Component* living(fmi2Component c) noexcept;
/// Registers and owns it from then on. @throws std::bad_alloc
fmi2Component enroll(std::unique_ptr<Component> component);
/// Frees it; does nothing if it is already freed.
void dismiss(fmi2Component c) noexcept;

}  // namespace rondo::fmu
