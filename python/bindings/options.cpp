// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>

#include "rondo/core/error.hpp"

namespace rondo::python {
namespace {

std::string wanted(const study::Option& option) {
  return std::visit(
      [](const auto* target) -> std::string {
        using T = std::remove_cvref_t<decltype(*target)>;
        if constexpr (std::is_same_v<T, bool>) return "True or False";
        if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::optional<long long>>)
          return "a whole number";
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>)
          return "a number";
        if constexpr (std::is_same_v<T, std::vector<double>>) return "a list of numbers";
        return "a text";
      },
      option.target);
}

void take(const py::dict& given, const study::Option& option) {
  const std::string name(option.python);
  const py::object value = given[name.c_str()];
  const bool is_switch = std::holds_alternative<bool*>(option.target);
  try {
    if (py::isinstance<py::bool_>(value) && !is_switch) throw py::cast_error();
    std::visit(
        [&](auto* target) { *target = value.cast<std::remove_pointer_t<decltype(target)>>(); },
        option.target);
  } catch (const py::cast_error&) {
    throw request_error(name, py::repr(value), "is of a wrong type", wanted(option));
  }
  if (!option.range) return;
  const int number = *std::get<int*>(option.target);
  if (number < option.range->low || number > option.range->high)
    throw request_error(name, fmt::format("{}", number), "is out of bounds",
                        fmt::format("{} to {}", option.range->low, option.range->high));
}

bool has(const study::Options& options, std::string_view python) {
  for (const study::Option& option : options)
    if (option.python == python) return is_given(option);
  return false;
}

}  // namespace

void take_options(const py::dict& given, const study::Options& options) {
  const auto is_in = [&](const study::Option& o) {
    return !o.python.empty() && given.contains(std::string(o.python).c_str());
  };
  for (const study::Option& option : options)
    if (is_in(option)) take(given, option);
  for (const study::Option& o : options) {
    if (!is_in(o)) continue;
    const std::string name(o.python);
    const auto refuse = [&](const study::OtherOption& other, const std::string& found) {
      throw request_error(name, found, std::string(other.message), std::string(other.allowed));
    };
    if (o.excludes && is_given(o) && has(options, o.excludes->python)) refuse(*o.excludes, "");
    const bool is_off = std::holds_alternative<bool*>(o.target) && !is_given(o);
    if (o.needs && !is_off && !has(options, o.needs->python))
      refuse(*o.needs, py::str(given[name.c_str()]));
  }
}

}  // namespace rondo::python
