// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where friction takes energy during a run: by contact candidate, and by place in the
/// footprint (docs/wear.md). The integrators add the contacts of every step; threads may do so at
/// the same time, in any order, with the same bits. Each amount is rounded once and added to both,
/// so that the sum over the candidates and that over the places agree to the last bits.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/exact_sums.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Places at equal distances along a coordinate from the center of the wheel. What is between two
/// of them belongs to both, by its distance; the first and the last one have what is beyond them.
struct PlaceAxis {
  double first = 0.0;     ///< coordinate of the first place                              [m]
  double distance = 1.0;  ///< of two places                                            [m]
  std::size_t count = 1;

  /// The place at or before x with another one behind it, and how much of x belongs to that.
  struct Share {
    std::size_t before = 0;
    double behind = 0.0;  ///< 0 to 1                                                    [-]
  };
  [[nodiscard]] Share share_of(double x) const noexcept;
  /// (count) the coordinates of the places                                               [m]
  [[nodiscard]] std::vector<double> places() const;
};

/// The work that friction takes in one contact in the step just made, as the energy ledger has it;
/// between two bodies half of it, as each of them has a contact                     [J/m], [J]
[[nodiscard]] inline double friction_work_of(const ActiveContact& c) noexcept {
  const Vec3 mean = 0.5 * (c.before + c.after);
  const double work = -(c.impulse.y * mean.y + c.impulse.z * mean.z);
  return c.on_ground ? work : 0.5 * work;
}

class FrictionWork {
 public:
  /// Places are as far apart as the candidates around the wheel are in the mean, and cover as much
  /// as its radius ahead and behind; in three dimensions there are as many across as candidates at
  /// one angle, most_across at the most, from one side of the tread to the other. Free bodies have
  /// no wheel, and so no places.
  /// @pre has_candidates(model)
  explicit FrictionWork(const Model& model);

  static constexpr std::size_t most_along = 512, most_across = 32;

  [[nodiscard]] bool has_places() const noexcept { return has_places_; }
  /// Along t1, the heading, in the plane along x.
  [[nodiscard]] const PlaceAxis& along() const noexcept { return along_; }
  /// Along t2, in three dimensions only; else one interval.
  [[nodiscard]] const PlaceAxis& across() const noexcept { return across_; }

  /// Adds the contacts of a node. @param place of the node from the center, along t1, n, t2   [m]
  void add(Vec3 place, std::span<const ActiveContact> contacts) noexcept;
  /// Adds the contacts of a state, whose u and frame are those of the contacts.
  void add(const Model& model, const State& state) noexcept;
  /// ExactSums::settle(): after every batch of steps.
  void settle() noexcept;

  /// (nb) work over the tributary length or area of the candidate                      [J/m²]
  [[nodiscard]] std::vector<double> by_node() const;
  /// (along, across) work over the length or area of the place, which is half of the others at
  /// both sides of the tread                                                           [J/m²]
  [[nodiscard]] std::vector<double> by_place() const;
  /// Sum over the candidates                                                       [J/m], [J]
  [[nodiscard]] double total() const;

  // See ExactSums:
  [[nodiscard]] std::vector<double> save() const { return sums_.save(); }
  [[nodiscard]] bool is_saved(std::span<const double> numbers) const noexcept {
    return sums_.is_saved(numbers);
  }
  void restore(std::span<const double> numbers) noexcept { sums_.restore(numbers); }
  void clear() noexcept { sums_.clear(); }

 private:
  void add_to_places(Vec3 place, double work) noexcept;

  const std::vector<double> tributary_;  ///< (nb)                                 [m], [m²]
  const bool has_places_;
  PlaceAxis along_, across_;
  ExactSums sums_;  ///< of the candidates, then of the places
};

}  // namespace rondo::dynamics
