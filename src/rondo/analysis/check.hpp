// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a case would cost and whether it can run, without running it.
#pragma once
#include "rondo/analysis/analysis.hpp"

namespace rondo::study {

struct SharedBody;

struct CheckOptions {
  int threads = 0;               ///< 0: chosen by size
  double trial_s = 0.2;          ///< of steps made to estimate `seconds`; 0: none, which is 0 then
  SharedBody* shared = nullptr;  ///< as for build()
};

/// @throws InputError as a run would.
[[nodiscard]] CheckReport check_case(const Case& c, const CheckOptions& options);

}  // namespace rondo::study
