// SPDX-License-Identifier: BSD-3-Clause
/// @file  Features of a case that go together in no time step, by the model: free bodies of a mesh
/// and fillets that are small beside the elements show there first (model/steps/step_table.hpp).
#pragma once
#include "rondo/case/case.hpp"
#include "rondo/model/steps/step_table.hpp"

namespace rondo::study {

/// @param more features of the run, e.g. has::reduced @throws InputError: no step can do all
void refuse_combinations(const Case& c, const dynamics::Model& model, dynamics::Features more = 0);

/// The step of the model and why not the faster ones, in the words of the case. @pre some step can
[[nodiscard]] std::string told_step(const Case& c, const dynamics::Model& model);

}  // namespace rondo::study
