// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/cyclic_integrator.hpp"

#include <omp.h>

#include <algorithm>

namespace rondo::dynamics {
namespace {

constexpr std::size_t most_steps_in_a_batch = 64;

/// Insertion, for it keeps the two contacts of a node in their order and takes no memory; what
/// comes is nearly sorted, and short.
void sort_by_candidate(std::vector<ActiveContact>& active) noexcept {
  for (auto at = active.begin(); at != active.end(); ++at)
    std::rotate(
        std::upper_bound(active.begin(), at, at->candidate,
                         [](std::size_t k, const ActiveContact& c) { return k < c.candidate; }),
        at, at + 1);
}

}  // namespace

CyclicIntegrator::CyclicIntegrator(const Model& model, const State& start,
                                   const kernels::Table& table, const CyclicTuning& tuning)
    : model_(model),
      plan_(make_cyclic_plan(model, tuning)),
      steps_(most_steps_in_a_batch),
      parts_(most_steps_in_a_batch * plan_.n_groups),
      step_(start.step) {
  chunks_.reserve(plan_.chunks.size());
  for (const CyclicChunkRange& range : plan_.chunks) {
    chunks_.emplace_back(model_, plan_, table, range);
    chunks_.back().load(start);
    if (plan_.halo != Halo::ring) chunks_.back().give_edges(pass_);
  }
}

/// A thread's chunks are the same in every pass; the others' edges are read only between two
/// barriers, and written for the pass after.
void CyclicIntegrator::passes(std::size_t n_steps, std::size_t thread,
                              std::size_t n_threads) noexcept {
  const std::size_t n = chunks_.size();
  const auto depth = static_cast<std::size_t>(plan_.depth);
  unsigned pass = pass_;
  for (std::size_t done = 0; done < n_steps; done += depth, ++pass) {
    const std::size_t now = std::min(depth, n_steps - done);
    const std::span steps = std::span<const StepContext>(steps_).subspan(done, now);
    for (std::size_t c = n * thread / n_threads; c < n * (thread + 1) / n_threads; ++c) {
      if (plan_.halo != Halo::ring)
        chunks_[c].take_halo(chunks_[(c + n - 1) % n], chunks_[(c + 1) % n], pass);
      chunks_[c].pass(steps, parts_.data() + done * plan_.n_groups, plan_.n_groups);
      if (plan_.halo != Halo::ring) chunks_[c].give_edges(pass + 1);
    }
    if (n_threads > 1) barrier_.wait(static_cast<unsigned>(n_threads));
  }
}

void CyclicIntegrator::make_steps(std::size_t n_steps) noexcept {
  const int threads = std::min(model_.threads, static_cast<int>(chunks_.size()));
  if (threads > 1) {
#pragma omp parallel num_threads(threads)
    passes(n_steps, static_cast<std::size_t>(omp_get_thread_num()),
           static_cast<std::size_t>(omp_get_num_threads()));
  } else {
    passes(n_steps, 0, 1);
  }
  const auto depth = static_cast<unsigned>(plan_.depth);
  pass_ += (static_cast<unsigned>(n_steps) + depth - 1) / depth;
}

void CyclicIntegrator::advance_batch(std::span<StepReport> reports) noexcept {
  for (std::size_t i = 0; i < reports.size(); ++i)
    steps_[i] = step_context(model_, step_ + 1 + static_cast<long long>(i));
  make_steps(reports.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const std::span parts =
        std::span<const PartialStep>(parts_).subspan(i * plan_.n_groups, plan_.n_groups);
    const WholeStep whole = whole_step(model_, steps_[i].frame, parts);
    ledger_.add(whole.energy);
    reports[i] = {++step_, steps_[i].frame, whole.contact, ledger_.last()};
  }
}

void CyclicIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  std::span before = reports.first(reports.size() - (last ? 1 : 0));
  while (!before.empty()) {
    const std::size_t n = std::min(before.size(), most_steps_in_a_batch);
    advance_batch(before.first(n));
    before = before.subspan(n);
  }
  if (!last) return;
  for (const CyclicChunk& chunk : chunks_) {
    chunk.save_displacement(last->u);
    chunk.save_velocity(last->v);
  }
  advance_batch(reports.last(1));
  last->step = step_;
  last->frame = reports.back().frame;
  last->active.clear();
  for (CyclicChunk& chunk : chunks_) {
    if (!last->v_next.empty()) chunk.save_velocity(last->v_next);
    const std::span active = chunk.active();
    last->active.insert(last->active.end(), active.begin(), active.end());
  }
  sort_by_candidate(last->active);
}

void CyclicIntegrator::fields(State& state) const noexcept {
  for (const CyclicChunk& chunk : chunks_) {
    chunk.save_displacement(state.u);
    chunk.save_velocity(state.v_next);
  }
}

}  // namespace rondo::dynamics
