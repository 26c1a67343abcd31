// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the table of keys cannot say: rules between several keys of a case. Each collects
/// faults in `in`.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rondo/case/case_values.hpp"

namespace rondo::study {

/// What only one kind of analysis asks of a case. @pre all keys are read
void check_analysis(CaseValues& in, Case& c);

/// All other rules, and the warnings. @pre what means nothing to the analysis is left out
void check_case(CaseValues& in, Case& c);

/// Parameters of materials: those of their models, stable; fills Case::material and regions.
void check_materials(CaseValues& in, Case& c);

/// That rubber does not start in steady rolling, and its default of time.safety.
void check_rubber(CaseValues& in, Case& c);

/// What a wheel in three dimensions has besides, and what it does not go with; of a plane body,
/// that it has nothing of it.
void check_solid(CaseValues& in, Case& c);

/// Rules of [rim], and where its supports are at rest if the case does not say.
void check_rim(CaseValues& in, Case& c);

/// Rules of the scheme "hati", and that it says which part is fine.
void check_hati(CaseValues& in, Case& c);

/// A part of a disk goes by its layers, one of a mesh by its surface. @param table that names it
void check_part(CaseValues& in, const Case& c, const std::string& table);

/// There is ground, and it is flat. @param who needs it
void check_flat_ground(CaseValues& in, const Case& c, std::string_view who);

/// Of initial.state = "steady-rolling".
void check_steady_start(CaseValues& in, const Case& c);

/// Height of the ground where it is flat below the whole body at t = 0. @pre there is ground,
/// without faults                                                                            [m]
std::optional<double> flat_ground_below(const Case& c);

/// For keys that another key requires; says nothing where the kind of analysis is at fault.
void require(CaseValues& in, std::string_view key);

}  // namespace rondo::study
