// SPDX-License-Identifier: BSD-3-Clause
/// @file  The keys of a case file as one table. The reader, its messages, the writer, the keys on
/// which the body depends, the keys that a resumed run may change, and docs/cases.md use it.
#pragma once
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/model/motion.hpp"

namespace rondo::study {

enum class KeyType {
  integer,
  number,
  boolean,
  text,
  choice,
  choices,
  history,
  profile,
  vector,
  matrix,
  integers,
  pairs,
  names
};

/// Access to an enum or a bool by the index of its value among the choices of its key.
struct Choice {
  void* target;
  std::size_t (*get)(const void* target);
  void (*set)(void* target, std::size_t index);
};

template <class E>
Choice choice_of(E& target) {
  return {&target,
          [](const void* p) { return static_cast<std::size_t>(*static_cast<const E*>(p)); },
          [](void* p, std::size_t index) { *static_cast<E*>(p) = static_cast<E>(index); }};
}

/// Access to a set of a key's choices: whether each one is in it; null beyond the last.
struct ChoiceList {
  std::array<bool*, 8> among{};
};

using Matrix = std::array<std::array<double, 2>, 2>;

/// The field of a case that holds the value of a key.
using CaseMember =
    std::variant<int*, double*, std::optional<double>*, bool*, std::string*, std::filesystem::path*,
                 Choice, ChoiceList, Vec2*, Matrix*, dynamics::Table*, std::vector<Vec2>*,
                 std::vector<int>*, std::vector<std::array<double, 2>>*, std::vector<std::string>*>;

template <class T>
CaseMember field_of(T& target) {
  if constexpr (std::is_enum_v<T>)
    return choice_of(target);
  else
    return &target;
}

/// Bounds of a number; an infinite bound means none on that side.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is excluded
  bool high_open = false;  ///< high itself is excluded

  /// False for NaN.
  [[nodiscard]] bool contains(double value) const noexcept;
  [[nodiscard]] bool is_bounded() const noexcept;
};

/// The values allowed at a key, in addition to its type.
struct Allowed {
  Range range;                                ///< of numbers, and of the values of tables
  std::array<std::string_view, 8> choices{};  ///< in the order of the enum; none: no choice
  std::string_view also{};                    ///< a bound by other keys, checked by a rule
  bool of_increments = false;                 ///< the points of a table are increments, not times

  [[nodiscard]] bool is_choice() const noexcept { return !choices[0].empty(); }
};

/// The analyses for which a key or a table has a meaning.
struct Analyses {
  unsigned bits;         ///< bit k: the AnalysisKind k
  bool told = true;      ///< a warning names a given key that has no meaning
  bool written = false;  ///< its default is written even if it has no meaning

  [[nodiscard]] constexpr bool all() const noexcept { return bits == ~0U; }
  [[nodiscard]] constexpr bool contain(AnalysisKind kind) const noexcept {
    return ((bits >> static_cast<unsigned>(kind)) & 1U) != 0;
  }
};

constexpr unsigned bit_of(AnalysisKind kind) {
  return 1U << static_cast<unsigned>(kind);
}
// A kind of analysis that is not named here has the same keys as a dynamic one.
inline constexpr Analyses not_in_crush{~bit_of(AnalysisKind::crush)};
inline constexpr Analyses not_in_inflation{~bit_of(AnalysisKind::inflation)};
inline constexpr Analyses in_motion{not_in_crush.bits & not_in_inflation.bits};
inline constexpr Analyses in_motion_untold{in_motion.bits, false};
inline constexpr Analyses in_motion_but_written{in_motion.bits, true, true};
inline constexpr Analyses in_time{in_motion.bits & ~bit_of(AnalysisKind::steady_rolling)};
inline constexpr Analyses in_time_untold{in_time.bits, false};
inline constexpr Analyses of_crush{bit_of(AnalysisKind::crush)};
inline constexpr Analyses of_steady_rolling{bit_of(AnalysisKind::steady_rolling)};
/// A body is pressed down by a load.
inline constexpr Analyses of_load{of_crush.bits | of_steady_rolling.bits};

constexpr bool always(const Case& /*c*/) {
  return true;
}
constexpr bool always(const Case& /*c*/, std::size_t /*k*/) {
  return true;
}
constexpr bool never(const Case& /*c*/) {
  return false;
}

/// When a key has a meaning, when it is required, and what it affects.
struct Use {
  using Test = bool (*)(const Case& c);
  using TestOfItem = bool (*)(const Case& c, std::size_t k);

  bool required = false;
  Analyses required_in{~0U};    ///< of the analyses below, those that require it
  std::string_view standard{};  ///< default in the manual, if not that of the struct
  Test when = always;           ///< only then is it written, and required if it is
  TestOfItem of_item = always;  ///< likewise for the k-th table of its list
  Analyses analyses{~0U};
  Test changes_body = always;  ///< else runs that differ only in it share a body: see body_key()
  bool may_change_on_resume = false;

