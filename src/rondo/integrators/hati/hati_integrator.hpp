// SPDX-License-Identifier: BSD-3-Clause
/// @file  The heterogeneous asynchronous scheme (docs/theory.md, section 12), for experiments: a
/// part A of the body explicit in m fine steps, with the contact, the rest B by the trapezoidal
/// rule in one coarse step. A multiplier, constant over the coarse step, makes both move the nodes
/// where they meet by as much, and does no work. A step of this integrator is a coarse step.
/// Aim as Mahjoubi, Gravouil, Combescure, Comput. Mech. 44 (2009) 825; the energy is kept where
/// Gravouil, Combescure, Int. J. Numer. Meth. Engng 50 (2001) 199 dissipate it.
#pragma once
#include <Eigen/LU>
#include <memory>
#include <vector>

#include "rondo/integrators/hati/coarse_part.hpp"
#include "rondo/integrators/hati/fine_part.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

class HatiIntegrator final : public Integrator, public Resumable {
 public:
  /// @param start at t = 0, with v_0 (n) @pre as FinePart
  HatiIntegrator(const Model& model, const State& start);

  /// Reports: `contact` has the sums of the fine steps' impulses and works, counts of the last of
  /// them; `balance` is of t_{n+1}. State: v is that of t_{n+1}, of the interface the mean by mass.
  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept override;
  void fields(State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] SavedState save() const override;
  void restore(const SavedState& saved) override;
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return fine_.take_difficult();
  }

  /// (m) of the fine steps of the last step.
  [[nodiscard]] std::span<const FineContact> fine_contacts() const noexcept {
    return fine_.contacts();
  }

 private:
  using Vectors = std::vector<Vec2>;

  void factor_interface();
  StepReport step() noexcept;
  void correct_multiplier() noexcept;
  [[nodiscard]] Works works() const noexcept;
  [[nodiscard]] StepEnergy energy() noexcept;
  void fill_displacement(Field& u) const noexcept;
  void fill_velocity(Field& v) const noexcept;

  const Model& model_;
  const Subdomains& parts_;
  FinePart fine_;
  CoarsePart coarse_;
  Vectors multiplier_;  ///< (interface) λ                                            [N/m]
  Eigen::PartialPivLU<Eigen::MatrixXd> interface_;  ///< H
  Eigen::VectorXd apart_, change_;                  ///< (2 interface)
  Ledger ledger_;
  long long step_ = 0;
};

}  // namespace rondo::dynamics
