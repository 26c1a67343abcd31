// SPDX-License-Identifier: BSD-3-Clause
/// @file  How a viscous body creeps under a force (docs/reduced.md, section 2): its compliance is
/// that of slow strains over g(iω) = 1 + iωβ + Σ r iωτ/(1 + iωτ), and 1/g is a sum of terms with
/// positive shares, each a first-order lag of the force.
#pragma once
#include <complex>
#include <span>
#include <vector>

#include "rondo/fem/rubber.hpp"

namespace rondo::rom {

/// share/(1 + iω time) of 1/g.
struct CreepTerm {
  double share = 0.0;  ///< > 0; those of all terms add up to 1
  double time = 0.0;   ///< of creep; 0: it follows at once                              [s]

  [[nodiscard]] std::complex<double> at(double omega) const noexcept {
    return share / std::complex<double>(1.0, omega * time);
  }
};

/// The terms of 1/g, whose times ascend: the first one follows at once where there is no stiffness
/// damping. The times of the others are between those of the branches, and one is beyond them.
/// @param branches relative moduli and times > 0
/// @param stiffness_damping β >= 0 [s]
[[nodiscard]] std::vector<CreepTerm> creep_terms(std::span<const fem::ViscousBranch> branches,
                                                 double stiffness_damping);

/// 1/g(iω). @param omega [rad/s]
[[nodiscard]] std::complex<double> creep_at(std::span<const CreepTerm> terms,
                                            double omega) noexcept;

/// The lag of a step, exact for a force that changes linearly within it:
/// λ_b⁺ = kept λ_b + before λ + now λ⁺; the three add up to 1.
struct CreepStep {
  double kept = 0.0, before = 0.0, now = 1.0;
};
/// @param time of creep >= 0 [s] @param dt > 0 [s]
[[nodiscard]] CreepStep creep_step(double time, double dt) noexcept;

}  // namespace rondo::rom
