// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_wheel_integrator.hpp"

namespace rondo::dynamics {

template class WheelStep<SpaceWheel>;

}  // namespace rondo::dynamics
