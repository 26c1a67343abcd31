// SPDX-License-Identifier: BSD-3-Clause
/// @file  Whether the equations of harmonics (modes, steady rolling) stay within the range of the
/// numbers: their factors have no other way to tell.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::study {

/// The key, of those that the equations of a body are made of, whose value is furthest from that of
/// a usual body in SI units.
[[nodiscard]] std::string furthest_key(const Case& c);

/// Moduli, masses and frequencies whose products and their squares are numbers.
/// @param mass of the nodes, lumped [kg/m], [kg] @param rate the largest frequency [rad/s]
/// @throws InputError at furthest_key()
void demand_harmonic_range(const Case& c, const std::vector<fem::Material>& materials,
                           std::span<const double> mass, double rate);

}  // namespace rondo::study
