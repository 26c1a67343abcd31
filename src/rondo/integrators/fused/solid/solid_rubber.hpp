// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rubber of a tyre whose motion is not linear in it, as the fused steps take it
/// (kernels/solid/elements.hpp, docs/tyre.md), and the window of columns in which it is not.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/kernels/solid/layout.hpp"
#include "rondo/integrators/fused/ring_layout.hpp"

namespace rondo::dynamics {

struct SolidRubberPlan {
  std::vector<kernels::SolidRubberElement> elements;
  fem::finite::ColumnWindow window;

  /// Place of a row's forces.
  [[nodiscard]] static std::ptrdiff_t place(int row, const RingLayout& layout) noexcept {
    return 6 * row * layout.stride;
  }
};

/// @param layout with stride and frames. @param table whose loops find the forces in the state.
/// @pre model.solid->swept->rubber, none of it by Ogden's law
SolidRubberPlan make_rubber_plan(const Model& model, const RingLayout& layout,
                                 const kernels::SolidTable& table);

/// Forces of the rubber on the nodes of a chunk, and what its columns have in the window.
class SolidWindow {
 public:
  SolidWindow(const SolidRubberPlan& plan, const RingLayout& layout, const CyclicChunkRange& range);

  /// @param now u_{n+1} of the chunk's first row, sector 0. @param angle of the wheel [rad]
  void find(const kernels::SolidTable& table, const double* now, double angle) noexcept;
  /// Adds twice the energy of the columns, and twice what the window's motion gave to them, to sums
  /// of lanes. @param sums (groups, n_sums, lanes)
  void add_sums(double* sums, int of_energy, int of_window) const noexcept;

  [[nodiscard]] const double* forces() const noexcept { return force_.data() + RingLayout::lead; }
  /// It tells for each pack of the chunk whether forces() are to be added there.
  [[nodiscard]] const char* is_shown() const noexcept { return shown_.data(); }

  /// Weights and energies of the chunk's own columns at the last place.
  /// @param numbers (2 n_sectors) of the wheel
  void save(std::span<double> numbers) const noexcept;
  void restore(std::span<const double> numbers) noexcept;

 private:
  void find_packs() noexcept;
  void close_ring() noexcept;
  [[nodiscard]] bool has_weight(int pack) const noexcept;

  const SolidRubberPlan& plan_;
  const RingLayout& layout_;
  CyclicChunkRange range_;
  int own_packs_;
  bool alone_;  ///< the whole ring: its own neighbour
  LargeArray force_;
  std::vector<double> of_wheel_;  ///< (n_sectors) weights
  // These belong to the columns, padded to packs, from pack -1 on:
  std::vector<double> weight_, mask_, energy_;
  std::vector<double> weight_before_, energy_before_;  ///< (own columns)
  std::vector<int> packs_, cleared_;                   ///< with room for all
  std::vector<char> shown_;                            ///< (own packs)
};

}  // namespace rondo::dynamics
