// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "rondo/study/options/options.hpp"

namespace rondo::study {
namespace {

/// The default, if a value is one.
struct DefaultText {
  std::string operator()(const bool* /*flag*/) const { return {}; }
  std::string operator()(const int* n) const { return *n == 0 ? "" : fmt::format("{}", *n); }
  std::string operator()(const double* x) const { return fmt::format("{}", *x); }
  std::string operator()(const std::string* text) const { return *text; }
  std::string operator()(const std::filesystem::path* path) const { return path->string(); }
  template <class T>
  std::string operator()(const T* /*none*/) const {
    return {};
  }
};

/// The annotation of an argument, with its default.
struct PythonType {
  std::string operator()(const bool* flag) const { return *flag ? "bool = True" : "bool = False"; }
  std::string operator()(const int* /*n*/) const { return "int | None = None"; }
  std::string operator()(const std::optional<long long>* /*n*/) const {
    return "int | None = None";
  }
  std::string operator()(const double* /*x*/) const { return "float | None = None"; }
  std::string operator()(const std::optional<double>* /*x*/) const { return "float | None = None"; }
  std::string operator()(const std::string* /*text*/) const { return "str | None = None"; }
  std::string operator()(const std::filesystem::path* /*path*/) const {
    return "Place | None = None";
  }
  std::string operator()(const std::vector<double>* /*list*/) const {
    return "Sequence[float] | None = None";
  }
};

std::string python_row(const Option& o) {
  std::string help = help_text(o, o.in_python.empty() ? o.help : o.in_python);
  if (const std::string standard = default_text(o); !standard.empty())
    help += fmt::format("; default {}", standard);
  if (o.range) help += fmt::format("; {} to {}", o.range->low, o.range->high);
  return fmt::format("        \"{}\": (\"{}\",\n            \"{}\"),\n", o.python,
                     std::visit(PythonType{}, o.target), help);
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
  return std::visit(DefaultText{}, option.target);
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
  return "# SPDX-License-Identifier: BSD-3-Clause\n"
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
