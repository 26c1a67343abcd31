// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace rondo::study {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range any{};
constexpr Range positive{0.0, infinity, true, false};
constexpr Range not_negative{0.0, infinity, false, false};

constexpr Range between(double low, double high) {
  return {low, high, false, false};
}

using enum KeyType;
constexpr CaseKey keys[] = {
    {"schema", integer, "-", between(1, 1), "", "required", "version of the case file's format"},
    {"title", text, "-", any, "", "name of the case file", "a line for people"},

    {"disk.outer_radius", number, "m", positive, "", "required",
     "outer radius, to the top of the tread"},
    {"disk.inner_radius", number, "m", positive, "< disk.outer_radius", "required",
     "inner radius, bonded to the rigid rim"},
    {"disk.mesh.radial", integer, "-", between(1, 100000), "", "required",
     "layers of quadrilaterals between the radii (with a tread: below the grooves)"},
    {"disk.mesh.circumferential", integer, "-", between(3, 10000000), "",
     "required without [disk.tread]", "columns of quadrilaterals; not together with [disk.tread]"},
    {"disk.mesh.grading", number, "-", between(1, 10), "", "1.0",
     "exponent p of the layers' radii; above 1 the layers are finer near the tread"},
    {"disk.tread.pitches", integer, "-", between(3, 10000000), "", "required",
     "equal pitches, each a land then a groove"},
    {"disk.tread.depth", number, "m", positive, "< disk.outer_radius - disk.inner_radius",
     "required", "height of the lands"},
    {"disk.tread.land_columns", integer, "-", between(1, 100000), "", "required",
     "columns of quadrilaterals in a land"},
    {"disk.tread.groove_columns", integer, "-", between(1, 100000), "", "required",
     "columns in a groove"},
    {"disk.tread.layers", integer, "-", between(1, 100000), "", "required",
     "layers of quadrilaterals over the depth"},

    {"mesh.file", text, "-", any, "", "later", "a Gmsh file instead of [disk]"},
    {"mesh.clamped", text, "-", any, "", "later", "the physical curve held in the turning frame"},
    {"mesh.contact", text, "-", any, "", "later", "the physical curve that may touch the ground"},

    {"material.youngs_modulus", number, "Pa", positive, "", "required", "Young's modulus E"},
    {"material.poissons_ratio",
     number,
     "-",
     {-1.0, 0.5, true, true},
     "",
     "required",
     "Poisson's ratio ν"},
    {"material.density", number, "kg/m3", positive, "", "required", "density ρ"},
    {"material.plane",
     choice,
     "-",
     any,
     "",
     "\"strain\"",
     "plane strain or plane stress",
     {"strain", "stress"}},
    {"material.integration",
     choice,
     "-",
     any,
     "",
     "\"full\"",
     "quadrature of the stiffness",
     {"full"},
     "b-bar"},
    {"material.stress_stiffening",
     choice,
     "-",
     any,
     "",
     "\"none\"",
     "stiffening by the stress of the spin",
     {"none"},
     "centrifugal"},

    {"damping.mass", number, "1/s", not_negative, "", "0.0", "α of the damping α M + β K"},
    {"damping.stiffness", number, "s", not_negative, "", "0.0", "β of the damping α M + β K"},

    {"motion.angular_velocity", history, "rad/s", any, "", "required if dynamic",
     "of the rim; > 0 rolls towards +x"},
    {"motion.speed", history, "m/s", any, "", "required if dynamic", "of the centre along x"},
    {"motion.height", history, "m", any, "", "required if dynamic", "of the centre above y = 0"},
    {"motion.start_x", number, "m", any, "", "0.0", "x of the centre at t = 0"},
    {"motion.gravity", number, "m/s2", any, "", "0.0", "acceleration of gravity, downwards"},

    {"ground.profile", profile, "m", any, "", "required",
     "surface of the ground, solid on its right-hand side; only where there is a [ground]"},
    {"ground.fillet", number, "m", not_negative, "", "0.0",
     "radius that rounds the convex corners"},
    {"ground.friction", number, "-", between(0, 100), "", "0.0",
     "Coulomb's coefficient of friction μ"},
    {"ground.restitution", number, "-", between(0, 1), "", "0.0",
     "Newton's coefficient of restitution e"},

    {"initial.state",
     choice,
     "-",
     any,
     "",
     "\"rest\"",
     "displacement at t = 0: none, or in equilibrium with the spin",
     {"rest", "stationary"}},
    {"initial.velocity", vector, "m/s", any, "", "[0.0, 0.0]",
     "added to every free node, fixed frame"},
    {"initial.displacement_gradient", matrix, "-", any, "", "[[0.0, 0.0], [0.0, 0.0]]",
     "G of a displacement G X added to the free nodes"},

    {"analysis.kind",
     choice,
     "-",
     any,
     "",
     "\"dynamic\"",
     "kind of analysis",
     {"dynamic", "crush"}},
    {"analysis.depth", number, "m", positive, "< disk.outer_radius - disk.inner_radius",
     "required if crush", "by which a crush lowers the centre, from first touch on"},
    {"analysis.increments", integer, "-", between(1, 1000000), "", "required if crush",
     "equal parts of the depth"},

    {"time.end", number, "s", positive, "", "required if dynamic",
     "end of the run, which starts at t = 0"},
    {"time.safety",
     number,
     "-",
     {0.0, 1.0, true, false},
     "not together with time.step",
     "0.8",
     "time step over the critical step"},
    {"time.step", number, "s", positive, "not together with time.safety", "none",
     "a given time step"},
    {"time.scheme",
     choice,
     "-",
     any,
     "",
     "\"symplectic\"",
     "how the gyroscopic and mass damping forces are taken",
     {"symplectic", "as-printed"}},

    {"solver.operator",
     choice,
     "-",
     any,
     "",
     "\"auto\"",
     "how K u is formed",
     {"auto", "cyclic", "sparse"}},

    {"output.history_interval", number, "s", not_negative, "", "0.0001",
     "between the rows of history.csv; 0: every step"},
    {"output.snapshots", integer, "-", between(0, 1000000), "", "400",
     "fields kept, evenly spread over [snapshots_from, end]"},
    {"output.snapshots_from", number, "s", not_negative, "<= time.end", "0.0",
     "time of the first snapshot"},
    {"output.stress", boolean, "-", any, "", "true", "stress with the snapshots"},
    {"output.checkpoint_interval", number, "s", positive, "", "60.0",
     "wall time between checkpoints; no effect in this version, which writes none"},
};

