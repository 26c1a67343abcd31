// SPDX-License-Identifier: BSD-3-Clause
/// @file  Floating-point traps around the steps of a test: invalid operation, division by zero and
/// overflow end the program at the operation, not at the first wrong result. Builds with
/// RONDO_TRAPS have them in every step (integrators/general/step_traps.hpp).
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

/// During its lifetime the traps of a build with RONDO_TRAPS are off: used to test the handling of
/// NaN and infinity in a run.
class NoStepTraps {
 public:
  NoStepTraps() { setenv("RONDO_TRAPS", "off", 1); }
  ~NoStepTraps() { unsetenv("RONDO_TRAPS"); }
  NoStepTraps(const NoStepTraps&) = delete;
  NoStepTraps& operator=(const NoStepTraps&) = delete;
};

}  // namespace rondo::test
