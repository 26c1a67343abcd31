// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/road/crg/crg_columns.hpp"
#include "rondo/road/crg/crg_data.hpp"
#include "rondo/road/crg/crg_modifiers.hpp"
#include "rondo/road/crg/crg_parameters.hpp"
#include "rondo/road/reference_line.hpp"

namespace rondo::road {
namespace {

namespace fs = std::filesystem;

/// Header and reference line may differ so much at the end, in slope, before it is told.
constexpr double told_gap = 1e-6;
/// Rows may be so much nearer or farther than the others, in increments; as for OpenCRG's own
/// reader.
constexpr double uneven_rows = 0.03;

struct OpenFile {
  fs::path path;
  std::ifstream in;
  CrgHeader header;
};

OpenFile open_crg(const fs::path& path) {
  demand_regular_file(path);
  OpenFile file{path, std::ifstream(path, std::ios::binary), {}};
  if (!file.in) throw FileError(path.string(), "cannot be opened");
  file.header = read_crg_header(file.in, path);
  for (const CrgBlock& block : file.header.blocks)
    if (block.name.starts_with("ROAD_CRG") && block.name != "ROAD_CRG" &&
        block.name != "ROAD_CRG_MODS" && block.name != "ROAD_CRG_OPTS" &&
        block.name != "ROAD_CRG_FILE" && block.name != "ROAD_CRG_MPRO")
      refuse_header({path.string(), block.line, shown_part("$" + block.name)}, "",
                    "OpenCRG has no such block",
                    "$ROAD_CRG, $ROAD_CRG_OPTS, $ROAD_CRG_MODS, $ROAD_CRG_FILE or $ROAD_CRG_MPRO");
  return file;
}

/// The file that a block $ROAD_CRG_FILE names, beside the file that names it.
fs::path referred_file(const OpenFile& file, const CrgBlock& block) {
  std::string name;
  for (const CrgLine& line : block.lines) name += line.text;
  const int line = block.lines.empty() ? block.line : block.lines.front().number;
  const HeaderPlace place{file.path.string(), line, "$ROAD_CRG_FILE"};
  if (name.empty())
    refuse_header(place, "", "the block names no file", "a path in one or more lines");
  if (name.starts_with('$'))
    refuse_header(place, name, "environment variables are not replaced",
                  "a path, relative to the folder of this file or absolute");
  if (std::ranges::any_of(name, [](char c) { return c < ' ' || c > '~'; }))
    refuse_header(place, name, "OpenCRG has other characters than ASCII in comments only",
                  "a name in ASCII: rename the file");
  const fs::path path = file.path.parent_path() / name;
  std::error_code error;
  if (!fs::exists(path, error))
    refuse_header(place, name, fmt::format("there is no file {}", path.string()),
                  "a path, relative to the folder of this file or absolute");
  return path;
}

/// Follows references. Modifiers and options are those of the first file that has the block.
struct Chain {
  OpenFile file;  ///< that holds the heights
  CrgValues modifiers, options;
  bool has_modifiers = false;
  std::vector<std::string> notes;
};

void take_blocks(const OpenFile& file, bool& has_options, Chain& chain) {
  if (!chain.has_modifiers && file.header.block("ROAD_CRG_MODS") != nullptr) {
    chain.modifiers = read_modifier_block(file.header);
    chain.has_modifiers = true;
  }
  if (!has_options && file.header.block("ROAD_CRG_OPTS") != nullptr) {
    chain.options = read_option_block(file.header);
    has_options = true;
  }
}

/// Whether `next` is among the files that have led to it. Adds the file that names it.
bool is_circle(const fs::path& file, const fs::path& next, std::vector<fs::path>& seen) {
  constexpr std::size_t most_files = 100;  // if a folder cannot be read, its files look alike
  std::error_code error;
  seen.push_back(fs::weakly_canonical(file, error));
  const fs::path goal = fs::weakly_canonical(next, error);
  return seen.size() > most_files || (!error && std::ranges::find(seen, goal) != seen.end());
}

Chain follow_references(const fs::path& first) {
  Chain chain;
  bool has_options = false;
  std::vector<fs::path> seen;
  chain.file = open_crg(first);
  for (;;) {
    take_blocks(chain.file, has_options, chain);
    const CrgBlock* const block = chain.file.header.block("ROAD_CRG_FILE");
    if (block == nullptr) return chain;
    const fs::path next = referred_file(chain.file, *block);
    if (is_circle(chain.file.path, next, seen))
      refuse_header({chain.file.path.string(), block->line, "$ROAD_CRG_FILE"}, next.string(),
                    "the files refer to one another in a circle, or more than a hundred in a row",
                    "a chain of files that ends with one that has data");
    if (chain.file.header.data_begin > 0)
      chain.notes.push_back(fmt::format("The data of {} are not used, because it refers to {}.",
                                        chain.file.path.string(), next.string()));
    chain.file = open_crg(next);
  }
}

void demand_data(const OpenFile& file) {
  if (file.header.data_begin == 0)
    throw FileError(
        file.path.string(),
        fmt::format("ends in line {} without a line that begins with $$, behind which the "
                    "data are: it is cut off, or no OpenCRG file",
                    file.header.last_line));
}

CrgDataPlan plan_of(const OpenFile& file, const CrgDefinition& definition, const CrgValues& road) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file.path, error);
  if (error || size < file.header.data_begin)
    throw FileError(file.path.string(), "cannot be measured, or changes while it is read");
  return {file.path.string(),
          definition.format,
          definition.channels.size(),
          crg_promised_rows(road),
          file.header.last_line,
          file.header.data_begin,
          static_cast<std::size_t>(size)};
}

