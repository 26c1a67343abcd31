// SPDX-License-Identifier: BSD-3-Clause
/// Columns of a CSV file, as `rondo sweep` reads history.csv.
#include <cmath>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/io/csv.hpp"

using namespace rondo;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = fuzz::scratch_folder() / "history.csv";
  fuzz::put(file, fuzz::view(data, size));
  std::map<std::string, std::vector<double>, std::less<>> columns;
  if (!fuzz::accepted([&] { columns = io::read_columns(file); })) return 0;
  fuzz::check(!columns.empty(), "columns without a column");
  std::vector<std::string> names;
  std::vector<double> rows;
  for (const auto& [name, values] : columns) {
    names.push_back(name);
    fuzz::check(values.size() == columns.begin()->second.size(), "columns of different lengths");
  }
  const std::size_t n = columns.begin()->second.size();
  for (std::size_t i = 0; i < n; ++i)
    for (const auto& [name, values] : columns) rows.push_back(values[i]);
  // What was read is written and read again to the same numbers.
  io::Csv csv(file, names);
  csv.rows(rows);
  csv.close();
  // Its place is that of these bytes and of no others.
  const io::CsvPlace place = csv.place();
  const std::string written = fuzz::text_of(file);
  io::demand_kept(file, place);
  fuzz::put(file, fuzz::view(data, size));
  const bool same = fuzz::view(data, size).starts_with(written);
  fuzz::check(fuzz::accepted([&] { io::demand_kept(file, place); }) == same,
              "other bytes are taken for those that were written");
  fuzz::put(file, written);
  const auto again = io::read_columns(file);
  for (const auto& [name, values] : columns)
    for (std::size_t i = 0; i < n; ++i) {
      const double a = values[i], b = again.at(name).at(i);
      fuzz::check(a == b || (std::isnan(a) && std::isnan(b)), "another number after writing");
    }
  return 0;
}
