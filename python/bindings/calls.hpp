// SPDX-License-Identifier: BSD-3-Clause
/// @file  How calls from Python go: without the interpreter's lock while they work, heard by
/// Ctrl-C, with warnings as Python's.
#pragma once
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondo/output/run_options.hpp"
#include "rondo/study/options/options.hpp"

namespace rondo::python {

namespace py = pybind11;

/// "a.b=value" texts of a case's keys.
using Settings = std::vector<std::string>;

/// What the numerics refuse to call a result.
class NumericalFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Asks all calls to end and waits until none is at work, or for some seconds: before the
/// interpreter ends, since nothing may come back to it then. No call begins after it.
void end_calls();
[[nodiscard]] bool is_ending() noexcept;

/// Of a long call: what it hands to the library, and what comes back. Made and destroyed with the
/// interpreter's lock.
class Call {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds period{50};  ///< between two looks for signals

  /// Fills the requests that options belong to. From then on, errors and warnings call them by
  /// their names in Python. @throws InputError as take_options
  void take(const py::dict& given, const study::Options& options);
  [[nodiscard]] std::function<void(const std::string&)> warn();
  /// To be called now and then without the lock: a signal that Python makes an exception of asks
  /// for a clean end.
  [[nodiscard]] std::function<void(long long, long long)> progress();
  [[nodiscard]] const std::atomic<bool>& stop() const noexcept { return stop_; }
  void give(study::RunOptions& options);

  /// Does the work without the lock.
  void work(const std::function<void()>& work);
  /// Speaks the warnings, then raises what interrupted the work. To be called with the lock, once
  /// what was done is kept.
  void finish();

 private:
  void look();
  /// The text with "--from" as "from_time".
  [[nodiscard]] std::string in_python(const std::string& text) const;

  std::vector<std::pair<std::string_view, std::string_view>> names_{
      {"-o", "output"}};  ///< "--from", "from_time"
  std::vector<std::string> warnings_;
  std::atomic<bool> stop_{false};
  Clock::time_point looked_ = Clock::now();
  py::object type_, value_, trace_;  ///< what interrupted it, as Python has it
};

}  // namespace rondo::python
