// SPDX-License-Identifier: BSD-3-Clause
/// @file  Floating-point traps in every step of a build with RONDO_TRAPS (all presets but release
/// and bench): an invalid operation, a division by zero and an overflow end the program where they
/// happen. Traps belong to a thread: each thread of a step sets its own.
#pragma once

#ifdef RONDO_TRAPS
#include <cfenv>
#include <cstdlib>
#include <string_view>
#endif

namespace rondo::dynamics {

/// Sets the traps as long as it lives. RONDO_TRAPS=off in the environment, looked up each time: no
/// traps, for tests of runs that are meant to blow up.
class StepTraps {
 public:
  StepTraps(const StepTraps&) = delete;
  StepTraps& operator=(const StepTraps&) = delete;
#ifdef RONDO_TRAPS
  StepTraps() noexcept : before_(fegetexcept()) {
    const char* wish = std::getenv("RONDO_TRAPS");
    if (wish && std::string_view(wish) == "off") return;
    std::feclearexcept(FE_ALL_EXCEPT);  // the x87 unit would trap on those of before
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  }
  ~StepTraps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(before_);
  }

 private:
  int before_;
#else
  StepTraps() noexcept {}
  ~StepTraps() {}
#endif
};

}  // namespace rondo::dynamics
