// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/latin_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/crush/direct_solver.hpp"
#include "rondo/analysis/crush/latin_outcome.hpp"
#include "rondo/analysis/crush/pgd_files.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/output/kept/kept_files.hpp"
#include "rondo/statics/latin/latin.hpp"
#include "rondo/statics/latin/pgd.hpp"
#include "rondo/statics/latin/springs.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::Index;
using Eigen::MatrixXd;
using statics::Condensation;

constexpr int most_iterations = 2000;
constexpr double last_cut = 0.5;       ///< share of the tolerance that modes left out may have
constexpr double most_foreign = 1e-6;  ///< share of a field's loads away from the contact nodes

struct LatinBegin {
  const Case& c;
  const RunOptions& options;
  double direction;  ///< [N/m²]
  int fields;
};
constexpr JsonMember<LatinBegin> latin_rows[] = {
    {"solver", "string", "", "\"latin\" or \"latin-pgd\"",
     [](const LatinBegin& b) -> Json {
       return b.c.analysis.solver == CrushMethod::latin_pgd ? "latin-pgd" : "latin";
     }},
    {"search_direction", "number", "N/m2", "Stiffness k of the search direction that was used",
     [](const LatinBegin& b) -> Json { return b.direction; }},
    {"modes_from", "string", "", "Only with `--modes-from`: the run whose modes it began with",
     [](const LatinBegin& b) {
       const std::string& told = b.options.modes_told;
       if (b.options.modes_from.empty()) return absent();
       return Json(told.empty() ? b.options.modes_from.string() : told);
     }},
    {"fields_begun_with", "integer", "",
     "Only with `--modes-from`: how many fields of that run were used",
     [](const LatinBegin& b) { return b.options.modes_from.empty() ? absent() : Json(b.fields); }},
};

constexpr JsonMember<statics::LatinReport> latin_end_rows[] = {
    {"iterations", "integer", "", "Number of LATIN iterations",
     [](const statics::LatinReport& e) -> Json { return e.iterations; }},
    {"indicator", "number", "", "Indicator at the end, of the solution before the last cut",
     [](const statics::LatinReport& e) -> Json { return e.indicator; }},
    {"residual", "number", "", "Residual at the end, of the solution before the last cut",
     [](const statics::LatinReport& e) -> Json { return e.residual; }},
};
constexpr JsonMember<std::size_t> solves_rows[] = {
    {"condensation_solves", "integer", "",
     "Solves with the stiffness of the body for the compliance: two for each contact node "
     "condensed",
     [](const std::size_t& solves) -> Json { return solves; }},
};

struct PgdEnd {
  const statics::Pgd& pgd;
  const LatinOutcome* outcome;  ///< null: not converged
  double residual;
};
constexpr JsonMember<PgdEnd> pgd_rows[] = {
    {"modes", "integer", "",
     "`\"latin-pgd\"` only: modes of the solution written, after the last cut",
     [](const PgdEnd& e) -> Json { return e.outcome ? e.outcome->modes() : e.pgd.modes(); }},
    {"modes_max", "integer", "",
     "`\"latin-pgd\"` only: largest number of modes during the iterations",
     [](const PgdEnd& e) -> Json { return e.pgd.most_modes(); }},
    {"solves", "integer", "", "`\"latin-pgd\"` only: solves for fields",
     [](const PgdEnd& e) -> Json { return e.pgd.solves(); }},
    {"residual_of_modes", "number", "",
     "`\"latin-pgd\"` only: residual of the solution written; null in a run that did not complete",
     [](const PgdEnd& e) { return e.outcome ? Json(e.residual) : Json(); }},
};

class LatinSolver final : public CrushSolver {
 public:
  LatinSolver(const Case& c, const RunOptions& options, const CrushSetup& setup)
      : case_(c), options_(options), setup_(setup) {}

