// SPDX-License-Identifier: BSD-3-Clause
/// @file  A Fourier transform that is made once.
#pragma once
#include <fftw3.h>

#include <mutex>

#include "rondo/core/process_wide.hpp"

namespace rondo::statics {

/// Makes the plan, executes and destroys it. @param make e.g. [&] { return fftw_plan_...(...); }
template <class Make>
void transform_once(Make&& make) {
  std::unique_lock planner(fftw_planner());
  const fftw_plan plan = make();
  planner.unlock();
  fftw_execute(plan);
  planner.lock();
  fftw_destroy_plan(plan);
}

}  // namespace rondo::statics
