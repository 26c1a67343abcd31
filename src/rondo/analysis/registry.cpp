// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/registry.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "rondo/analysis/base/region_figures.hpp"
#include "rondo/analysis/build/push/push_words.hpp"
#include "rondo/analysis/crush/crush.hpp"
#include "rondo/analysis/crush/wheel_crush.hpp"
#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/figures/crush_figures.hpp"
#include "rondo/analysis/figures/dynamic_figures.hpp"
#include "rondo/analysis/figures/inflation_figures.hpp"
#include "rondo/analysis/figures/steady_figures.hpp"
#include "rondo/analysis/inflation/inflation.hpp"
#include "rondo/analysis/reduced/wheel.hpp"
#include "rondo/analysis/steady/steady.hpp"
#include "rondo/analysis/steady/steady_case.hpp"

namespace rondo::study {

namespace {

bool by_latin(const Case& c) {
  return c.analysis.solver == CrushMethod::latin;
}
bool by_latin_pgd(const Case& c) {
  return c.analysis.solver == CrushMethod::latin_pgd;
}

/// Those of some cases of a kind stand before that of all others.
std::span<const AnalysisType> analysis_types() noexcept {
  using enum AnalysisKind;
  static const std::array types{
      AnalysisType{dynamic, is_solid, "step", make_dynamic, solid_dynamic_figures()},
      AnalysisType{dynamic, nullptr, "step", make_dynamic, dynamic_figures()},
      AnalysisType{crush, is_solid, "increment", make_wheel_crush, wheel_crush_figures()},
      AnalysisType{crush, by_latin, "increment", make_crush, latin_figures()},
      AnalysisType{crush, by_latin_pgd, "increment", make_crush, pgd_figures(), nullptr, true},
      AnalysisType{crush, nullptr, "increment", make_crush, crush_figures()},
      AnalysisType{steady_rolling, is_solid, "place", make_steady_rolling, solid_steady_figures(),
                   solve_steady_rolling, false, harmonics_key},
      AnalysisType{steady_rolling, nullptr, "place", make_steady_rolling, steady_figures(),
                   solve_steady_rolling, false, harmonics_key},
      AnalysisType{inflation, nullptr, "step", make_inflation, inflation_figures()},
  };
  return types;
}

}  // namespace

const AnalysisType& type_of(const Case& c) noexcept {
  return *std::ranges::find_if(analysis_types(), [&](const AnalysisType& type) {
    return type.kind == c.analysis.kind && (type.is_of == nullptr || type.is_of(c));
  });
}

namespace {

void refuse_modes(const Case& c, const RunOptions& options) {
  const bool takes_modes = type_of(c).finds_modes && options.reduced.empty();
  if (options.modes_from.empty() || takes_modes) return;
  throw case_error(
      c, "analysis.solver",
      "--modes-from gives initial modes, which only a crush by \"latin-pgd\" has",
      "analysis.kind = \"crush\" with analysis.solver = \"latin-pgd\"; or no --modes-from");
}

}  // namespace

std::unique_ptr<Analysis> make_analysis(const Case& c, const RunOptions& options) {
  refuse_modes(c, options);
  return options.reduced.empty() ? type_of(c).make(c, options) : make_wheel(c, options);
}

CheckReport check_case(const Case& c, const CheckOptions& options) {
  RunOptions run = options.run ? *options.run : RunOptions{};
  run.threads = options.threads;
  run.shared = options.shared;
  const std::unique_ptr<Analysis> analysis = make_analysis(c, run);
  CheckReport report = analysis->check(options.trial_s);
  const RecordPlan plan = analysis->record_plan();
  std::vector<Told> regions = region_lines(*plan.results.mesh, plan.materials);
  if (c.inflation) regions.front().first = "rubber, no cords";  // its mass is among the lines
  report.lines.insert(report.lines.begin(), regions.begin(), regions.end());
  for (Told& line : push_lines(c, *plan.results.mesh)) report.lines.push_back(std::move(line));
  if (options.columns) report.columns = plan.columns;
  return report;
}

}  // namespace rondo::study
