// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a run says of its rubber: cells that turn inside out, and how well the steps follow
/// its forces (docs/rubber.md, section 3).
#pragma once
#include <span>
#include <string>

#include "rondo/mesh/mesh.hpp"
#include "rondo/model/material_report.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// Error of the forces' work, over the energy exchanged, above which summarise_rubber() warns.
inline constexpr double integration_bound = 1e-2;

/// The trouble, with cell and place. @param u (n) of about the step that it was seen in [m]
/// @param least smallest det F, <= 0
[[nodiscard]] std::string inverted_rubber(const mesh::Mesh& mesh, std::span<const Vec2> u,
                                          double least);

/// Adds to run.json and to the report, which gets a warning above the bound.
/// @param exchanged in the run [J/m]
void summarise_rubber(const dynamics::MaterialReport& last, double exchanged, Json& json,
                      RunReport& report);

/// Texts of the members that summarise_rubber() adds to run.json.
std::vector<MemberText> rubber_members();

}  // namespace rondo::study
