// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "rondo/study/options/options.hpp"

namespace rondo::study {
namespace {

/// The annotation of an argument with its default. None means the default of the command.
std::string python_type(const Option& option) {
  return std::visit(
      [](const auto* value) -> std::string {
        using T = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<T, bool>) return *value ? "bool = True" : "bool = False";
        if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::optional<long long>>)
          return "int | None = None";
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>)
          return "float | None = None";
        if constexpr (std::is_same_v<T, std::filesystem::path>) return "Place | None = None";
        if constexpr (std::is_same_v<T, std::vector<double>>)
          return "Sequence[float] | None = None";
        return "str | None = None";
      },
      option.target);
}

std::string python_row(const Option& o) {
  std::string help = help_text(o, o.in_python.empty() ? o.help : o.in_python);
  if (const std::string standard = default_text(o); !standard.empty())
    help += fmt::format("; default {}", standard);
  if (o.range) help += fmt::format("; {} to {}", o.range->low, o.range->high);
  return fmt::format("        \"{}\": (\"{}\", \"{}\"),\n", o.python, python_type(o), help);
}

std::string python_command(const char* name, const Options& options) {
  std::string text = fmt::format("    \"{}\": {{\n", name);
  for (const Option& o : options)
    if (!o.python.empty()) text += python_row(o);
  return text + "    },\n";
}

}  // namespace

std::string help_text(const Option& option, std::string_view help) {
  std::string text(help);
  if (!option.unit.empty())
    text.insert(std::min(text.find(';'), text.size()), fmt::format(" [{}]", option.unit));
  if (!option.choices.empty()) text += fmt::format(": {}", option.choices);
  return text;
}

std::string default_text(const Option& option) {
  if (const auto* n = std::get_if<int*>(&option.target)) return **n == 0 ? "" : std::to_string(**n);
  if (const auto* x = std::get_if<double*>(&option.target)) return fmt::format("{}", **x);
  if (const auto* text = std::get_if<std::string*>(&option.target)) return **text;
  return {};
}

bool is_given(const Option& option) {
  return std::visit(
      [](const auto* value) {
        using T = std::remove_cvref_t<decltype(*value)>;
        if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path> ||
                      std::is_same_v<T, std::vector<double>>)
          return !value->empty();
        else
          return static_cast<bool>(*value);
      },
      option.target);
}

std::string python_options() {
  RunOptions run;
  ModesRequest modes;
  PodRequest pod;
  ReduceRequest reduce;
  SweepRequest sweep;
  FmuRequest fmu;
  return "# SPDX"
         "-License-Identifier: BSD-3-Clause\n"  // split, because this file has its own
         "\"\"\"Keyword arguments of the package's functions that are options of the commands: "
         "type, "
         "default and meaning.\nWritten from the library's table of options "
         "(src/rondo/study/options): RONDO_WRITE_MANUAL=1 ctest -R Manual.\"\"\"\n\n"
         "OPTIONS: dict[str, dict[str, tuple[str, str]]] = {\n" +
         python_command("run", run_options(run)) + python_command("modes", modes_options(modes)) +
         python_command("pod", pod_options(pod)) +
         python_command("reduce", reduce_options(reduce)) +
         python_command("sweep", sweep_options(sweep)) + python_command("fmu", fmu_options(fmu)) +
         "}\n";
}

}  // namespace rondo::study