  void prepare() override;
  [[nodiscard]] bool iterate(std::string& trouble) override;
  [[nodiscard]] statics::CrushReport take(int k, statics::CrushState& state,
                                          std::string& trouble) override;
  void describe(Json& j) const override;
  void summarise(const statics::CrushState& state, Json& j, RunReport& report) const override;

 private:
  [[nodiscard]] bool is_pgd() const { return case_.analysis.solver == CrushMethod::latin_pgd; }
  [[nodiscard]] MatrixXd read_fields();
  void condense_where_loaded(const MatrixXd& fields);
  void set_problem();
  void make_pgd(MatrixXd fields);
  void record_iteration();
  [[nodiscard]] std::string not_converged() const;
  void write_modes(const statics::Separated& all, double share);
  [[nodiscard]] statics::LatinPair pair_of(const statics::Separated& s, Index kept) const;
  void cut(LatinHistories& h);
  void finish();

  const Case& case_;
  const RunOptions& options_;
  const CrushSetup& setup_;
  fem::BlockCsr stiffness_;
  std::shared_ptr<Condensation> body_;
  std::unique_ptr<Condensation> stiffened_;  ///< for PGD alone
  std::vector<int> nodes_;                   ///< (m) of the set
  double direction_ = 0.0;                   ///< [N/m²]
  int fields_begun_with_ = 0;
  statics::LatinProblem problem_;
  std::unique_ptr<statics::Elasticity> elasticity_;
  statics::Pgd* pgd_ = nullptr;  ///< elasticity_ as a Pgd; null: LATIN
  std::optional<statics::Latin> latin_;
  statics::LatinReport report_;
  std::optional<io::Csv> convergence_;
  double solve_wall_s_ = 0.0;            ///< iterations and fields, without what prepares them
  std::optional<LatinOutcome> outcome_;  ///< once converged
  double residual_of_modes_ = 0.0;
};

/// Empty: none was asked for.
MatrixXd LatinSolver::read_fields() {
  return options_.modes_from.empty() ? MatrixXd()
                                     : read_pgd_basis(options_.modes_from, setup_.mesh);
}

/// The histories see every candidate that the fields have loads on.
void LatinSolver::condense_where_loaded(const MatrixXd& fields) {
  const std::vector<std::size_t> outside = body_->outside(),
                                 loaded =
                                     statics::loaded_places(stiffness_, setup_.model.nodes, fields);
  std::vector<std::size_t> added;
  std::ranges::set_intersection(outside, loaded, std::back_inserter(added));
  body_->append(added);
}

void LatinSolver::set_problem() {
  const auto& set = body_->set();
  const int n = setup_.path.n_increments();
  problem_ = {body_->compliance(), MatrixXd(static_cast<Index>(2 * set.size()), n),
              setup_.model.friction.constant()};
  for (int k = 0; k < n; ++k)
    for (std::size_t j = 0; j < set.size(); ++j)
      problem_.free.col(k).segment<2>(static_cast<Index>(2 * j))
          << setup_.model.clearance[set[j]] - setup_.path.depth(k + 1),
          -setup_.path.slide(k + 1);
  for (const std::size_t j : set) nodes_.push_back(setup_.model.nodes[j]);
}

void LatinSolver::make_pgd(MatrixXd fields) {
  stiffened_ = std::make_unique<Condensation>(statics::with_springs(stiffness_, nodes_, direction_),
                                              setup_.free, nodes_);
  if (!stiffened_->factorised())
    throw case_error(case_, "analysis.search_direction",
                     fmt::format("{:g} N/m2 leaves a stiffness that is not positive definite in "
                                 "numbers",
                                 direction_),
                     "0, which chooses one");
  const AnalysisCase& a = case_.analysis;
  auto pgd = std::make_unique<statics::Pgd>(
      *stiffened_, nodes_, statics::PgdOptions{direction_, a.tolerance, a.downsizing});
  pgd_ = pgd.get();
  elasticity_ = std::move(pgd);
  if (fields.cols() == 0) return;
  const statics::Adopted adopted =
      statics::adopt(stiffness_, nodes_, direction_, std::move(fields));
  if (!(adopted.foreign <= most_foreign))
    throw request_error("--modes-from", options_.modes_from.string(),
                        fmt::format("its fields have {:.2g} of their loads away from the contact "
                                    "nodes: they belong to another body",
                                    adopted.foreign),
                        "a run of the same mesh, [material] and held nodes");
  fields_begun_with_ = static_cast<int>(adopted.fields.field.cols());
  pgd_->begin_with(adopted.fields);
}