std::string range_text(const Range& r, bool whole) {
  const bool low = r.low > -infinity, high = r.high < infinity;
  if (!low && !high) return whole ? "any integer" : "any finite number";
  if (low && high && r.low == r.high) return fmt::format("{}", r.low);
  if (low && high && !r.low_open && !r.high_open) return fmt::format("{} to {}", r.low, r.high);
  std::string said;
  if (low) said = fmt::format("{} {}", r.low_open ? ">" : ">=", r.low);
  if (high) said += fmt::format("{}{} {}", low ? " and " : "", r.high_open ? "<" : "<=", r.high);
  return said;
}

/// "a" or "b"; "a", "b" or "c".
std::string choices_text(const CaseKey& key) {
  const auto n = static_cast<std::size_t>(
      std::count_if(key.choices.begin(), key.choices.end(),
                    [](std::string_view choice) { return !choice.empty(); }));
  std::string said;
  for (std::size_t i = 0; i < n; ++i)
    said += fmt::format("{}\"{}\"", i == 0 ? "" : i + 1 < n ? ", " : " or ", key.choices[i]);
  return said;
}

/// Names of tables, outer before inner, without those which this version refuses.
std::vector<std::string_view> case_tables() {
  std::vector<std::string_view> tables;
  const auto add = [&](std::string_view table) {
    if (!table.empty() && std::find(tables.begin(), tables.end(), table) == tables.end())
      tables.push_back(table);
  };
  for (const CaseKey& key : keys) {
    if (key.refused()) continue;
    add(table_of(table_of(key.path)));
    add(table_of(key.path));
  }
  return tables;
}

