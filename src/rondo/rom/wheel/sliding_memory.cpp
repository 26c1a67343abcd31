// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/sliding_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

// Of the differences from which the derivatives are found: tables are straight between points.
constexpr double speed_step = 1e-6;     ///< [m/s]
constexpr double pressure_step = 1e-6;  ///< of the pressure

}  // namespace

SlidingMemory::SlidingMemory(contact::Friction friction, std::vector<double> lengths,
                             std::size_t n_nodes, double dt)
    : friction_(std::move(friction)), lengths_(std::move(lengths)), dt_(dt), kept_(n_nodes) {
  RONDO_DEMAND(!lengths_.empty() && n_nodes % lengths_.size() == 0 && dt > 0.0, lengths_.size(),
               n_nodes, dt);
}

double SlidingMemory::length(int node) const noexcept {
  return lengths_[at(node) % lengths_.size()];
}

double SlidingMemory::before(int node, Vec2 place, Vec2 tangent) const noexcept {
  const Kept& was = kept_[at(node)];
  return within(node, place, std::abs(dot(tangent, was.way)), was.normal).coefficient;
}

SlidingFriction SlidingMemory::within(int node, Vec2 place, double slip,
                                      double normal) const noexcept {
  const double over = length(node) > 0.0 ? 1.0 / length(node) : 0.0;
  contact::SlidingState of{place + kept_[at(node)].way, slip / dt_, over * normal};
  const double coefficient = friction_.coefficient(of);
  of.slip += speed_step;
  const double faster = friction_.coefficient(of);
  of.slip = slip / dt_;
  const double more = pressure_step * of.pressure;
  of.pressure += more;
  const double firmer = friction_.coefficient(of);
  return {coefficient, (faster - coefficient) / speed_step / dt_,
          more > 0.0 ? (firmer - coefficient) / more * over : 0.0};
}

void SlidingMemory::clear() noexcept {
  std::ranges::fill(kept_, Kept{});
}

void SlidingMemory::keep(int node, Vec2 way, double normal) noexcept {
  kept_[at(node)] = {way, normal};
}

void SlidingMemory::press(int node, double normal) noexcept {
  kept_[at(node)].normal = normal;
}

void SlidingMemory::move(int node, Vec2 way) noexcept {
  kept_[at(node)].way = way;
}

void SlidingMemory::save(std::vector<double>& numbers) const {
  for (const Kept& k : kept_) numbers.insert(numbers.end(), {k.way.x, k.way.y, k.normal});
}

void SlidingMemory::restore(std::span<const double> numbers) {
  RONDO_DEMAND(numbers.size() == numbers_of_node * kept_.size(), numbers.size(), kept_.size());
  for (Kept& k : kept_) {
    k = {{numbers[0], numbers[1]}, numbers[2]};
    numbers = numbers.subspan(numbers_of_node);
  }
}

}  // namespace rondo::rom
