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

PlaceAxis axis_across(const std::vector<double>& rows) {
  const std::size_t count = std::min(rows.size(), FrictionWork::most_across);
  const double extent = rows.back() - rows.front();
  if (count < 2) return {};
  return {rows.front(), extent / static_cast<double>(count - 1), count};
}

PlaceAxis axis_along(const Model& model, std::size_t n_rows) {
  const std::vector<int>& nodes = candidates_of(model);
  double radius = 0.0;
  for (const int node : nodes) radius = std::max(radius, norm(model.reference[at(node)]));
  RONDO_DEMAND(radius > 0.0 && !nodes.empty(), radius, nodes.size());
  const double around = static_cast<double>(nodes.size()) / static_cast<double>(n_rows);
  const auto wanted = static_cast<std::size_t>(std::ceil(around / std::numbers::pi));
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, FrictionWork::most_along);
  const double distance = 2.0 * radius / static_cast<double>(count);
  return {0.5 * distance - radius, distance, count};
}

/// A part of an amount and what is left of it, whose sum is the amount exactly: the smaller of both
/// is the difference of two numbers within a factor of 2.
struct Parts {
  double rest = 0.0, part = 0.0;
};
Parts parted(double amount, double share) noexcept {
  const bool small = share <= 0.5;
  const double larger = amount - (small ? share : 1.0 - share) * amount;
  const double smaller = amount - larger;
  return small ? Parts{larger, smaller} : Parts{smaller, larger};
}

}  // namespace

PlaceAxis::Share PlaceAxis::share_of(double x) const noexcept {
  if (count < 2) return {};
  const double last = static_cast<double>(count - 1);
  const double place = std::clamp((x - first) / distance, 0.0, last);
  const double before = std::min(std::floor(place), last - 1.0);
  return {static_cast<std::size_t>(before), place - before};
}

std::vector<double> PlaceAxis::places() const {
  std::vector<double> x(count);
  for (std::size_t i = 0; i < count; ++i) x[i] = first + static_cast<double>(i) * distance;
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

void FrictionWork::add_to_places(Vec3 place, double work) noexcept {
  const PlaceAxis::Share along = along_.share_of(place.x), across = across_.share_of(place.z);
  const Parts of_rows = parted(work, along.behind);
  for (const std::size_t behind : {0U, 1U}) {
    const double of_row = behind == 0 ? of_rows.rest : of_rows.part;
    if (of_row == 0.0) continue;
    const std::size_t place_before =
        tributary_.size() + (along.before + behind) * across_.count + across.before;
    const Parts of_place = parted(of_row, across.behind);
    sums_.add(place_before, of_place.rest);
    if (of_place.part != 0.0) sums_.add(place_before + 1, of_place.part);
  }
}

void FrictionWork::add(Vec3 place, std::span<const ActiveContact> contacts) noexcept {
  for (const ActiveContact& c : contacts) {
    RONDO_ASSERT(c.candidate < tributary_.size(), c.candidate, tributary_.size());
    const double work = friction_work_of(c);
    if (work == 0.0) continue;
    sums_.add(c.candidate, work);
    if (has_places_) add_to_places(place, work);
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
  for (std::size_t i = 0; i < work.size(); ++i) {
    const std::size_t k = i % across_.count;
    const bool at_side = k == 0 || k + 1 == across_.count;
    const double width = across_.count < 2 ? 1.0 : (at_side ? 0.5 : 1.0) * across_.distance;
    work[i] = sums_.at(tributary_.size() + i) / (along_.distance * width);
  }
  return work;
}

double FrictionWork::total() const {
  ExactSums all(1);
  for (std::size_t k = 0; k < tributary_.size(); ++k) all.add(0, sums_.at(k));
  all.settle();
  return all.at(0);
}

}  // namespace rondo::dynamics
