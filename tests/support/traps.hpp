// SPDX-License-Identifier: BSD-3-Clause
/// @file  Floating-point traps round the steps of a test: invalid, division by zero, overflow end
/// the program at the operation, not at the first figure that looks wrong. Builds with RONDO_TRAPS
/// have them in every step (dynamics/step_traps.hpp).
#pragma once
#include <cfenv>
#include <cstdlib>

namespace rondo::test {

class FloatingPointTraps {
 public:
  FloatingPointTraps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(trapped);
  }
  ~FloatingPointTraps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(trapped);
  }
  FloatingPointTraps(const FloatingPointTraps&) = delete;
  FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

 private:
  static constexpr int trapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
};

/// As long as it lives, the traps of a build with RONDO_TRAPS are off: a test of what a run does
/// with numbers that are none.
class NoStepTraps {
 public:
  NoStepTraps() { setenv("RONDO_TRAPS", "off", 1); }
  ~NoStepTraps() { unsetenv("RONDO_TRAPS"); }
  NoStepTraps(const NoStepTraps&) = delete;
  NoStepTraps& operator=(const NoStepTraps&) = delete;
};

}  // namespace rondo::test
