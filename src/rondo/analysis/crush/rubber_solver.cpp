// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/rubber_solver.hpp"

#include <optional>

#include "rondo/analysis/rubber_watch.hpp"
#include "rondo/statics/rubber_crush.hpp"

namespace rondo::study {
namespace {

class RubberSolver final : public CrushSolver {
 public:
  explicit RubberSolver(const CrushSetup& setup) : setup_(setup) {}

  void prepare() override {
    auto body = std::make_shared<const fem::Hyperelasticity>(setup_.mesh, setup_.materials);
    rubber_.emplace(setup_.model, std::move(body), setup_.free, setup_.reach);
  }

  [[nodiscard]] statics::CrushReport take(int k, statics::CrushState& state,
                                          std::string& trouble) override {
    const statics::CrushReport report =
        rubber_->bring_to(setup_.path.depth(k), setup_.path.slide(k), state);
    sweeps_.add(report);
    trouble = report.converged ? crush_trouble(report, state.works, setup_.model.bound)
                               : rubber_not_solved(report);
    return report;
  }

  void summarise(const statics::CrushState& state, Json& j, RunReport& r) const override {
    add_condensed(rubber_->condensed(), j);
    dynamics::MaterialReport material;
    material.internal_work = state.works.internal;
    material.stored_energy = state.works.strain;
    summarise_rubber(material, state.works.exchanged, j, r);
    sweeps_.summarise(j);
  }

 private:
  const CrushSetup& setup_;
  std::optional<statics::RubberCrush> rubber_;
  SweepCount sweeps_;
};

}  // namespace

std::unique_ptr<CrushSolver> make_rubber_solver(const CrushSetup& setup) {
  return std::make_unique<RubberSolver>(setup);
}

}  // namespace rondo::study
