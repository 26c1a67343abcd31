// SPDX-License-Identifier: BSD-3-Clause
/// @file  Floating-point traps round the steps of a test: invalid, division by zero, overflow end
/// the program at the operation, not at the first figure that looks wrong.
#pragma once
#include <cfenv>

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

}  // namespace rondo::test
