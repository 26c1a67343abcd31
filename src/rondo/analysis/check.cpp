// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/check.hpp"

#include "rondo/analysis/registry.hpp"

namespace rondo::study {

CheckReport check_case(const Case& c, const CheckOptions& options) {
  RunOptions run;
  run.threads = options.threads;
  run.shared = options.shared;
  return make_analysis(c, run)->check(options.trial_s);
}

}  // namespace rondo::study
