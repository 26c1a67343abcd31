// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/ring_chunk.hpp"

namespace rondo::dynamics {

template <int C>
RingChunk<C>::RingChunk(const Model& model, const RingLayout& layout, const CyclicChunkRange& range,
                        std::span<const Complex> turn, std::size_t strip_rows)
    : model_(model),
      range_(range),
      layout_(layout),
      fields_(layout.chunk_size()),
      sums_(static_cast<std::size_t>(layout.cut.depth) * lanes_of_group() * range.n_groups),
      contact_(model.contact ? static_cast<std::size_t>(layout.cut.depth) * range.n_groups : 0) {
  const int n = layout.n_sectors;
  const auto columns = static_cast<int>(layout.stride) - 2 * halo_columns;
  RONDO_DEMAND(range.first >= 0 && range.columns > 0 && range.first + range.columns <= n &&
                   range.columns <= columns && range.n_groups > 0,
               range.first, range.columns, n, columns, range.n_groups);
  RONDO_DEMAND(layout.nodes.size() == static_cast<std::size_t>(layout.n_local), layout.nodes.size(),
               layout.n_local);
  RONDO_DEMAND(turn.size() == static_cast<std::size_t>(n) && layout.components == C &&
                   (C == 2 || layout.frame.size() == static_cast<std::size_t>(layout.n_local)),
               turn.size(), n, layout.components, layout.frame.size(), layout.n_local);
  for (int c = -halo_columns; c < columns + halo_columns; ++c) {
    const Complex axes = turn[static_cast<std::size_t>(((range.first + c) % n + n) % n)];
    turn_x_.push_back(axes.re);
    turn_y_.push_back(axes.im);
  }
  if (layout.cut.halo != Halo::ring)
    edges_ = RingEdges(layout.cut.halo,
                       2U + (layout.keeps_force ? 1U : 0U) + (layout.keeps_impulse ? 1U : 0U),
                       layout.n_local, C);
  if (!model.contact) return;
  const auto most = static_cast<std::size_t>(range.columns) + 2 * halo_columns;
  low_.resize(most + kernels::lanes);
  touching_.reserve(most * strip_rows);
  active_.reserve(2 * most * layout.candidate.size());
}

template <int C>
void RingChunk<C>::set_fields(int now, int next, kernels::StripFields& strip) noexcept {
  strip.now = field(0, now);
  strip.next = field(0, next);
  strip.velocity = field(0, field_v);
  strip.force = field(0, layout_.keeps_force ? field_force : field_v);  // else unused
  strip.stride = layout_.stride;
  strip.turn_x = turn_x();
  strip.turn_y = turn_y();
  strip.columns = range_.columns;
}

template <int C>
void RingChunk<C>::set_work(const StepInPass& work, kernels::StripFields& strip) noexcept {
  strip.first_pack = work.extent.first_pack;
  strip.last_pack = work.extent.last_pack;
  strip.keep_tail = layout_.cut.halo != Halo::wide;
  strip.wheel = &work.step->wheel;
  strip.sums = sums_of(work.place);
}

template <int C>
void RingChunk<C>::show_to_others() noexcept {
  if (layout_.cut.halo != Halo::ring) return give_edges();
  for (int a = 0; a < layout_.n_local; ++a) wrap(fields(), a, field_now());
}

template <int C>
void RingChunk<C>::save(SavedState& saved) const noexcept {
  const std::span<Vec> u = saved.u, v = saved.v, force = saved.force, before = saved.u_before;
  for_own_nodes([&](int a, int c, std::size_t node) {
    u[node] = at(a, field_now(), c);
    v[node] = at(a, field_v, c);
    if (layout_.keeps_force) force[node] = at(a, field_force, c);
    if (layout_.wheel) before[node] = at(a, field_next(), c);
  });
}

template <int C>
void RingChunk<C>::restore(const SavedState& saved) noexcept {
  const std::span<const Vec> u = saved.u, v = saved.v, force = saved.force, before = saved.u_before;
  for_own_nodes([&](int a, int c, std::size_t node) {
    put(a, field_now(), c, u[node]);
    put(a, field_v, c, v[node]);
    if (layout_.keeps_force) put(a, field_force, c, force[node]);
    if (layout_.wheel) put(a, field_next(), c, before[node]);
  });
  restore_impulses(saved.impulses);
  show_to_others();
}

template <int C>
void RingChunk<C>::save_impulses(contact::KeptImpulses& impulses) const {
  for (std::size_t k = 0; k < layout_.place.size(); ++k) {
    const auto [row, sector] = layout_.place[k];
    if (!is_own(sector - range_.first)) continue;
    const Vec kept = kept_impulse(row, sector - range_.first);
    if (kept.x != 0.0) impulses.emplace_back(2 * k, Vec2{kept.x, 0.0});
    if (kept.y != 0.0) impulses.emplace_back(2 * k + 1, Vec2{kept.y, 0.0});
  }
}

template <int C>
void RingChunk<C>::restore_impulses(const contact::KeptImpulses& impulses) noexcept {
  if (!layout_.keeps_impulse) return;
  const int field = layout_.field_impulse();
  for (int row = 0; row < layout_.n_local; ++row)
    for (int c = 0; c < range_.columns; ++c) put(row, field, c, {});
  for (const auto& [key, impulse] : impulses) {
    const auto [row, sector] = layout_.place[key / 2];
    const int column = sector - range_.first;
    if (!is_own(column)) continue;
    Vec kept = kept_impulse(row, column);
    (key % 2 == 0 ? kept.x : kept.y) = impulse.x;
    put(row, field, column, kept);
  }
}

template <int C>
void RingChunk<C>::forget_impulses(int row, const Extent& extent) noexcept {
  if (!layout_.keeps_impulse) return;
  for (int c = extent.first_column; c < extent.last_column; ++c)
    put(row, layout_.field_impulse(), c, {});
}

template <int C>
void RingChunk<C>::keep_impulse(const Touching& t,
                                std::span<const ActiveContact> contacts) noexcept {
  if (!layout_.keeps_impulse) return;
  RONDO_ASSERT(!contacts.empty() && contacts.size() <= 2, contacts.size());
  Vec kept{};
  kept.x = contacts[0].impulse.x;
  if (contacts.size() == 2) kept.y = contacts[1].impulse.x;
  put(t.row, layout_.field_impulse(), t.column, kept);
}

template <int C>
void RingChunk<C>::save_displacement(bool candidates, std::span<Vec> u) const noexcept {
  const int now = field_now();
  for_own_nodes([&](int a, int c, std::size_t node) { u[node] = frame(a, c) * at(a, now, c); },
                candidates);
}

template <int C>
void RingChunk<C>::save_velocity(std::span<Vec> v) const noexcept {
  if (!layout_.wheel)
    return for_own_nodes(
        [&](int a, int c, std::size_t node) { v[node] = frame(a, c) * at(a, field_v, c); });
  const int now = field_now(), before = field_next();
  for_own_nodes([&](int a, int c, std::size_t node) {
    v[node] = frame(a, c) * (at(a, now, c) - at(a, before, c)) / model_.dt;
  });
}

template <int C>
void RingChunk<C>::begin_pass() noexcept {
  std::fill_n(sums_.data(), sums_.size(), 0.0);
  std::fill(contact_.begin(), contact_.end(), PartialStep{});
  active_.clear();
}

/// With a wide halo, step i of k leaves k - 1 - i columns of it right on each side.
template <int C>
typename RingChunk<C>::Extent RingChunk<C>::extent(std::size_t step,
                                                   std::size_t n_steps) const noexcept {
  const int own = (range_.columns + kernels::lanes - 1) / kernels::lanes;
  const int beyond = static_cast<int>(n_steps - 1 - step);
  if (layout_.cut.halo != Halo::wide || beyond == 0) return {0, own, 0, range_.columns};
  const int last = (range_.columns + beyond + kernels::lanes - 1) / kernels::lanes;
  return {-1, last, -beyond, range_.columns + beyond};
}

template <int C>
typename RingChunk<C>::StepInPass RingChunk<C>::step_in_pass(std::span<const StepContext> steps,
                                                             std::size_t i) const noexcept {
  RONDO_ASSERT(i < steps.size() && steps.size() <= static_cast<std::size_t>(layout_.cut.depth), i,
               steps.size(), layout_.cut.depth);
  const bool even = (steps_ + static_cast<long long>(i)) % 2 == 0;
  return {&steps[i],
          extent(i, steps.size()),
          i,
          even ? field_u_even : field_u_odd,
          even ? field_u_odd : field_u_even,
          i + 1 == steps.size()};
}

/// In the plane lane by lane, unless on a loaded rim, which has many sums; else so that few
/// additions wait for others.
template <int C>
double RingChunk<C>::sum_of(const double* lanes) const noexcept {
  if (C == 3 || layout_.wheel) return sum_of_lanes(lanes);
  double sum = 0.0;
  for (int lane = 0; lane < kernels::lanes; ++lane) sum += lanes[lane];
  return sum;
}

template <int C>
void RingChunk<C>::end_pass(std::size_t n_steps, PartialStep* parts, std::size_t stride) noexcept {
  if (!layout_.wheel) steps_ += static_cast<long long>(n_steps);
  ++passes_;
  for (std::size_t i = 0; i < n_steps; ++i)
    for (std::size_t g = 0; g < range_.n_groups; ++g) {
      PartialStep& part = parts[i * stride + range_.first_group + g];
      part = contact_.empty() ? PartialStep{} : contact_[i * range_.n_groups + g];
      const double* sums = sums_of(i) + g * lanes_of_group();
      for (std::size_t k = 0; k < static_cast<std::size_t>(layout_.n_sums); ++k)
        part.sums[k] += sum_of(sums + k * kernels::lanes);
    }
}

template <int C>
std::size_t RingChunk<C>::candidate_at(int row, int column) const noexcept {
  const auto contact_row =
      static_cast<std::size_t>(layout_.contact_row[static_cast<std::size_t>(row)]);
  const int sector = (range_.first + column + layout_.n_sectors) % layout_.n_sectors;
  RONDO_ASSERT(contact_row < layout_.candidate.size() && sector >= 0, row, column, sector);
  return static_cast<std::size_t>(layout_.candidate[contact_row][static_cast<std::size_t>(sector)]);
}

template class RingChunk<2>;
template class RingChunk<3>;

}  // namespace rondo::dynamics