CrgColumns read_columns_of(OpenFile& file, const CrgDefinition& definition,
                           const CrgSections& sections, const CrgDataPlan& plan) {
  CrgColumns columns;
  const std::size_t n_v = sections.v.size();
  const std::size_t fit = (plan.file_size - plan.data_begin) / plan.format.width();
  const double promised = plan.rows.value_or(0.0) * static_cast<double>(n_v);
  columns.heights.reserve(promised < static_cast<double>(fit) ? static_cast<std::size_t>(promised)
                                                              : fit);
  const auto take = [&](std::span<const double> row) {
    add_crg_row(definition, sections, row, columns);
  };
  definition.format.text ? read_crg_text_rows(file.in, plan, take)
                         : read_crg_binary_rows(file.in, plan, take);
  if (columns.heights.size() < 2 * n_v)
    throw FileError(plan.file, fmt::format("the data have {} rows, and a road has two or more",
                                           columns.heights.size() / n_v));
  demand_sound_columns(columns, sections, plan.file);
  return columns;
}

/// Rows by a channel of positions, which must be even.
void set_rows_by_channel(const std::vector<double>& position, Road& road) {
  const double step =
      (position.back() - position.front()) / static_cast<double>(position.size() - 1);
  for (std::size_t i = 0; i + 1 < position.size(); ++i)
    if (!(std::abs(position[i + 1] - position[i] - step) <= uneven_rows * step))
      throw FileError(road.file,
                      fmt::format("rows {} and {} of the data: their positions u are {} and {} "
                                  "m; OpenCRG has rows of one distance only",
                                  i + 1, i + 2, position[i], position[i + 1]));
  if (!(std::abs(step - road.u_step) <= uneven_rows * road.u_step))
    throw FileError(road.file,
                    fmt::format("the rows are {} m apart by the channel of positions u, and {} m "
                                "by REFERENCE_LINE_INCREMENT",
                                step, road.u_step));
  road.u_first = position.front();
  road.u_step = step;
}

/// Slope and heights of the reference line, after lengths are scaled.
void set_line(const CrgValues& values, const CrgScales& scales, Road& road) {
  for (double& s : road.slope) s *= scales.slope;
  const double start = values.real_or("REFERENCE_LINE_START_Z", 0.0);
  std::optional<double> end = values.real("REFERENCE_LINE_END_Z");
  if (end) end = start + scales.slope * scales.length * (*end - start);
  ReferenceLine line = integrate_slope(road.slope, road.n_u(), road.u_step, start, end);
  road.line_height = std::move(line.height);
  if (std::abs(line.end_gap) <= told_gap * (road.u_last() - road.u_first)) return;
  if (road.slope.size() == 1)
    values.refuse("REFERENCE_LINE_END_Z",
                  fmt::format("the constant slope leads to {:.6g} m", road.line_height.back()),
                  "this height, another slope, or a channel D:reference line slope,m/m");
  road.notes.push_back(fmt::format(
      "The slope of {} leads to a height at the end that differs by {:.3g} m from "
      "REFERENCE_LINE_END_Z; the difference is spread over the line, as OpenCRG does it.",
      road.file, line.end_gap));
}