void LatinSolver::prepare() {
  stiffness_ = fem::assemble_stiffness(setup_.mesh, setup_.materials);
  MatrixXd fields = read_fields();
  body_ = factorised(case_, setup_, options_.shared);
  condense(case_, setup_, *body_);
  if (fields.cols() > 0) condense_where_loaded(fields);
  set_problem();
  const double given = case_.analysis.search_direction;
  direction_ =
      given > 0.0 ? given : statics::chosen_direction(problem_.compliance, setup_.path.has_slide());
  if (is_pgd())
    make_pgd(std::move(fields));
  else
    elasticity_ = std::make_unique<statics::CondensedElasticity>(problem_.compliance, direction_);
  latin_.emplace(problem_, *elasticity_, direction_, case_.analysis.relaxation);
}

void LatinSolver::record_iteration() {
  if (options_.directory.empty()) return;  // into memory
  if (!convergence_)
    convergence_.emplace(
        options_.directory / "convergence.csv",
        std::vector<std::string>{"iteration", "indicator", "residual", "modes", "solves"});
  convergence_->row(std::array<double, 5>{static_cast<double>(report_.iterations),
                                          report_.indicator, report_.residual,
                                          pgd_ ? static_cast<double>(pgd_->modes()) : 0.0,
                                          pgd_ ? static_cast<double>(pgd_->solves()) : 0.0});
}

std::string LatinSolver::not_converged() const {
  const AnalysisCase& a = case_.analysis;
  std::string otherwise;
  if (a.search_direction > 0.0)
    otherwise += "leave analysis.search_direction out, which chooses one; ";
  if (pgd_ && a.downsizing > 0.0) otherwise += "analysis.downsizing = 0, which drops no mode; ";
  if (a.relaxation > 0.5) otherwise += "a smaller analysis.relaxation; ";
  return fmt::format(
      "LATIN did not converge: after {} iterations the residual is {:.3g} and the indicator "
      "{:.3g}, analysis.tolerance {:g}, with a search direction of {:.4g} N/m2; {}analysis.solver "
      "= "
      "\"direct\" needs no iterations",
      report_.iterations, report_.residual, report_.indicator, a.tolerance, direction_, otherwise);
}

bool LatinSolver::iterate(std::string& trouble) {
  const auto begin = Clock::now();
  report_ = latin_->iterate();
  const double tolerance = case_.analysis.tolerance;
  const bool converged =
      report_.iterations > 1 && report_.indicator <= tolerance && report_.residual <= tolerance;
  const bool empty = converged && pgd_ && pgd_->modes() == 0;  // all of it is below the numbers
  if (converged && !empty) finish();
  solve_wall_s_ += std::chrono::duration<double>(Clock::now() - begin).count();
  record_iteration();
  if (!std::isfinite(report_.residual) || !std::isfinite(report_.indicator))
    trouble = "the forces or displacements are out of the range of floating-point numbers";
  else if (empty)
    trouble =
        "the forces are below the range of floating-point numbers, and no mode remains; a larger "
        "analysis.depth, and material.youngs_modulus in Pa";
  else if (!converged && report_.iterations == most_iterations)
    trouble = not_converged();
  return !converged;
}

