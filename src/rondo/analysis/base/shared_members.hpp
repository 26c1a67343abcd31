// SPDX-License-Identifier: BSD-3-Clause
/// @file  Members of run.json that several analyses have.
#pragma once
#include <optional>

#include "rondo/output/run_files.hpp"

namespace rondo::study {

void add_size(std::size_t nodes, std::size_t dofs, Json& json);
/// @param width along the axle [m]; none: it is not told. @param camber [rad]
void add_wheel(std::optional<double> width, int sectors, double camber, Json& json);
void add_steps_done(const RunReport& report, Json& json);
void add_contact_residual(const RunReport& report, Json& json);
/// @param exchanged energy [J/m]; none: the balance is one of powers
void add_energy_residual(const RunReport& report, std::optional<double> exchanged, Json& json);
void add_penetration(const RunReport& report, Json& json);
/// @param seconds wall time of a solver that has the whole run at once [s]
void add_solve_wall(double seconds, Json& json);

std::vector<MemberText> shared_members();

}  // namespace rondo::study
