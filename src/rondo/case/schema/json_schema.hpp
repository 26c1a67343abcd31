// SPDX-License-Identifier: BSD-3-Clause
/// @file  Pieces of a JSON Schema of draft 4, which is the one that editors of TOML read (Taplo).
#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {

using Json = nlohmann::ordered_json;

/// The top of a schema. @param title  what the document is, e.g. "a case file of rondo"
Json schema_head(std::string_view title, std::string_view description);

/// An object with no properties yet, whose unknown keys are faults: at the key itself, where
/// `"additionalProperties": false` would put them all over the table.
Json closed_object();

/// An array with `n_least` items and more, all of one kind.
Json array_of(Json item, std::size_t n_least = 0);

/// An array of exactly these.
Json tuple_of(std::vector<Json> items);

/// "integer" or "number" with its bounds.
Json bounded(std::string_view type, const Range& range);

/// One of these words.
Json one_of(std::span<const std::string_view> words);

/// Refuses what meets `what`, with a reason, which the message of an editor repeats.
Json refuse(std::string_view reason, const Json& what);

/// The document has what the dotted path names, of "output.probe[].name" each of the tables there.
Json presence_of(std::string_view path);

/// The schema of the table that a path names, "[]" being a list, made where it is not there yet.
Json& table_in(Json& schema, std::string_view path);

/// A value of TOML. @pre no date, no table
Json json_of(const CaseValue& value);

/// Markdown without its links, whose targets an editor does not find.
std::string without_links(std::string_view markdown);

}  // namespace rondo::study
