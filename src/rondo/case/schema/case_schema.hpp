// SPDX-License-Identifier: BSD-3-Clause
/// @file  The table of keys as a JSON Schema, for editors: `rondo schema case`,
/// cases/schema/case.json.
#pragma once
#include "rondo/case/schema/json_schema.hpp"

namespace rondo::study {

/// Types, bounds, choices, defaults, units and meanings of all keys; which are always required, and
/// which an analysis asks for or refuses. Rules between keys beyond that are `rondo check`'s.
Json case_schema();

/// What may stand at a key.
Json schema_of(const CaseKey& key);

}  // namespace rondo::study
