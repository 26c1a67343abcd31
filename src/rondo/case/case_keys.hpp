// SPDX-License-Identifier: BSD-3-Clause
/// @file  The keys of a case file: one table, from which come the reader, its messages, the writer,
/// what of a case its body hangs on, what a run that goes on may change, and docs/cases.md.
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
  pairs
};

/// An enum or a bool, by the index of its value among the choices of its key.
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

/// Some of the choices of a key: of each whether it is among them; null beyond the last.
struct ChoiceList {
  std::array<bool*, 8> among{};
};

using Matrix = std::array<std::array<double, 2>, 2>;

/// Where in a case the value of a key is.
using CaseMember =
    std::variant<int*, double*, std::optional<double>*, bool*, std::string*, std::filesystem::path*,
                 Choice, ChoiceList, Vec2*, Matrix*, dynamics::Table*, std::vector<Vec2>*,
                 std::vector<int>*, std::vector<std::array<double, 2>>*>;

template <class T>
CaseMember field_of(T& target) {
  if constexpr (std::is_enum_v<T>)
    return choice_of(target);
  else
    return &target;
}

/// Bounds of a number; infinite: none on that side.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is out
  bool high_open = false;  ///< high itself is out

  /// False for NaN.
  [[nodiscard]] bool contains(double value) const noexcept;
  [[nodiscard]] bool is_bounded() const noexcept;
};

/// What may stand there, beside what the type says.
struct Allowed {
  Range range;                                ///< of numbers, and of the values of tables
  std::array<std::string_view, 8> choices{};  ///< in the order of the enum; none: no choice
  std::string_view also{};                    ///< a bound that involves other keys: a rule
  bool of_increments = false;  ///< the points of a table are at increments, not at times

  [[nodiscard]] bool is_choice() const noexcept { return !choices[0].empty(); }
};

/// The analyses that a key or a table means something to.
struct Analyses {
  unsigned bits;         ///< bit k: the AnalysisKind k
  bool told = true;      ///< what is given for nothing is named in a warning
  bool written = false;  ///< its default is written where it means nothing

  [[nodiscard]] constexpr bool all() const noexcept { return bits == ~0U; }
  [[nodiscard]] constexpr bool contain(AnalysisKind kind) const noexcept {
    return ((bits >> static_cast<unsigned>(kind)) & 1U) != 0;
  }
};

constexpr unsigned bit_of(AnalysisKind kind) {
  return 1U << static_cast<unsigned>(kind);
}
// A kind of analysis that is not named here has the keys of a dynamic one.
inline constexpr Analyses in_motion{~bit_of(AnalysisKind::crush)};
inline constexpr Analyses in_motion_untold{in_motion.bits, false};
inline constexpr Analyses in_motion_but_written{in_motion.bits, true, true};
inline constexpr Analyses in_time{in_motion.bits & ~bit_of(AnalysisKind::steady_rolling)};
inline constexpr Analyses in_time_untold{in_time.bits, false};
inline constexpr Analyses of_crush{bit_of(AnalysisKind::crush)};
inline constexpr Analyses of_steady_rolling{bit_of(AnalysisKind::steady_rolling)};

constexpr bool always(const Case& /*c*/) {
  return true;
}
constexpr bool always(const Case& /*c*/, std::size_t /*k*/) {
  return true;
}
constexpr bool never(const Case& /*c*/) {
  return false;
}

/// When a key counts, and what for.
struct Use {
  using Test = bool (*)(const Case& c);
  using TestOfItem = bool (*)(const Case& c, std::size_t k);

  bool required = false;
  Analyses required_in{~0U};    ///< of those below, the analyses that require it
  std::string_view standard{};  ///< for the manual, where the default is not that of the struct
  Test when = always;           ///< it is written, and required if it is
  TestOfItem of_item = always;  ///< likewise of the k-th table of its list alone
  Analyses analyses{~0U};
  Test changes_body = always;  ///< runs that differ in it alone share no body: see body_key()
  bool may_change_on_resume = false;

