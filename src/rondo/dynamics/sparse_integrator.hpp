// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps on any mesh: assembled 2×2 blocks in a good order, product, update and ledger in
/// one pass over memory (docs/performance.md).
#pragma once
#include <array>
#include <vector>

#include "rondo/core/barrier.hpp"
#include "rondo/core/large_array.hpp"
#include "rondo/dynamics/integrator.hpp"
#include "rondo/dynamics/sparse_plan.hpp"
#include "rondo/dynamics/step_context.hpp"

namespace rondo::dynamics {

class SparseIntegrator : public Integrator {
 public:
  /// From u_n, v_{n+1/2} (start.v_next) and, with β, K u_n (start.force).
  /// @pre model.stiffness is there. @throws std::bad_alloc
  SparseIntegrator(const Model& model, const State& start, const kernels::Table& table);

  void advance(std::span<StepReport> reports, State* last) noexcept override;
  void fields(State& state) const noexcept override;

 private:
  /// A candidate that touches, and what its row held before the update.
  struct Touching {
    SparseCandidate candidate;
    contact::Touches touches;
    Vec2 u, v, force;
  };
  /// The step in hand.
  struct Work {
    const StepContext* step;
    const double* now;   ///< u_{n+1}
    double* next;        ///< u_{n+2}
    PartialStep* parts;  ///< (blocks)
    bool last;           ///< of the batch
  };

  void load(const State& start);
  void save_displacement(std::vector<Vec2>& u) const noexcept;
  void save_velocity(std::vector<Vec2>& v) const noexcept;
  void save_active(std::vector<ActiveContact>& active) const noexcept;
  /// Where in motion_ a row's v_x is.
  [[nodiscard]] std::size_t motion_at(std::size_t row) const noexcept;

  void advance_batch(std::span<StepReport> reports) noexcept;
  void make_steps(std::size_t n_steps) noexcept;
  void steps_of(std::size_t n_steps, std::size_t thread, std::size_t n_threads) noexcept;
  void make_block(const Work& work, std::size_t block, std::vector<Touching>& touching) noexcept;
  void update_rows(const Work& work, std::size_t block, PartialStep& part) noexcept;
  void find_touching(const Work& work, std::size_t block,
                     std::vector<Touching>& touching) const noexcept;
  void look_at(const Work& work, const SparseCandidate& c,
               std::vector<Touching>& touching) const noexcept;
  void solve_node(const Work& work, const Touching& t, PartialStep& part) noexcept;
  void rest_padding(double* next) noexcept;

  const Model& model_;
  const kernels::Table& table_;
  SparsePlan plan_;
  std::array<LargeArray, 2> u_;                  ///< (rows, 2) before and after a step, in turns
  LargeArray motion_;                            ///< as in kernels::SparseRows
  std::vector<StepContext> steps_;               ///< of a batch
  std::vector<PartialStep> parts_;               ///< (steps of a batch, blocks)
  std::vector<std::vector<Touching>> touching_;  ///< of each thread
  std::vector<ActiveContact> active_;            ///< (nb, 2) of the last step of a batch
  std::vector<int> n_active_;                    ///< (nb) how many of them
  Barrier barrier_;
  Ledger ledger_;
  long long step_ = 0;   ///< number of the last step made
  std::size_t now_ = 0;  ///< which u is that of the step to come
};

}  // namespace rondo::dynamics