void note_ignored(const CrgDefinition& definition, const CrgHeader& header, Road& road) {
  for (const CrgChannel& channel : definition.channels)
    if (channel.column == CrgColumn::ignored && road.notes.size() < 10)
      road.notes.push_back(fmt::format("The channel \"{}\" of {} is not used.",
                                       shown_part(channel.text), road.file));
  for (const CrgBlock& block : header.blocks)
    if (!block.name.starts_with("ROAD_CRG") && block.name != "CT" &&
        block.name != "KD_DEFINITION" && road.notes.size() < 10)
      road.notes.push_back(
          fmt::format("The block ${} of {} is not used.", shown_part(block.name), road.file));
}

/// The rows, the sections and the reference line as the file has them.
Road road_as_in_file(Chain& chain, const CrgDefinition& definition, CrgSections sections,
                     const CrgValues& values) {
  Road road;
  road.file = chain.file.path.string();
  road.format = definition.format.name;
  road.u_step = crg_increment(values);
  road.u_first = values.real_or("REFERENCE_LINE_START_U", 0.0);
  const CrgDataPlan plan = plan_of(chain.file, definition, values);
  CrgColumns columns = read_columns_of(chain.file, definition, sections, plan);
  if (columns.slope.empty())
    columns.slope = {crg_constant(values, "REFERENCE_LINE_START_S", "REFERENCE_LINE_END_S")};
  if (columns.banking.empty())
    columns.banking = {crg_constant(values, "REFERENCE_LINE_START_B", "REFERENCE_LINE_END_B")};
  if (columns.heading.empty()) columns.heading = {values.real_or("REFERENCE_LINE_START_PHI", 0.0)};
  road.v = std::move(sections.v);
  road.heights = std::move(columns.heights);
  road.slope = std::move(columns.slope);
  road.banking = std::move(columns.banking);
  road.heading = std::move(columns.heading);
  if (!columns.position.empty()) set_rows_by_channel(columns.position, road);
  return road;
}

/// Numbers that no road has would lose digits, or overflow. Modifiers are applied by now.
void demand_plausible(const Road& road) {
  constexpr double far = 1e9, high = 1e6, wide = 1e6, shortest = 1e-6, longest = 1e6;  // [m]
  const auto within = [](const std::vector<double>& values, double bound) {
    return std::ranges::all_of(values, [&](double x) { return !(std::abs(x) > bound); });
  };
  double narrowest = road.v[1] - road.v[0];
  for (std::size_t j = 1; j + 1 < road.n_v(); ++j)
    narrowest = std::min(narrowest, road.v[j + 1] - road.v[j]);
  const bool along = std::abs(road.u_first) <= far && std::abs(road.u_last()) <= far &&
                     road.u_step >= shortest && road.u_step <= longest;
  const bool across = within(road.v, wide) && narrowest >= shortest;
  const bool heights =
      within(road.heights, high) && within(road.line_height, high) && within(road.banking, 1.0) &&
      within({road.missing_offset, road.edges.offset_u, road.edges.offset_v}, high);
  if (!along || !across || !heights)
    throw FileError(
        road.file,
        fmt::format("with its modifiers and options, the road goes from u = {:g} to {:g} m in "
                    "steps of {:g} m, from v = {:g} to {:g} m, and its {}; rondo takes u to "
                    "1e9 m, v and heights to 1e6 m, banking to 1 and steps from 1e-6 to 1e6 m",
                    road.u_first, road.u_last(), road.u_step, road.v.front(), road.v.back(),
                    heights ? "heights are in range" : "heights or banking are not in range"));
}

}  // namespace

Road read_crg(const std::filesystem::path& file) {
  Chain chain = follow_references(file);
  demand_data(chain.file);
  const CrgValues values = read_road_block(chain.file.header);
  const CrgDefinition definition = read_crg_definition(chain.file.header);
  Road road = road_as_in_file(chain, definition, crg_sections(definition, values), values);
  road.edges = crg_edges(chain.options);
  road.notes = std::move(chain.notes);
  note_ignored(definition, chain.file.header, road);
  const CrgScales scales = crg_scales(chain.modifiers);
  scale_road(scales, road);
  set_missing(chain.modifiers, chain.has_modifiers, road);
  set_line(values, scales, road);
  demand_plausible(road);
  shift_road(chain.modifiers, road);
  demand_plausible(road);
  return road;
}

}  // namespace rondo::road
