// SPDX-License-Identifier: BSD-3-Clause
/// The numbers from which a wheel resumes.
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"

namespace rondo::rom {
namespace {

constexpr std::size_t own_numbers = 8;  ///< spin, first sector, forces at the end

std::size_t creep_numbers(const SolidRing& ring, const WheelModel& model) noexcept {
  if (model.creep.empty()) return 0;
  return HarmonicCreep::n_saved(model.creep.size(), model.residuals.size(), at(ring.n_contact()),
                                at(ring.n_sectors()));
}

}  // namespace

std::size_t SolidWheel::n_numbers(const SolidRing& ring, const WheelModel& model) noexcept {
  return own_numbers + n_mode_numbers(model) + creep_numbers(ring, model) +
         numbers_of_node * ring.contact.size() * at(ring.n_sectors());
}

/// Modes take any finite numbers; nodes have a count among theirs, which is checked.
bool SolidWheel::is_saved(const SolidRing& ring, const WheelModel& model,
                          std::span<const double> numbers) noexcept {
  if (numbers.size() != n_numbers(ring, model)) return false;
  const double first = numbers[1];
  if (!(first >= 0.0 && first < ring.n_sectors() && first == std::floor(first))) return false;
  const std::size_t nodes = numbers_of_node * ring.contact.size() * at(ring.n_sectors());
  for (std::span left = numbers.last(nodes); !left.empty(); left = left.subspan(numbers_of_node)) {
    const double known = left[numbers_of_node - 1];
    if (known != 0.0 && known != 1.0 && known != 2.0 && known != 3.0) return false;
  }
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

std::vector<double> SolidWheel::save() const {
  std::vector<double> out{spin_, static_cast<double>(first_)};
  out.reserve(n_numbers(ring_, model_));
  put(last_.force, out);
  put(last_.moment, out);
  save_modes(out);
  if (creep_) creep_->memory().save(out);
  for (const Memory& m : memory_) {
    for (const Vec3 x : {m.force, m.filtered, m.residual, m.place[0], m.place[1], m.place[2]})
      put(x, out);
    out.insert(out.end(), {m.gap[0], m.gap[1], m.slip, static_cast<double>(m.known)});
  }
  return out;
}

void SolidWheel::restore(std::span<const double> numbers) {
  RONDO_DEMAND(is_saved(ring_, model_, numbers), numbers.size());
  SavedNumbers from(numbers);
  restore_spin(from.next());
  n_made_ = 0;
  first_ = static_cast<int>(from.next());
  last_.force = from.vec3();
  last_.moment = from.vec3();
  restore_modes(from);
  if (creep_) {
    creep_->restore(from.take(creep_numbers(ring_, model_)));
    creep_->use(shares_);
  }
  seen_.clear();
  for (Memory& m : memory_) {
    m = {};
    for (Vec3* x : {&m.force, &m.filtered, &m.residual, &m.place[0], &m.place[1], &m.place[2]})
      *x = from.vec3();
    for (double* x : {&m.gap[0], &m.gap[1], &m.slip}) *x = from.next();
    m.known = static_cast<int>(from.next());
    m.filtered_before = m.filtered;
    m.residual_before = m.residual;
  }
  // In the order of the window, as remember() has them.
  for (int d = 0; d < ring_.n_sectors(); ++d)
    for (int c = 0; c < n_contact_; ++c) {
      const int node = wrapped(first_ + d) * n_contact_ + c;
      if (memory_of(node).known > 0) seen_.push_back(node);
    }
  move_contact();
}

}  // namespace rondo::rom
