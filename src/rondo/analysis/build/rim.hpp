// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rim of a case with [rim]: its body, its critical step, what `rondo check` tells of
/// it.
#pragma once
#include <optional>

#include "rondo/analysis/build/physical.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/model/stability/rim_step.hpp"

namespace rondo::study {

/// Fills model.rim, mass and inertia with those of the clamped nodes. Nothing without a [rim].
/// @throws InputError: a body that is free; clamped nodes whose center of mass is not the origin,
/// about which the rim turns. @pre masses and free bodies are found
void add_rim(const Case& c, const mesh::Mesh& mesh, dynamics::Model& model);

/// Loads, brake and supports of the case: masses stay. Nothing without a rim.
void set_rim_loads(const Case& c, dynamics::Model& model);

/// @param held the critical step with the rim held. @pre a rim; K is there
dynamics::CriticalStep step_with_rim(const dynamics::Model& model,
                                     const dynamics::CriticalStep& held,
                                     dynamics::LaggedDamping damping);

/// Does the same by another product with K, on any body: the rim meets each frequency of it.
dynamics::CriticalStep step_with_rim(const dynamics::Model& model,
                                     const dynamics::StiffnessProduct& product,
                                     const dynamics::CriticalStep& held,
                                     dynamics::LaggedDamping damping);

/// How near a hub that comes down by itself comes to the ground.
class HubWatch {
 public:
  explicit HubWatch(const Setup& setup);

  struct Seen {
    std::string warning, trouble;  ///< empty: nothing new, all well
  };
  /// @param center along t1, n and t2 [m] @param time [s]. Warns once, above deep_share of the
  /// wall; the rim in the ground is trouble.
  [[nodiscard]] Seen look(Vec3 center, double time);

 private:
  const Setup& setup_;
  std::optional<Wall> wall_;  ///< none: only that the rim stays out of the ground is looked at
  double held_ = 0.0;         ///< radius of what is held; 0: nothing to look at [m]
  bool told_ = false;
};

/// What presses a wheel of free height on flat ground at the end of the run: force_y and weight of
/// rim and body; none: a spring along y bears a part of it [N/m], [N]. @pre a rim
[[nodiscard]] std::optional<double> load_on_ground(const Case& c, const dynamics::Model& model);

/// Adds figures: what is free, masses, loads at the end of the run. @pre a rim
void tell_rim(const Case& c, Setup& s);

}  // namespace rondo::study
