// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of keys as a JSON Schema, for editors: `rondo schema case`,
/// cases/schema/case.json.
#pragma once
#include "rondo/case/schema/json_schema.hpp"

namespace rondo::study {

/// Types, bounds, choices, defaults, units and meanings of all keys; keys that are always required,
/// and those that an analysis requires or refuses. `rondo check` has all other rules.
Json case_schema();

/// The values that are allowed at a key.
Json schema_of(const CaseKey& key);

}  // namespace rondo::study
