// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/case/toml_text.hpp"

namespace rondo::study {
namespace {

std::string pair_text(double a, double b) {
  return fmt::format("[{}, {}]", toml_number(a), toml_number(b));
}

/// One pair per line, for long tables.
template <class Pairs, class Text>
std::string pairs_text(const Pairs& pairs, Text&& text) {
  std::string said = "[";
  for (const auto& pair : pairs) said += (said.size() > 1 ? ",\n  " : "\n  ") + text(pair);
  return said + "\n]";
}

/// The TOML text of a value, depending on the type of its field.
struct ValueText {
  const Allowed& allowed;

  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const double* value) const { return toml_number(*value); }
  std::string operator()(const std::optional<double>* value) const {
    return *value ? toml_number(**value) : "";  // left out, see is_left_out()
  }
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const std::string* value) const { return toml_string(*value); }
  std::string operator()(const std::filesystem::path* value) const {
    return toml_string(as_utf8(value->string()));
  }
  std::string operator()(const Choice& value) const {
    return toml_string(allowed.choices[value.get(value.target)]);
  }
  std::string operator()(const ChoiceList& value) const {
    std::string said;
    for (std::size_t i = 0; i < value.among.size() && value.among[i]; ++i)
      if (*value.among[i]) said += (said.empty() ? "" : ", ") + toml_string(allowed.choices[i]);
    return "[" + said + "]";
  }
  std::string operator()(const Vec2* value) const { return pair_text(value->x, value->y); }
  std::string operator()(const Matrix* value) const {
    const auto& g = *value;
    return fmt::format("[{}, {}]", pair_text(g[0][0], g[0][1]), pair_text(g[1][0], g[1][1]));
  }
  std::string operator()(const dynamics::Table* value) const {
    const auto& points = value->points();
    if (points.size() == 1 && points[0][0] == 0.0 && !std::signbit(points[0][0]))
      return toml_number(points[0][1]);
    return pairs_text(points, [](const auto& p) { return pair_text(p[0], p[1]); });
  }
  std::string operator()(const std::vector<int>* value) const {
    return fmt::format("[{}]", fmt::join(*value, ", "));
  }
  std::string operator()(const std::vector<std::array<double, 2>>* value) const {
    if (value->empty()) return "[]";
    return pairs_text(*value, [](const auto& p) { return pair_text(p[0], p[1]); });
  }
  std::string operator()(const std::vector<std::string>* value) const {
    if (value->size() < 2) return toml_string(value->empty() ? "" : value->front());
    std::string said;
    for (const std::string& name : *value) said += (said.empty() ? "" : ", ") + toml_string(name);
    return "[" + said + "]";
  }
  std::string operator()(const std::vector<Vec2>* value) const {
    if (*value == contact::GroundShape{}.profile) return "\"flat\"";
    return pairs_text(*value, [](Vec2 p) { return pair_text(p.x, p.y); });
  }
};

/// Whether the key is one of several exclusive keys in a table of a list, and another one is given.
bool is_left_out(const CaseMember& field) {
  if (const auto* number = std::get_if<std::optional<double>*>(&field)) return !**number;
  if (const auto* numbers = std::get_if<std::vector<int>*>(&field)) return (*numbers)->empty();
  const auto* text = std::get_if<std::string*>(&field);
  return text && (*text)->empty();
}

/// The keys of the k-th table of its kind that have a meaning in this case, one line each.
std::string lines_of(const CaseTable& table, std::size_t k, Case& c) {
  std::string lines;
  for (const CaseKey& key : keys_of(table))
    if ((means_to(key, c.analysis.kind) || key.use.analyses.written) && counts(key, c, k) &&
        !(table.is_list() && is_left_out(key.field(c, k))))
      lines += fmt::format("{} = {}\n", leaf_of(key.path), value_text(key, key.field(c, k)));
  return lines;
}

}  // namespace

std::string value_text(const CaseKey& key, const CaseMember& field) {
  return std::visit(ValueText{key.allowed}, field);
}

std::string write_case(const Case& c) {
  Case fields = c;  // the accessors need a case that is not const
  std::string text;
  for (const CaseTable& table : case_tables())
    for (std::size_t k = 0; k < table.count(c); ++k)
      if (const std::string lines = lines_of(table, k, fields); !lines.empty()) {
        if (!table.path.empty()) text += fmt::format("\n{}\n", heading_of(table.path));
        text += lines;
      }
  return text;
}

}  // namespace rondo::study
