// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/chosen_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "rondo/analysis/figures/window_rows.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/csv.hpp"

namespace rondo::study {
namespace {

struct Word {
  Statistic statistic;
  const char *ending, *meaning;
};

constexpr std::array words{
    Word{Statistic::mean, "mean", "mean"}, Word{Statistic::min, "min", "least value"},
    Word{Statistic::max, "max", "largest value"}, Word{Statistic::last, "last", "last value"}};

const ColumnLabel& find_column(const std::string& name, std::span<const ColumnLabel> history,
                               const std::filesystem::path& file) {
  const auto found = std::ranges::find(history, name, &ColumnLabel::name);
  if (found != history.end()) return *found;
  std::string names;
  for (const ColumnLabel& label : history)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", label.name);
  throw InputError(Fault{file.string(), 0, 0, "columns", "",
                         fmt::format("\"{}\" is no column of history.csv of these runs", name),
                         "of " + names});
}

double statistic_of(const Intervals& f, Statistic statistic) {
  switch (statistic) {
    case Statistic::mean:
      return mean(f);
    case Statistic::min:
      return *std::ranges::min_element(f.value);
    case Statistic::max:
      return *std::ranges::max_element(f.value);
    case Statistic::last:
      break;
  }
  return f.value.back();
}

}  // namespace

std::vector<ChosenFigure> choose_figures(std::span<const std::string> names,
                                         std::span<const ColumnLabel> history,
                                         const FigureTable& table,
                                         const std::filesystem::path& file) {
  std::vector<ChosenFigure> chosen;
  for (const std::string& name : names) {
    const ColumnLabel& column = find_column(name, history, file);
    for (const Word& word : words) {
      if (word.statistic == Statistic::mean && !table.has_window) continue;
      const std::string figure = fmt::format("{}_{}", name, word.ending);
      if (std::ranges::find(table.columns, figure, &FigureColumn::name) != table.columns.end())
        continue;
      const char* const where = table.has_window ? "over the window" : "of all rows";
      chosen.push_back({name,
                        word.statistic,
                        {figure, column.unit,
                         fmt::format("{} {} of {} of history.csv", word.meaning, where, name)}});
    }
  }
  return chosen;
}

std::vector<double> values_of(std::span<const ChosenFigure> figures,
                              const std::filesystem::path& directory, const Window& window,
                              bool has_window) {
  std::vector<double> values;
  if (figures.empty()) return values;
  if (has_window) {
    const WindowRows rows(directory, window);
    for (const ChosenFigure& figure : figures)
      values.push_back(statistic_of(rows.of(figure.column), figure.statistic));
    return values;
  }
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  for (const ChosenFigure& figure : figures)
    values.push_back(
        statistic_of({{}, {}, column(history, figure.column, file)}, figure.statistic));
  return values;
}

}  // namespace rondo::study
