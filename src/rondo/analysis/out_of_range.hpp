// SPDX-License-Identifier: BSD-3-Clause
/// @file  Numbers of a run that are finite and yet mean nothing, or that its files cannot hold: an
/// outcome of the numerics, for the loops of a run and of a crush.
#pragma once
#include <string>
#include <string_view>

#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/output/contact_statistics.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// Strain energy of root-mean-square strains of 1 in the stiffest material [J/m]: beyond what small
/// strains can mean. Compared at every step; an inverted cell is seen at looks of StrainWatch.
double largest_strain_energy(const Setup& setup);

/// The quantity that is out of bound, and when: a half step (velocities, ledger) comes before its
/// step's contact.
struct OutOfBound {
  std::string what;  ///< empty while all is well
  bool at_half_step = false;
  bool not_finite = false;
};

/// Bound of the ledger's relative residual: round-off, but for linear elastic bodies that nothing
/// holds (docs/theory.md, 5 and 9.7).
double energy_residual_bound(const Setup& setup) noexcept;

/// Largest values that are no trouble.
struct Bounds {
  double ledger = 0.0;         ///< relative residual
  double strain_energy = 0.0;  ///< [J/m]
  std::string impact_cure;     ///< result of impact_cure()
  bool guards_impacts = true;  ///< the run ends above impact_gain_bound
  std::string_view energy_unit = "J/m";
  double contact = residual_bound;  ///< residual of the law of contact, relative
  std::string_view contact_cure{};  ///< what to try where it is larger; empty: nothing
};

/// Energy that impacts have created, over the energy exchanged: above the first it is spoken of,
/// above the second the run ends (docs/theory.md, 5).
inline constexpr double impact_gain_spoken_of = 1e-3, impact_gain_bound = 1e-2;
double impact_gain(const dynamics::Balance& balance) noexcept;

/// The settings that keep impacts of this model from creating energy, in the words of a case file.
std::string impact_cure(const dynamics::Model& model);

/// The message on the energy that impacts created, with its bound.
std::string created_by_impacts(const dynamics::Balance& balance, double bound, const Bounds& of);

/// The fault in how a step found its contacts: a node that moved farther than sharp corners
/// were looked for, one without mass that two facets hold, a contact that was found late. Empty:
/// nothing.
std::string contact_not_found(const dynamics::ContactReport& step);

/// The message where contact felt how the parts of the scheme "hati" were joined.
std::string felt_joint();

/// The message on a loaded rim that turns by more than dynamics::most_turn in a step; empty: it
/// does not. @param turn [rad] @param dt [s]
std::string turned_too_far(double turn, double dt);

/// @param contact of all steps so far. What is out of bound first; `what` is empty while all is
/// well.
OutOfBound find_out_of_bound(const dynamics::Balance& balance, const ContactStatistics& contact,
                             const Bounds& bounds);

/// Name of the first quantity of the state that is not finite; `otherwise` if all are.
std::string not_finite(const dynamics::State& state, const std::string& otherwise);

/// The value of a state that /fields of results.h5, of single precision, cannot hold, with its
/// node; empty: nothing.
std::string beyond_files(const Setup& setup, const dynamics::State& state);
std::string beyond_files(const CrushSetup& setup, const statics::CrushState& state);
/// @param u (n) displacement of a wheel in three dimensions [m]
std::string beyond_files(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
                         std::span<const Vec3> u);

}  // namespace rondo::study
