// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps on any mesh: assembled 2×2 blocks in a good order, product, update and ledger in
/// one pass over memory (docs/performance.md).
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/batch_integrator.hpp"
#include "rondo/integrators/fused/rubber/following_loads.hpp"
#include "rondo/integrators/fused/rubber/rubber_forces.hpp"
#include "rondo/integrators/fused/sparse_plan.hpp"
#include "rondo/integrators/fused/tail/massless_tail.hpp"

namespace rondo::dynamics {

class SparseIntegrator : public BatchIntegrator {
 public:
  /// From u_n, v_{n+1/2} (start.v_next) and, with β, K u_n (start.force).
  /// @pre model.stiffness is there. @throws std::bad_alloc
  SparseIntegrator(const Model& model, const State& start, const kernels::Table& table);
  ~SparseIntegrator() override;

 private:
  class Rows;
  /// A candidate that touches, and what its row held before the update.
  struct Touching {
    SparseCandidate candidate;
    contact::Touches touches;
    Vec2 u, v, force;
    std::array<double, 2> kept;  ///< r_n of its contacts in the step before, where it is kept
  };
  /// Contacts of a thread's blocks.
  struct Contacts {
    std::vector<Touching> touching;     ///< candidates that touch in the block in hand
    std::vector<ActiveContact> active;  ///< contacts of the last step of the batch
  };
  /// The step in hand.
  struct Work {
    const StepContext* step;
    const double* now;   ///< u_{n+1}
    double* next;        ///< u_{n+2}
    PartialStep* parts;  ///< (blocks)
    Contacts* contacts;
    bool last;             ///< the step is the last of the batch
    RubberEnergy* rubber;  ///< to be filled, where there is rubber
  };

  SparseIntegrator(const Model& model, const State& start, const kernels::Table& table,
                   SparsePlan plan);
  NodesInStep rows_of(std::span<const int> nodes);
  void add_tails(const kernels::Table& table);
  void load(const State& start);
  void load_on_rim(const State& start);
  void make_steps(const Batch& batch, Share share) noexcept override;
  void go_on(const kernels::WheelWay& way, long long step, Share share) noexcept override;
  void save_displacement(Nodes of, Field& u) const noexcept override;
  void save_velocity(Field& v) const noexcept override;
  void save_fields(SavedState& saved) const noexcept override;
  void restore_fields(const SavedState& saved) noexcept override;
  void save_active(std::vector<ActiveContact>& active) const noexcept override;
  [[nodiscard]] CandidateMotion motion_of(std::size_t candidate) const noexcept override;
  void move(std::size_t candidate, Vec3 v, Vec3 u) noexcept override;
  /// The place of a row's v_x in motion_.
  [[nodiscard]] std::size_t motion_at(std::size_t row) const noexcept;
  /// Which u is u_{n+1}.
  [[nodiscard]] static std::size_t parity(long long n) noexcept {
    return static_cast<std::size_t>(n) % 2;
  }

  void make_block(const Work& work, std::size_t block) noexcept;
  void evaluate_rubber(const Work& work, Share share) noexcept;
  [[nodiscard]] Vec2 force_on(const double* now, int row) const noexcept;
  [[nodiscard]] kernels::SparseRows rows_from(const double* now, double* next,
                                              std::size_t block) noexcept;
  void update_rows(const Work& work, std::size_t block, PartialStep& part) noexcept;
  void find_touching(const Work& work, std::size_t block) const noexcept;
  void forget_impulses(std::size_t block) noexcept;
  void look_at(const Work& work, const SparseCandidate& c) const noexcept;
  void solve_node(const Work& work, const Touching& t, PartialStep& part) noexcept;
  [[nodiscard]] Vec2 load_on(const Work& work, int row) const noexcept;
  void rest_padding(double* next) noexcept;

  const kernels::Table& table_;
  SparsePlan plan_;
  std::array<LargeArray, 2> u_;              ///< (rows, 2) of even and of odd steps
  LargeArray motion_;                        ///< motion of the rows, see kernels::SparseRows
  std::optional<RubberForces> rubber_;       ///< absent: K is all
  std::optional<FollowingLoads> following_;  ///< absent: no loads, or they stay as they are
  std::vector<Contacts> contacts_;           ///< contacts of each thread
  /// (nb) r_n of the contacts of each candidate in the last step; empty if friction is constant
  std::vector<std::array<double, 2>> kept_;  ///<                                       [N·s/m]
  std::vector<std::unique_ptr<Rows>> rows_;  ///< rows as the tails see them
};

}  // namespace rondo::dynamics
