// SPDX-License-Identifier: BSD-3-Clause
/// The numbers from which a wheel resumes.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using contact::Status;

}  // namespace

std::size_t RingWheel::n_numbers(const Ring& ring, const WheelModel& model,
                                 const contact::Friction& friction) noexcept {
  const std::size_t nodes = ring.contact.size() * at(ring.n_sectors());
  const std::size_t creep =
      model.creep.empty() ? 0
                          : CreepField::n_saved(model.creep.size(), model.residuals.size(), nodes);
  const std::size_t sliding = friction.is_constant() ? 0 : SlidingMemory::numbers_of_node * nodes;
  return 1 + n_mode_numbers(model) + creep + sliding + numbers_of_node * nodes;
}

/// Modes take any finite numbers; nodes have counts and statuses among theirs, which are checked.
bool RingWheel::is_saved(const Ring& ring, const WheelModel& model,
                         const contact::Friction& friction,
                         std::span<const double> numbers) noexcept {
  if (numbers.size() != n_numbers(ring, model, friction)) return false;
  const auto one_of = [](double x, std::initializer_list<double> known) {
    return std::ranges::find(known, x) != known.end();
  };
  const std::size_t nodes = numbers_of_node * ring.contact.size() * at(ring.n_sectors());
  for (std::span left = numbers.last(nodes); !left.empty(); left = left.subspan(numbers_of_node)) {
    const std::span end = left.first(numbers_of_node).last(3);  // as save() has them
    if (!one_of(end[0], {0, 1, 2, 3}) || !one_of(end[1], {0, 1, 2}) || !one_of(end[2], {-1, 0, 1}))
      return false;
  }
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

std::vector<double> RingWheel::save() const {
  std::vector<double> out{spin_};
  out.reserve(n_numbers(ring_, model_, friction_));
  save_modes(out);
  if (creep_) creep_->memory().save(out);
  if (sliding_) sliding_->save(out);
  for (const Memory& m : memory_) {
    for (const Vec2 x : {m.force, m.filtered, m.place[0], m.place[1], m.place[2]})
      out.insert(out.end(), {x.x, x.y});
    out.insert(out.end(), {m.gap[0], m.gap[1], static_cast<double>(m.known),
                           static_cast<double>(m.status), m.side});
  }
  return out;
}

void RingWheel::restore(std::span<const double> numbers) {
  RONDO_DEMAND(is_saved(ring_, model_, friction_, numbers), numbers.size());
  SavedNumbers from(numbers);
  restore_spin(from.next());
  restore_modes(from);
  if (creep_)
    creep_->restore(from.take(
        CreepField::n_saved(model_.creep.size(), model_.residuals.size(), memory_.size())));
  if (sliding_) sliding_->restore(from.take(SlidingMemory::numbers_of_node * memory_.size()));
  move_contact();
  active_.clear();
  seen_.clear();
  for (std::size_t node = 0; node < memory_.size(); ++node) {
    Memory& m = memory_[node];
    m = {};
    m.force = from.vec2();
    m.filtered = m.filtered_before = from.vec2();
    for (Vec2& place : m.place) place = from.vec2();
    for (double& gap : m.gap) gap = from.next();
    m.known = static_cast<int>(from.next());
    m.status = static_cast<Status>(static_cast<int>(from.next()));
    m.side = from.next();
    if (m.filtered != Vec2{}) active_.push_back(static_cast<int>(node));
    if (m.known > 0) seen_.push_back(static_cast<int>(node));
  }
}

}  // namespace rondo::rom
