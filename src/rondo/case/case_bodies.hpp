// SPDX-License-Identifier: BSD-3-Clause
/// @file  Parts of the case reader: the bodies, what loads them and what is looked at. Each
/// collects faults in `in` and fills its part of the case.
#pragma once
#include "rondo/case/case_values.hpp"

namespace rondo::study {

/// A Gmsh file instead of a disk; relative to the case file.
void read_mesh_file(CaseValues& in, Case& c);

/// @pre the body is read, so that it is known whether something holds it
void read_material(CaseValues& in, Case& c);
void read_initial(CaseValues& in, Case& c);

void read_body_contact(CaseValues& in, Case& c);
void read_pressures(CaseValues& in, Case& c);
void read_probes(CaseValues& in, Case& c);

/// Why K cannot be taken sector by sector; empty where it can. @pre the ground has no faults
std::string_view why_not_cyclic(const Case& c);
/// Refuses solver.operator = "cyclic" there. @pre all else is read
void check_operator(CaseValues& in, const Case& c);

}  // namespace rondo::study
