// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/crush_solver.hpp"

#include <algorithm>

#include "rondo/analysis/crush/direct_solver.hpp"
#include "rondo/analysis/crush/latin_solver.hpp"
#include "rondo/analysis/crush/rubber_solver.hpp"

namespace rondo::study {
namespace {

constexpr JsonMember<std::size_t> condensed_rows[] = {
    {"candidates_condensed", "integer", "",
     "Contact nodes that the stiffness was condensed on at the end",
     [](const std::size_t& n) -> Json { return n; }},
};

struct Swept {
  int sweeps, pivoted;
};
constexpr JsonMember<Swept> sweep_rows[] = {
    {"sweeps_max", "integer", "", "Most sweeps in an increment",
     [](const Swept& s) -> Json { return s.sweeps; }},
    {"pivoted_increments", "integer", "", "Increments solved by Lemke's pivoting instead of sweeps",
     [](const Swept& s) -> Json { return s.pivoted; }},
};

}  // namespace

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
  add_members(sweep_rows, {sweeps_, pivoted_}, j);
}

void add_condensed(std::size_t candidates, Json& json) {
  add_members(condensed_rows, candidates, json);
}

std::vector<MemberText> crush_solver_members() {
  return joined({texts_of(condensed_rows), texts_of(sweep_rows)});
}

}  // namespace rondo::study