  // Each of these returns a copy with one member changed.
  [[nodiscard]] constexpr Use if_(Test test, std::string_view text = {}) const {
    Use use = said(text);
    use.when = test;
    return use;
  }
  [[nodiscard]] constexpr Use if_item(TestOfItem test, std::string_view text = {}) const {
    Use use = said(text);
    use.of_item = test;
    return use;
  }
  [[nodiscard]] constexpr Use said(std::string_view text) const {
    Use use = *this;
    use.standard = text;
    return use;
  }
  [[nodiscard]] constexpr Use of(Analyses which) const {
    Use use = *this;
    use.analyses = which;
    return use;
  }
  [[nodiscard]] constexpr Use only_in(Analyses which) const {
    Use use = *this;
    use.required_in = which;
    return use;
  }
  [[nodiscard]] constexpr Use body(Test test) const {
    Use use = *this;
    use.changes_body = test;
    return use;
  }
  [[nodiscard]] constexpr Use free_on_resume() const {
    Use use = *this;
    use.may_change_on_resume = true;
    return use;
  }
};

struct CaseKey {
  std::string_view path;  ///< dotted, e.g. "disk.tread.depth"; "output.probe[].name": of each table
                          ///< in a list
  std::string_view unit;  ///< "-": none
  CaseMember (*field)(Case& c, std::size_t k);  ///< in the k-th table of its list. @pre it exists
  Allowed allowed;
  Use use;
  std::string_view meaning;  ///< for the manual, in Markdown
};

/// A table of a case file, or a list of tables.
struct CaseTable {
  std::string_view path;                   ///< "" : the top; "output.probe[]": a list
  std::size_t (*count)(const Case& c);     ///< 0: absent; for a list, its length
  void (*resize)(Case& c, std::size_t n);  ///< to n; null if it always exists
  Analyses analyses{~0U};

  [[nodiscard]] bool is_list() const noexcept { return path.ends_with("[]"); }
  /// The path without "[]".
  [[nodiscard]] std::string_view name() const noexcept {
    return path.substr(0, path.size() - (is_list() ? 2 : 0));
  }
};

/// The tables that define the body, of which a case has one. Of several, the first is read.
inline constexpr std::array<std::string_view, 3> body_tables{"disk", "mesh", "section"};

/// All keys, in the order in which a case is written; keys of a table are adjacent.
std::span<const CaseKey> case_keys() noexcept;
/// All tables with keys, in the same order.
std::span<const CaseTable> case_tables() noexcept;
/// The keys of one table, found by its path in case_tables().
std::span<const CaseKey> keys_of(const CaseTable& table);
/// The table that contains a key.
const CaseTable& table_with(const CaseKey& key);

/// Whether the key has a meaning in the k-th table of its list, so that it is written, or required.
inline bool counts(const CaseKey& key, const Case& c, std::size_t k) {
  return key.use.when(c) && key.use.of_item(c, k);
}

/// Whether the key and its table have a meaning for this kind of analysis.
bool means_to(const CaseKey& key, AnalysisKind kind);
/// Gives a key its default; empties a list of tables.
void reset(const CaseKey& key, Case& c);

/// Null if there is no such key. A table in a list is named by its number:
/// "output.probe[0].name".
const CaseKey* find_case_key(std::string_view path);

/// Whether it is a table of a case file, e.g. "disk.tread", "output.probe[0]".
bool is_case_table(std::string_view path);

/// Whether it is a list of tables of a case file, e.g. "output.probe".
bool is_case_list(std::string_view path);

/// Turns "output.probe" and 2 into "output.probe[2]".
std::string item_of(std::string_view list, std::size_t index);

/// Turns "output.probe[2].name" into "output.probe[].name".
std::string without_indices(std::string_view path);

/// "[disk.tread]" for "disk.tread"; "[[output.probe]]" for "output.probe[]".
std::string heading_of(std::string_view table);

/// Turns "output.probe[].name" and 2 into "output.probe[2].name"; other keys are unchanged.
std::string path_of(const CaseKey& key, std::size_t index);

KeyType type_of(const CaseKey& key);
/// "float", "integer", ...: the type in the words of TOML, for the manual.
std::string_view type_text(const CaseKey& key);
/// The index of a choice by its name; none: there is no such choice.
std::optional<std::size_t> find_choice(const Allowed& allowed, std::string_view name);
/// A value as TOML. @param field that of this key
std::string value_text(const CaseKey& key, const CaseMember& field);
/// The default as the manual writes it: "0.8", "required", "that of [material]".
std::string default_text(const CaseKey& key);

/// The allowed values, e.g. "> 0 and < disk.outer_radius".
std::string allowed_text(const CaseKey& key);

/// The keys of a table as one list; "": the tables and keys at the top.
std::string keys_text(std::string_view table);

/// The table that contains a dotted key ("" at the top), and the rest of the key.
std::string_view table_of(std::string_view path) noexcept;
std::string_view leaf_of(std::string_view path) noexcept;

/// A name that other programs or books use for a key: the last part of its path.
struct Synonym {
  std::string_view word;
  std::string_view key;        ///< the key that it means
  std::string_view instead{};  ///< if there is no such key: what exists instead
};
std::span<const Synonym> synonyms_of_keys() noexcept;

/// The key or table that was probably meant; empty: nothing is similar. A key with the right name
/// in the wrong table counts as similar.
std::string_view nearest_key(std::string_view path);

/// The suggestion for a key that does not exist: "did you mean ...?", by its synonyms, else by
/// nearest_key(); empty: none.
std::string meant_text(std::string_view path);

}  // namespace rondo::study
