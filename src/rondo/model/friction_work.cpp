// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/friction_work.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

const std::vector<int>& candidates_of(const Model& model) {
  RONDO_DEMAND(has_candidates(model));
  return model.contact ? model.contact->nodes : model.surfaces->nodes;
}

const std::vector<double>& tributaries_of(const Model& model) {
  RONDO_DEMAND(has_candidates(model));
  return model.contact ? model.contact->tributary : model.surfaces->tributary;
}

/// Different places across among the candidates, ascending                                  [m]
std::vector<double> rows_across(const Model& model) {
  std::vector<double> z{0.0};
  if (!model.solid) return z;
  z.clear();
  for (const int node : candidates_of(model)) z.push_back(model.solid->axial[at(node)]);
  std::ranges::sort(z);
  const double same = 1e-6 * (z.back() - z.front());
  const auto end =
      std::unique(z.begin(), z.end(), [&](double a, double b) { return b - a <= same; });
  z.erase(end, z.end());
  return z;
}

/// The rows in the middles of the first and the last interval.
PlaceAxis axis_across(const std::vector<double>& rows) {
  const std::size_t count = std::min(rows.size(), FrictionWork::most_across);
  const double extent = rows.back() - rows.front();
  if (count < 2) return {};
  const double width = extent / static_cast<double>(count - 1);
  return {rows.front() - 0.5 * width, width, count};
}

PlaceAxis axis_along(const Model& model, std::size_t n_rows) {
  const std::vector<int>& nodes = candidates_of(model);
  double radius = 0.0;
  for (const int node : nodes) radius = std::max(radius, norm(model.reference[at(node)]));
  RONDO_DEMAND(radius > 0.0 && !nodes.empty(), radius, nodes.size());
  const double around = static_cast<double>(nodes.size()) / static_cast<double>(n_rows);
  const auto wanted = static_cast<std::size_t>(std::ceil(around / std::numbers::pi));
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, FrictionWork::most_along);
  return {-radius, 2.0 * radius / static_cast<double>(count), count};
}

}  // namespace

std::size_t PlaceAxis::interval_of(double x) const noexcept {
  const double place = (x - from) / width;
  if (!(place > 0.0)) return 0;
  return place < static_cast<double>(count) ? static_cast<std::size_t>(place) : count - 1;
}

std::vector<double> PlaceAxis::middles() const {
  std::vector<double> x(count);
  for (std::size_t i = 0; i < count; ++i) x[i] = from + (static_cast<double>(i) + 0.5) * width;
  return x;
}

FrictionWork::FrictionWork(const Model& model)
    : tributary_(tributaries_of(model)), has_places_(model.free_bodies.empty()), sums_(0) {
  RONDO_DEMAND(tributary_.size() == candidates_of(model).size() &&
                   std::ranges::all_of(tributary_, [](double l) { return l > 0.0; }),
               tributary_.size(), candidates_of(model).size());
  std::size_t n_places = 0;
  if (has_places_) {
    const std::vector<double> rows = rows_across(model);
    across_ = axis_across(rows);
    along_ = axis_along(model, rows.size());
    n_places = along_.count * across_.count;
  }
  sums_ = ExactSums(tributary_.size() + n_places);
}

std::size_t FrictionWork::place_of(Vec3 place) const noexcept {
  const std::size_t across = across_.count > 1 ? across_.interval_of(place.z) : 0;
  return tributary_.size() + along_.interval_of(place.x) * across_.count + across;
}

void FrictionWork::add(Vec3 place, std::span<const ActiveContact> contacts) noexcept {
  for (const ActiveContact& c : contacts) {
    RONDO_ASSERT(c.candidate < tributary_.size(), c.candidate, tributary_.size());
    const double work = friction_work_of(c);
    if (work == 0.0) continue;
    sums_.add(c.candidate, work);
    if (has_places_) sums_.add(place_of(place), work);
  }
}

void FrictionWork::add(const Model& model, const State& state) noexcept {
  const std::vector<int>& nodes = candidates_of(model);
  const GroundFrame ground(model.motion.camber);
  for (const ActiveContact& c : state.active) {
    const std::size_t k = at(nodes[c.candidate]);
    const Vec3 arm = model.solid
                         ? Vec3(model.reference[k], model.solid->axial[k]) + state.u.space()[k]
                         : Vec3(model.reference[k] + state.u.plane()[k]);
    add(ground.from_wheel(state.frame.rotation * arm), {&c, 1});
  }
}

void FrictionWork::settle() noexcept {
  sums_.settle();
}

std::vector<double> FrictionWork::by_node() const {
  std::vector<double> work(tributary_.size());
  for (std::size_t k = 0; k < work.size(); ++k) work[k] = sums_.at(k) / tributary_[k];
  return work;
}

std::vector<double> FrictionWork::by_place() const {
  std::vector<double> work(sums_.size() - tributary_.size());
  const double size = along_.width * (across_.count > 1 ? across_.width : 1.0);
  for (std::size_t i = 0; i < work.size(); ++i) work[i] = sums_.at(tributary_.size() + i) / size;
  return work;
}

double FrictionWork::total() const {
  ExactSums all(1);
  for (std::size_t k = 0; k < tributary_.size(); ++k) all.add(0, sums_.at(k));
  all.settle();
  return all.at(0);
}

}  // namespace rondo::dynamics