std::string lowered(std::string_view a) {
  std::string low(a);
  for (char& c : low) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return low;
}

}  // namespace

bool Range::contains(double value) const noexcept {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::span<const CaseKey> case_keys() noexcept {
  return keys;
}

const CaseKey* find_case_key(std::string_view path) noexcept {
  for (const CaseKey& key : keys)
    if (key.path == path) return &key;
  return nullptr;
}

bool is_case_table(std::string_view path) noexcept {
  for (const CaseKey& key : keys)
    if (key.path.size() > path.size() && key.path.starts_with(path) && key.path[path.size()] == '.')
      return true;
  return false;
}

std::string_view type_text(const CaseKey& key) noexcept {
  switch (key.type) {
    case integer:
      return "integer";
    case number:
      return "float";
    case boolean:
      return "boolean";
    case text:
    case choice:
      return "string";
    case history:
      return "float or array of pairs";
    case profile:
      return "string or array of pairs";
    case vector:
      return "array of 2 floats";
    case matrix:
      return "array of 2 arrays of 2 floats";
  }
  return "";
}

std::string allowed_text(const CaseKey& key) {
  std::string said;
  switch (key.type) {
    case integer:
    case number:
      said = range_text(key.range, key.type == integer);
      break;
    case boolean:
      return "true or false";
    case text:
      return "any text";
    case choice:
      return choices_text(key);
    case history:
      return "a finite number or [[t, value], ...] with t increasing";
    case profile:
      return "\"flat\" or [[x, y], ...] from left to right";
    case vector:
      return "[x, y], finite numbers";
    case matrix:
      return "[[a, b], [c, d]], finite numbers";
  }
  if (key.also.empty()) return said;
  return said + (key.also.starts_with("<") ? " and " : "; ") + std::string(key.also);
}

std::string keys_text(std::string_view table) {
  std::string said;
  const auto add = [&](std::string_view word) {
    said += (said.empty() ? "" : ", ") + std::string(word);
  };
  for (const CaseKey& key : keys)
    if (!key.refused() && table_of(key.path) == table) add(leaf_of(key.path));
  for (const std::string_view inner : case_tables())
    if (table_of(inner) == table) add(fmt::format("[{}]", inner));
  return said;
}

std::string_view table_of(std::string_view path) noexcept {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

std::string_view leaf_of(std::string_view path) noexcept {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::string s = lowered(a), t = lowered(b);
  std::vector<std::size_t> before(t.size() + 1), last(t.size() + 1), row(t.size() + 1);
  for (std::size_t j = 0; j <= t.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= s.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= t.size(); ++j) {
      const bool same = s[i - 1] == t[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0U : 1U)});
      if (i > 1 && j > 1 && s[i - 1] == t[j - 2] && s[i - 2] == t[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[t.size()];
}

std::string_view nearest_key(std::string_view path) {
  constexpr std::size_t longest = 60;  // no key is half as long
  const std::string_view leaf = leaf_of(path), table = table_of(path);
  if (leaf.size() > longest || table.size() > longest) return {};
  std::string_view best;
  std::pair<std::size_t, std::size_t> least{std::max<std::size_t>(1, leaf.size() / 3) + 1, 0};
  const auto consider = [&](std::string_view candidate) {
    const std::pair score{edit_distance(leaf, leaf_of(candidate)),
                          edit_distance(table, table_of(candidate))};
    // A short name in another table is near only if it is the same.
    if (table != table_of(candidate) && score.first > leaf.size() / 4) return;
    if (score >= least) return;
    least = score;
    best = candidate;
  };
  for (const CaseKey& key : keys)
    if (!key.refused()) consider(key.path);
  for (const std::string_view inner : case_tables()) consider(inner);
  return best;
}

}  // namespace rondo::study
