// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/direct_solver.hpp"

#include "rondo/analysis/build/build.hpp"

namespace rondo::study {
namespace {

struct KeptCrush {
  std::string key;
  std::shared_ptr<statics::Condensation> body;
};

class DirectSolver final : public CrushSolver {
 public:
  DirectSolver(const Case& c, const RunOptions& options, const CrushSetup& setup)
      : case_(c), options_(options), setup_(setup) {}

  void prepare() override {
    body_ = factorised(case_, setup_, options_.shared);
    condense(case_, setup_, *body_);
  }

  [[nodiscard]] statics::CrushReport take(int k, statics::CrushState& state,
                                          std::string& trouble) override {
    const statics::CrushReport report =
        statics::bring_to(setup_.model, setup_.path.depth(k), setup_.path.slide(k), *body_, state);
    sweeps_.add(report);
    trouble = crush_trouble(report, state.works, setup_.model.bound);
    return report;
  }

  void summarise(const statics::CrushState& /*state*/, Json& j, RunReport& /*r*/) const override {
    add_condensed(body_->set().size(), j);
    sweeps_.summarise(j);
  }

 private:
  const Case& case_;
  const RunOptions& options_;
  const CrushSetup& setup_;
  std::shared_ptr<statics::Condensation> body_;
  SweepCount sweeps_;
};

}  // namespace

std::unique_ptr<CrushSolver> make_direct_solver(const Case& c, const RunOptions& options,
                                                const CrushSetup& setup) {
  return std::make_unique<DirectSolver>(c, options, setup);
}

std::shared_ptr<statics::Condensation> factorised(const Case& c, const CrushSetup& setup,
                                                  SharedBody* shared) {
  const std::string key = shared ? body_key(c) : std::string();
  const auto* kept = shared ? std::any_cast<KeptCrush>(&shared->other) : nullptr;
  if (kept && kept->key == key) {
    kept->body->clear();
    return kept->body;
  }
  auto body = std::make_shared<statics::Condensation>(
      fem::assemble_stiffness(setup.mesh, setup.materials), setup.free, setup.model.nodes);
  if (shared) shared->other = KeptCrush{key, body};
  return body;
}

}  // namespace rondo::study
