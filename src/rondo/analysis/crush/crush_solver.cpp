// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/crush_solver.hpp"

#include <algorithm>

#include "rondo/analysis/crush/direct_solver.hpp"
#include "rondo/analysis/crush/latin_solver.hpp"
#include "rondo/analysis/crush/rubber_solver.hpp"

namespace rondo::study {

std::unique_ptr<CrushSolver> make_crush_solver(const Case& c, const RunOptions& options,
                                               const CrushSetup& setup) {
  if (c.analysis.solver != CrushMethod::direct) return make_latin_solver(c, options, setup);
  if (fem::has_rubber(setup.materials)) return make_rubber_solver(setup);
  return make_direct_solver(c, options, setup);
}

void SweepCount::add(const statics::CrushReport& report) noexcept {
  sweeps_ = std::max(sweeps_, report.sweeps);
  pivoted_ += report.pivoting != statics::Pivoting::none ? 1 : 0;
}

void SweepCount::summarise(Json& j) const {
  j["sweeps_max"] = sweeps_;
  j["pivoted_increments"] = pivoted_;
}

}  // namespace rondo::study
