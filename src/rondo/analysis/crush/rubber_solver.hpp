// SPDX-License-Identifier: BSD-3-Clause
/// @file  A body of rubber at finite strain, increment by increment (docs/rubber.md, 4.1).
#pragma once
#include "rondo/analysis/crush/crush_solver.hpp"

namespace rondo::study {

[[nodiscard]] std::unique_ptr<CrushSolver> make_rubber_solver(const CrushSetup& setup);

}  // namespace rondo::study
