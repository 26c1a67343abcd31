// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rules that involve several keys of a case, which the table of keys cannot express. Each
/// function collects faults in `in`.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "rondo/case/case_values.hpp"

namespace rondo::study {

/// Rules of one kind of analysis. @pre all keys are read
void check_analysis(CaseValues& in, Case& c);

/// All other rules, and the warnings. @pre keys without meaning for the analysis are left out
void check_case(CaseValues& in, Case& c);

/// Checks that materials suit their models and are stable; fills Case::material and regions.
void check_materials(CaseValues& in, Case& c);

/// Checks that rubber does not start in steady rolling, and sets its default of time.safety.
void check_rubber(CaseValues& in, Case& c);
/// Where branches of materials at small strain are not understood.
void check_viscosity(CaseValues& in, Case& c);

/// Rules of a wheel in three dimensions and of combinations that it excludes; for a plane body,
/// checks that it has no key of such a wheel.
void check_solid(CaseValues& in, Case& c);

/// Rules of [inflation] and [[cords]].
void check_inflation(CaseValues& in, Case& c);

/// Rules of friction on the ground that is no constant, and the analyses that cannot take it.
void check_friction(CaseValues& in, const Case& c);

/// Rules of [rim]; sets the rest positions of its supports if the case does not give them.
void check_rim(CaseValues& in, Case& c);

/// Rules of the scheme "hati"; checks that the case says which part is fine.
void check_hati(CaseValues& in, Case& c);

/// Names in the tables of a list must be unique. @param path of the names, as in the table of keys
void check_names(CaseValues& in, std::string_view path, Case& c);

/// A part of a disk is given by layers, one of a mesh by a surface. @param table of the part
void check_part(CaseValues& in, const Case& c, const std::string& table);

/// Checks that there is ground and that it is flat. @param who needs it
void check_flat_ground(CaseValues& in, const Case& c, std::string_view who);

/// Rules of a step of the slip in steady rolling.
void check_slip_step(CaseValues& in, const Case& c);

/// Rules of initial.state = "steady-rolling".
void check_steady_start(CaseValues& in, const Case& c);

/// Height of the ground if it is flat below a body of this radius at t = 0 [m]. @pre there is
/// ground without faults
std::optional<double> flat_ground_below(const Case& c, double radius);

/// Requires a key because another key is given; adds no fault if the kind of analysis has one.
void require(CaseValues& in, std::string_view key);

}  // namespace rondo::study
