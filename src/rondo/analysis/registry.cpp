// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/registry.hpp"

#include <array>

#include "rondo/analysis/base/region_figures.hpp"
#include "rondo/analysis/crush/crush.hpp"
#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/figures/crush_figures.hpp"
#include "rondo/analysis/figures/dynamic_figures.hpp"
#include "rondo/analysis/figures/steady_figures.hpp"
#include "rondo/analysis/reduced/reduced.hpp"
#include "rondo/analysis/steady/steady.hpp"

namespace rondo::study {

std::span<const AnalysisType> analysis_types() noexcept {
  static const std::array types{
      AnalysisType{analysis_kinds[0].name, "step", make_dynamic, dynamic_figures()},
      AnalysisType{analysis_kinds[1].name, "increment", make_crush, crush_figures()},
      AnalysisType{analysis_kinds[2].name, "place", make_steady_rolling, steady_figures(),
                   solve_steady_rolling},
  };
  static_assert(types.size() == std::size(analysis_kinds), "a row a kind, in their order");
  return types;
}

const AnalysisType& type_of(const Case& c) noexcept {
  static const AnalysisType solid_steady{analysis_kinds[2].name, "place", make_steady_rolling,
                                         solid_steady_figures(), solve_steady_rolling};
  if (c.analysis.kind == AnalysisKind::steady_rolling && is_solid(c)) return solid_steady;
  static const AnalysisType latin{analysis_kinds[1].name, "increment", make_crush, latin_figures()};
  static const AnalysisType pgd{analysis_kinds[1].name, "increment", make_crush, pgd_figures()};
  if (finds_modes(c)) return pgd;
  if (c.analysis.kind == AnalysisKind::crush && c.analysis.solver == CrushMethod::latin)
    return latin;
  static const AnalysisType solid_dynamic{analysis_kinds[0].name, "step", make_dynamic,
                                          solid_dynamic_figures()};
  if (is_solid(c) && c.analysis.kind == AnalysisKind::dynamic) return solid_dynamic;
  return analysis_types()[static_cast<std::size_t>(c.analysis.kind)];
}

bool finds_modes(const Case& c) noexcept {
  return c.analysis.kind == AnalysisKind::crush && c.analysis.solver == CrushMethod::latin_pgd;
}

namespace {

void refuse_modes(const Case& c, const RunOptions& options) {
  const bool takes_modes = finds_modes(c) && options.reduced.empty();
  if (options.modes_from.empty() || takes_modes) return;
  throw case_error(
      c, "analysis.solver",
      "--modes-from gives initial modes, which only a crush by \"latin-pgd\" has",
      "analysis.kind = \"crush\" with analysis.solver = \"latin-pgd\"; or no --modes-from");
}

}  // namespace

std::unique_ptr<Analysis> make_analysis(const Case& c, const RunOptions& options) {
  refuse_modes(c, options);
  return options.reduced.empty() ? type_of(c).make(c, options) : make_reduced(c, options);
}

CheckReport check_case(const Case& c, const CheckOptions& options) {
  RunOptions run;
  run.threads = options.threads;
  run.shared = options.shared;
  const std::unique_ptr<Analysis> analysis = make_analysis(c, run);
  CheckReport report = analysis->check(options.trial_s);
  const RecordPlan plan = analysis->record_plan();
  const std::vector<Told> regions = region_lines(*plan.results.mesh, plan.materials);
  report.lines.insert(report.lines.begin(), regions.begin(), regions.end());
  if (options.columns) report.columns = plan.columns;
  return report;
}

}  // namespace rondo::study
