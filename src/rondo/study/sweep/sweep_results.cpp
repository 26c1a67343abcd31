// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_results.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "rondo/case/case_keys.hpp"
#include "rondo/core/column.hpp"
#include "rondo/io/axes_tables.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemberRow, status, code, message, kept, steps, end_time, figures,
                                   wall_s)

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A field of a CSV file.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string said(1, '"');
  for (const char c : text) said.append(c == '"' ? 2 : 1, c);
  said.push_back('"');
  return said;
}

/// A string of TOML without its quotes.
std::string plain(const std::string& toml) {
  return toml.size() >= 2 && toml.front() == '"' ? toml.substr(1, toml.size() - 2) : toml;
}

std::string number_text(double value) {
  return std::isnan(value) ? "nan" : fmt::format("{}", value);
}

std::string header(const SweepTables& t) {
  std::string text = "run";
  for (const Vary& vary : t.study.parameters) text += fmt::format(",{}", vary.key);
  text += ",status,steps,end_time_s";
  for (const ColumnLabel& column : figure_labels(t.plan)) text += fmt::format(",{}", column.name);
  text.push_back('\n');
  return text;
}

std::string line_of(const SweepTables& t, std::size_t m, std::size_t n_figures) {
  const PlannedMember& member = t.plan.members[m];
  const MemberRow& row = t.rows[m];
  std::string text = fmt::format("{}", m + 1);
  for (const std::string& value : member.member.values)
    text += fmt::format(",{}", quoted(plain(value)));
  text += fmt::format(",{},{},{}", name_of(row.status), row.steps, row.end_time);
  for (std::size_t k = 0; k < n_figures; ++k)
    text += fmt::format(",{}", number_text(row.figures.empty() ? none : row.figures[k]));
  text.push_back('\n');
  return text;
}

/// The number that the whole text represents; NaN: it is not a number.
double number_of(const std::string& text) {
  double value = none;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : none;
}

void write_column(io::h5::File& file, const std::string& name, const std::vector<double>& values,
                  const io::h5::Label& label) {
  file.write<double>(name, {values.size()}, values, label);
}

std::string unit_of_varied(const Vary& vary, bool is_solid) {
  const CaseKey* key = find_case_key(vary.key);
  return key && key->unit != "-" ? std::string(rondo::unit_of(key->unit, is_solid)) : "1";
}

/// Writes numbers; for texts and tables, the index in the list that the attribute `values` has.
void write_parameter(io::h5::File& file, const SweepTables& t, std::size_t k) {
  const Vary& vary = t.study.parameters[k];
  std::vector<double> values;
  for (const PlannedMember& member : t.plan.members)
    values.push_back(number_of(member.member.values[k]));
  const std::string name = "/parameters/" + vary.key;
  const bool numbers = std::ranges::none_of(values, [](double value) { return std::isnan(value); });
  if (numbers)
    return write_column(file, name, values,
                        {unit_of_varied(vary, t.plan.is_solid), "key of the case file"});
  std::map<std::string, std::size_t> places;
  std::string list;
  for (std::size_t m = 0; m < values.size(); ++m) {
    const std::string& text = t.plan.members[m].member.values[k];
    const auto [place, is_new] = places.try_emplace(text, places.size());
    if (is_new) list += plain(text) + '\n';
    values[m] = static_cast<double>(place->second);
  }
  write_column(file, name, values, {"1", "key of the case file; place in the attribute values"});
  file.set_attribute(name, "values", list);
}

void write_h5(const std::filesystem::path& path, const SweepTables& t) {
  const io::UnfinishedFile beside(path.string() + ".new");
  io::h5::File file = io::h5::File::create(beside.path);
  file.set_attribute("/", "title", t.study.title);
  for (std::size_t k = 0; k < t.study.parameters.size(); ++k) write_parameter(file, t, k);
  std::vector<double> status, steps, end_time;
  for (const MemberRow& row : t.rows) {
    status.push_back(static_cast<double>(row.status));
    steps.push_back(static_cast<double>(row.steps));
    end_time.push_back(row.end_time);
  }
  write_column(file, "/status", status, {"1", "0 waiting, 1 done, 2 failed, 3 interrupted"});
  write_column(file, "/steps", steps, {"1", "steps or increments done"});
  write_column(file, "/end_time", end_time, {"s", "reached"});
  const std::vector<ColumnLabel> columns = figure_labels(t.plan);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::vector<double> values;
    for (const MemberRow& row : t.rows)
      values.push_back(row.figures.empty() ? none : row.figures[k]);
    write_column(file, fmt::format("/figures/{}", columns[k].name), values,
                 {columns[k].unit, columns[k].meaning});
  }
  file.close();
  io::replace_file(beside.path, path);
}

}  // namespace

const char* name_of(MemberStatus status) noexcept {
  static constexpr std::array names{"waiting", "done", "failed", "interrupted"};
  return names[static_cast<std::size_t>(status)];
}

std::string packed(const MemberRow& row) {
  const std::vector<std::uint8_t> bytes =
      nlohmann::json::to_cbor(row);  // supports NaN, unlike JSON
  return {bytes.begin(), bytes.end()};
}

MemberRow unpacked(const std::string& text) {
  return nlohmann::json::from_cbor(text).get<MemberRow>();
}

void write_tables(const std::filesystem::path& directory, const SweepTables& t) {
  const std::size_t n_figures = figure_labels(t.plan).size();
  std::string table = header(t), timings = "run,worker,wall_s\n";
  for (std::size_t m = 0; m < t.rows.size(); ++m) {
    table += line_of(t, m, n_figures);
    timings += fmt::format("{},{},{:.6f}\n", m + 1, t.rows[m].worker + 1, t.rows[m].wall_s);
  }
  io::remove_axes_tables(directory, "results");
  io::write_file(directory / "results.csv", table);
  io::write_file(directory / "timings.csv", timings);
  write_h5(directory / "sweep.h5", t);
}

}  // namespace rondo::study
