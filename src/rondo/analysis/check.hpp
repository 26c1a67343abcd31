// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a case would cost and whether it can run, without running it.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "rondo/analysis/build.hpp"
#include "rondo/case/case.hpp"

namespace rondo::study {

struct CheckReport {
  std::size_t nodes = 0, elements = 0, dofs = 0, candidates = 0;
  int bodies = 1, free_bodies = 0;
  fem::WaveSpeeds wave_speeds;     ///< [m/s]
  double largest_frequency = 0.0;  ///< ω_max                                           [rad/s]
  double element_bound = 0.0;      ///< of ω_max, by elements                           [rad/s]
  double critical_step = 0.0;      ///< [s]
  double step = 0.0;               ///< [s]
  long long steps = 0;
  std::size_t snapshots = 0;
  int threads = 1;
  std::size_t memory_bytes = 0;  ///< estimated
  std::size_t disk_bytes = 0;    ///< estimated
  // Of a crush; what a dynamic run alone has is 0 there.
  int increments = 0;
  std::size_t condensed = 0;  ///< candidates condensed at first
  double seconds = 0.0;       ///< estimated from some steps made here (no files written)  [s]
  std::vector<std::string> warnings;
};

struct CheckOptions {
  int threads = 0;               ///< 0: chosen by size
  double trial_s = 0.2;          ///< of steps made to estimate `seconds`; 0: none, which is 0 then
  SharedBody* shared = nullptr;  ///< as for build()
};

/// @throws InputError as a run would.
CheckReport check_case(const Case& c, const CheckOptions& options);

}  // namespace rondo::study
