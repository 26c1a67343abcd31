// SPDX-License-Identifier: BSD-3-Clause
/// @file  The work against the forces of a viscous wheel, and its loss, summed up over its steps.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/model/material_report.hpp"
#include "rondo/rom/wheel/base/wheel_model.hpp"
#include "rondo/rom/wheel/base/wheel_outcome.hpp"

namespace rondo::rom {

class MaterialSums {
 public:
  static constexpr std::size_t n_numbers = 4;

  void start(const WheelEnergy& energy) { internal_work_.add(energy.stored); }
  void add(const WheelEnergy& energy) {
    internal_work_.add(energy.internal);
    loss_.add(energy.viscous);
  }
  [[nodiscard]] double internal_work() const noexcept { return internal_work_.value(); }
  void report(const WheelEnergy& energy, dynamics::MaterialReport& to) const noexcept {
    to.internal_work = internal_work_.value();
    to.stored_energy = energy.stored;
    to.dissipation_viscous = loss_.value();
  }
  void save(std::vector<double>& out) const {
    for (const CompensatedSum& sum : {internal_work_, loss_})
      out.insert(out.end(), {sum.sum(), sum.correction()});
  }
  /// @param numbers n_numbers of save()
  void restore(std::span<const double> numbers) {
    internal_work_ = {numbers[0], numbers[1]};
    loss_ = {numbers[2], numbers[3]};
  }

 private:
  CompensatedSum internal_work_, loss_;
};

/// How many numbers a wheel keeps of them: elastic wheels have none.
[[nodiscard]] inline std::size_t sums_of(const WheelModel& wheel) noexcept {
  return wheel.creep.empty() ? 0 : MaterialSums::n_numbers;
}

}  // namespace rondo::rom
