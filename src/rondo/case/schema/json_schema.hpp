// SPDX-License-Identifier: BSD-3-Clause
/// @file  Parts of a JSON Schema of draft 4, the version that editors of TOML read (Taplo).
#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {

using Json = nlohmann::ordered_json;

/// The root of a schema. @param title  what the document is, e.g. "a case file of rondo"
Json schema_head(std::string_view title, std::string_view description);

/// An object without properties so far. Unknown keys are marked at the key itself, whereas
/// `"additionalProperties": false` would mark the whole table.
Json closed_object();

/// An array of at least `n_least` items of one kind.
Json array_of(Json item, std::size_t n_least = 0);

/// An array of exactly these items.
Json tuple_of(std::vector<Json> items);

/// The type "integer" or "number" with its bounds.
Json bounded(std::string_view type, const Range& range);

/// One of these words.
Json one_of(std::span<const std::string_view> words);

/// Refuses documents that match `what`; editors show the reason in their message.
Json refuse(std::string_view reason, const Json& what);

/// Matches a document that contains the dotted path, for "output.probe[].name" in each table there.
Json presence_of(std::string_view path);

/// The schema of the table with this path, "[]" meaning a list; created if it does not exist yet.
Json& table_in(Json& schema, std::string_view path);

/// A value of TOML as JSON. @pre no date, no table
Json json_of(const CaseValue& value);

/// Markdown without its links, because an editor cannot find their targets.
std::string without_links(std::string_view markdown);

}  // namespace rondo::study
