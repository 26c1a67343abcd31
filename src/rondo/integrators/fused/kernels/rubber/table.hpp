// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of one instruction set for rubber. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/rubber/elements.hpp"
#include "rondo/integrators/fused/kernels/rubber/rows.hpp"

namespace {

using NeoHooke = rubber::NeoHooke<Pack>;
using Polynomial = rubber::Polynomial<Pack>;

constexpr rondo::dynamics::kernels::RubberTable rubber_table() noexcept {
  using rondo::fem::RubberLaw;
  static_assert(RubberLaw{0} == RubberLaw::neo_hooke && RubberLaw{1} == RubberLaw::mooney_rivlin &&
                RubberLaw{2} == RubberLaw::yeoh && RubberLaw{3} == RubberLaw::ogden);
  return {{{rubber_elements<NeoHooke, false>, rubber_elements<Polynomial, false>,
            rubber_elements<Polynomial, false>, rubber_elements<OgdenLanes, false>},
           {rubber_elements<NeoHooke, true>, rubber_elements<Polynomial, true>,
            rubber_elements<Polynomial, true>, rubber_elements<OgdenLanes, true>}},
          {{{rubber_rows<false, false, false>, rubber_rows<false, false, true>},
            {rubber_rows<false, true, false>, rubber_rows<false, true, true>}},
           {{rubber_rows<true, false, false>, rubber_rows<true, false, true>},
            {rubber_rows<true, true, false>, rubber_rows<true, true, true>}}},
          {rubber_wheel_rows<false>, rubber_wheel_rows<true>}};
}

}  // namespace