/// @param share of the norm that the modes kept leave out
void LatinSolver::write_modes(const statics::Separated& all, double share) {
  const MatrixXd basis = pgd_->basis().field;
  PgdModes modes;
  modes.mesh = &setup_.mesh;
  modes.mass = setup_.mass;
  modes.title = case_.title;
  for (int k = 1; k <= setup_.path.n_increments(); ++k)
    modes.parameter.push_back(setup_.path.parameter(k));
  modes.solution = &all;
  modes.basis = &basis;
  modes.share = share;
  modes.direction = direction_;
  modes.latin = report_;
  modes.solves = pgd_->solves();
  modes.most_modes = pgd_->most_modes();
  if (!options_.directory.empty()) write_pgd(options_.directory, modes);
}

/// Balanced by the first modes alone.
statics::LatinPair LatinSolver::pair_of(const statics::Separated& s, Index kept) const {
  const MatrixXd time = s.sigma.head(kept).asDiagonal() * s.temporal.leftCols(kept).transpose();
  const MatrixXd displacement = s.modes.contact.leftCols(kept) * time;
  return {s.modes.load.leftCols(kept) * time - direction_ * displacement,
          problem_.free + displacement};
}

/// The last cut: the fewest modes that leave half the tolerance of the norm at most, and with which
/// the laws hold to the tolerance.
void LatinSolver::cut(LatinHistories& h) {
  const double tolerance = case_.analysis.tolerance;
  statics::Separated all = pgd_->separated(0.0);
  Index kept = statics::values_kept(all.sigma, last_cut * tolerance);
  h.balanced = pair_of(all, kept);
  while (kept < all.sigma.size() && !(statics::history_residual(problem_, h.balanced) <= tolerance))
    h.balanced = pair_of(all, ++kept);
  write_modes(all, all.sigma.tail(all.sigma.size() - kept).norm() / all.sigma.norm());
  h.separated = statics::Separated{
      {all.modes.field.leftCols(kept), {}, {}}, all.sigma.head(kept), all.temporal.leftCols(kept)};
}

void LatinSolver::finish() {
  LatinHistories h;
  h.lawful = latin_->lawful().force;
  if (pgd_)
    cut(h);
  else
    h.balanced = latin_->balanced();
  h.residuals = statics::increment_residuals(problem_, h.balanced);
  residual_of_modes_ = statics::history_residual(problem_, h.balanced);
  outcome_.emplace(setup_, stiffness_, *body_, std::move(h));
}

statics::CrushReport LatinSolver::take(int k, statics::CrushState& state, std::string& trouble) {
  const auto begin = Clock::now();
  const statics::CrushReport report = outcome_->take(k, case_.analysis.tolerance, state, trouble);
  solve_wall_s_ += std::chrono::duration<double>(Clock::now() - begin).count();
  return report;
}

void LatinSolver::describe(Json& j) const {
  add_members(latin_rows, {case_, options_, direction_, fields_begun_with_}, j);
}

void LatinSolver::summarise(const statics::CrushState& /*state*/, Json& j, RunReport& /*r*/) const {
  if (convergence_) j["files"]["convergence.csv"] = as_json(convergence_->place());
  add_condensed(body_->set().size(), j);
  add_members(latin_end_rows, report_, j);
  add_solve_wall(solve_wall_s_, j);
  add_members(solves_rows, 2 * body_->set().size(), j);
  if (pgd_) add_members(pgd_rows, {*pgd_, outcome_ ? &*outcome_ : nullptr, residual_of_modes_}, j);
}

}  // namespace

std::vector<MemberText> latin_members() {
  return joined(
      {texts_of(latin_rows), texts_of(latin_end_rows), texts_of(solves_rows), texts_of(pgd_rows)});
}

std::unique_ptr<CrushSolver> make_latin_solver(const Case& c, const RunOptions& options,
                                               const CrushSetup& setup) {
  return std::make_unique<LatinSolver>(c, options, setup);
}

}  // namespace rondo::study
