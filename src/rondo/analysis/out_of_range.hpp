// SPDX-License-Identifier: BSD-3-Clause
/// @file  Numbers of a run that are finite and yet mean nothing, or that its files cannot hold: an
/// outcome of the numerics, for the loops of a run and of a crush.
#pragma once
#include <string>

#include "rondo/analysis/build.hpp"
#include "rondo/analysis/crush_build.hpp"

namespace rondo::study {

/// Strain energy of root-mean-square strains of 100 in the stiffest material [J/m]: far beyond what
/// small strains can mean, and before numbers overflow.
double largest_strain_energy(const Setup& setup);

/// What of a state /fields of results.h5, of single precision, cannot hold, with node and value;
/// empty: nothing.
std::string beyond_files(const Setup& setup, const dynamics::State& state);
std::string beyond_files(const CrushSetup& setup, const statics::CrushState& state);

}  // namespace rondo::study
