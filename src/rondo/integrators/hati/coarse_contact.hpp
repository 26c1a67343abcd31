// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the contacts of the fine steps of a coarse step are, together.
#pragma once
#include <span>
#include <vector>

#include "rondo/integrators/hati/fine_part.hpp"

namespace rondo::dynamics {

/// Sums of impulses, works and problems solved; largest values; nodes, sticking ones, length and
/// those between bodies of the last fine step
[[nodiscard]] ContactReport contact_of(std::span<const FineContact> fine) noexcept;

/// The impulses of each candidate summed, by candidate; that of the newest normal first, which has
/// velocities and gap of that fine step. @param active replaced
void merge_contacts(std::span<const FineContact> fine, std::vector<ActiveContact>& active);

}  // namespace rondo::dynamics