  // The same but for one thing.
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
                          ///< of a list
  std::string_view unit;  ///< "-": none
  CaseMember (*field)(Case& c, std::size_t k);  ///< of the k-th table of its list. @pre it is there
  Allowed allowed;
  Use use;
  std::string_view meaning;  ///< for the manual, in Markdown
};

/// A table of a case file, or a list of tables.
struct CaseTable {
  std::string_view path;                   ///< "" : the top; "output.probe[]": a list
  std::size_t (*count)(const Case& c);     ///< 0: not there; of a list, its length
  void (*resize)(Case& c, std::size_t n);  ///< to n; null where it is always there
  Analyses analyses{~0U};

  [[nodiscard]] bool is_list() const noexcept { return path.ends_with("[]"); }
  /// The path without "[]".
  [[nodiscard]] std::string_view name() const noexcept {
    return path.substr(0, path.size() - (is_list() ? 2 : 0));
  }
};

/// The tables that give the body: one of them is in a case. Of several the first is read.
inline constexpr std::array<std::string_view, 3> body_tables{"disk", "mesh", "section"};

/// All keys, in the order in which a case is written: those of a table side by side.
std::span<const CaseKey> case_keys() noexcept;
/// All tables with keys, in the same order.
std::span<const CaseTable> case_tables() noexcept;
/// Those of one table, by its path in case_tables().
std::span<const CaseKey> keys_of(const CaseTable& table);
/// The table that a key stands in.
const CaseTable& table_with(const CaseKey& key);

/// The k-th table of its list says something by this key: it is written, and required if it is.
inline bool counts(const CaseKey& key, const Case& c, std::size_t k) {
  return key.use.when(c) && key.use.of_item(c, k);
}

/// The key and its table mean something to this kind of analysis.
bool means_to(const CaseKey& key, AnalysisKind kind);
/// Gives a key its default; a list of tables is emptied.
void reset(const CaseKey& key, Case& c);

/// Null where there is no such key. Tables of lists are named by their number:
/// "output.probe[0].name".
const CaseKey* find_case_key(std::string_view path);

/// A table of a case file, e.g. "disk.tread", "output.probe[0]".
bool is_case_table(std::string_view path);

/// A list of tables of a case file, e.g. "output.probe".
bool is_case_list(std::string_view path);

/// "output.probe" and 2 to "output.probe[2]".
std::string item_of(std::string_view list, std::size_t index);

/// "output.probe[2].name" to "output.probe[].name".
std::string without_indices(std::string_view path);

/// "[disk.tread]"; "[[output.probe]]" of "output.probe[]".
std::string heading_of(std::string_view table);

/// "output.probe[].name" and 2 to "output.probe[2].name"; a key of no list as it is.
std::string path_of(const CaseKey& key, std::size_t index);

KeyType type_of(const CaseKey& key);
/// "float", "integer", ...: TOML's words, for the manual.
std::string_view type_text(const CaseKey& key);
/// The index of a choice by its name; none: it is not one of them.
std::optional<std::size_t> find_choice(const Allowed& allowed, std::string_view name);
/// A value as TOML. @param field of this key
std::string value_text(const CaseKey& key, const CaseMember& field);
/// As the manual says it: "0.8", "required", "that of [material]".
std::string default_text(const CaseKey& key);

/// What may stand there, e.g. "> 0 and < disk.outer_radius".
std::string allowed_text(const CaseKey& key);

/// The keys of a table as one list; "": the tables and keys at the top.
std::string keys_text(std::string_view table);

/// The table a dotted key stands in ("" at the top), and the part after it.
std::string_view table_of(std::string_view path) noexcept;
std::string_view leaf_of(std::string_view path) noexcept;

/// What other programs or books call a key: the last part of its path.
struct Synonym {
  std::string_view word;
  std::string_view key;        ///< that is meant
  std::string_view instead{};  ///< where there is no such key: what there is
};
std::span<const Synonym> synonyms_of_keys() noexcept;

/// The key or table that was probably meant; empty: nothing is near. A key of the right name in the
/// wrong table counts as near.
std::string_view nearest_key(std::string_view path);

/// What to say of a key that does not exist: "did you mean ...?", by its synonyms, else by
/// nearest_key(); empty: nothing.
std::string meant_text(std::string_view path);

}  // namespace rondo::study
