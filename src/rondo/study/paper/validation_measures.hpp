// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the validation of a reduced model measures with: errors of sums of squares, places
/// in time, mean tractions over the angle in space (docs/reduced.md, 10). No files.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

/// part / whole; not a number where there is no whole: an error has nothing to be measured by.
[[nodiscard]] double share_of(double part, double whole) noexcept;

/// √(Σ difference² / Σ of²).
struct SquareSums {
  double difference = 0.0, of = 0.0;
  [[nodiscard]] double relative() const noexcept;
};

/// A time between two snapshots: (1 - weight) of `first` and `weight` of `first + 1`.
struct Between {
  std::size_t first = 0;
  double weight = 0.0;  ///< 0 at the last snapshot
};

/// @param times rising. None: before the first or after the last of them.
[[nodiscard]] std::optional<Between> between(std::span<const double> times, double time) noexcept;

/// Mean tractions at places that stand still in space, evenly round the disk.
struct Profile {
  std::vector<double> angle;     ///< (m) -π to π, counter-clockwise from straight down     [rad]
  std::vector<double> pressure;  ///< (m) > 0 in compression                                 [Pa]
  std::vector<double> shear;     ///< (m) sign of contact.csv                                [Pa]
};

/// Sums up nodal forces by the angle at which their nodes stand. There are as many places as
/// candidates; a force is shared by the two places next to its node, the more the nearer, so that
/// nothing jumps where a node passes from one to the next. All of it is in the profile: the
/// profile's integral is the mean force.
class ProfileSum {
 public:
  /// Places and lengths of the mesh's candidates.
  explicit ProfileSum(const mesh::Mesh& mesh);
  /// @param theta of the turning frame [rad] @param force (nb) normal, tangential [N/m]
  void add(double theta, std::span<const Vec2> force);
  /// @pre add() was called
  [[nodiscard]] Profile mean() const;

 private:
  std::vector<double> angle_;  ///< (nb) of the candidates in the turning frame [rad]
  std::vector<Vec2> sum_;      ///< (nb) place j is at the angle 2π j / nb
  double length_ = 0.0;        ///< of all candidates together [m]
  std::size_t count_ = 0;
};

/// ‖reduced - full‖ / ‖by‖ over the places. @pre of one size
[[nodiscard]] double profile_error(std::span<const double> full, std::span<const double> reduced,
                                   std::span<const double> by);

}  // namespace rondo::study
