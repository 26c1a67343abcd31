// SPDX-License-Identifier: BSD-3-Clause
#include "component.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "location.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"

namespace rondo::fmu {
namespace {

nlohmann::json read_settings(const std::filesystem::path& file) {
  demand_regular_file(file);
  std::ifstream in(file);
  nlohmann::json settings = nlohmann::json::parse(in, nullptr, false);
  if (settings.is_object() && settings["guid"].is_string() && settings["step"].is_number() &&
      settings["modes"].is_number_integer() && settings["reduced_step"].is_number())
    return settings;
  throw FileError(file.string(),
                  "is not there or damaged: fmuResourceLocation must be the folder "
                  "\"resources\" of the unpacked FMU");
}

}  // namespace

Component::Component(const std::string& name, const std::string& resources, const std::string& guid,
                     const fmi2CallbackFunctions& callbacks, bool logs)
    : name_(name), callbacks_(callbacks), logs_(logs) {
  const std::filesystem::path folder = folder_of(resources);
  const nlohmann::json settings = read_settings(folder / "wheel.json");
  guid_ = settings["guid"];
  if (guid != guid_) throw request_error("fmuGUID", guid, "is not that of this FMU", guid_);
  study::Case c = study::read_case(folder / "case.toml");
  start_ = start_values(c, settings["step"]);
  variables_ = variables(dimension_of(c));
  values_ = start_;
  study::RunOptions options;
  options.reduced_modes = settings["modes"];
  options.reduced_step = settings["reduced_step"];
  wheel_ = std::make_unique<Wheel>(std::move(c), options);
  wheel_->check();
}

void Component::log(fmi2Status status, const char* category, const std::string& message) {
  const bool wanted =
      status == fmi2Error || (logs_ && (categories_.empty() || categories_.count(category) > 0));
  if (callbacks_.logger == nullptr || !wanted) return;
  callbacks_.logger(callbacks_.componentEnvironment, name_.c_str(), status, category, "%s",
                    message.c_str());
}

fmi2Status Component::error(const std::string& message) {
  log(fmi2Error, "logStatusError", message);
  return fmi2Error;
}

fmi2Status Component::warning(const std::string& message) {
  log(fmi2Warning, "logStatusWarning", message);
  return fmi2Warning;
}

fmi2Status Component::fail(const std::string& message) {
  phase_ = Phase::failed;
  return error(message);
}

fmi2Status Component::tell_warnings() {
  fmi2Status status = fmi2OK;
  for (const std::string& text : wheel_->take_warnings()) status = warning(text);
  return status;
}

fmi2Status Component::setup(double start, double stop) {
  if (phase_ != Phase::instantiated) return error("fmi2SetupExperiment: initialisation is over");
  if (!std::isfinite(start)) return error("fmi2SetupExperiment: startTime is not a number");
  if (!(stop > start))
    return error(
        fmt::format("fmi2SetupExperiment: stopTime = {:.9g} s: must be after startTime, "
                    "{:.9g} s",
                    stop, start));
  time_ = start;
  stop_ = stop;
  return fmi2OK;
}

fmi2Status Component::set_logging(bool on, std::size_t n, const fmi2String* categories) {
  for (std::size_t k = 0; k < n; ++k)
    if (categories == nullptr || categories[k] == nullptr)
      return error("fmi2SetDebugLogging: a category is NULL");
  logs_ = on;
  categories_.clear();
  for (std::size_t k = 0; k < n; ++k) categories_.insert(categories[k]);
  return fmi2OK;
}

fmi2Status Component::enter_initialization() {
  if (phase_ != Phase::instantiated)
    return error("fmi2EnterInitializationMode: it is initialised already; fmi2Reset before");
  phase_ = Phase::initializing;
  return fmi2OK;
}

void Component::refresh() {
  if (!stale_) return;
  wheel_->begin(values_);
  stale_ = false;
}

fmi2Status Component::exit_initialization() {
  if (phase_ != Phase::initializing)
    return error("fmi2ExitInitializationMode: fmi2EnterInitializationMode comes before");
  refresh();
  phase_ = Phase::stepping;
  return tell_warnings();
}

fmi2Status Component::terminate() {
  if (phase_ != Phase::stepping) return error("fmi2Terminate: it is not stepping");
  phase_ = Phase::terminated;
  return fmi2OK;
}

fmi2Status Component::reset() {
  values_ = start_;
  wheel_->forget_warnings();
  phase_ = Phase::instantiated;
  stale_ = true;
  time_ = 0.0;
  stop_ = std::numeric_limits<double>::infinity();
  return fmi2OK;
}

fmi2Status Component::get(const fmi2ValueReference* references, std::size_t n, double* values) {
  if (n > 0 && (references == nullptr || values == nullptr))
    return error("fmi2GetReal: the value references or the values are NULL");
  for (std::size_t k = 0; k < n; ++k)
    if (references[k] >= variables_.size())
      return error(fmt::format("fmi2GetReal: there is no value reference {}; 0 to {}",
                               references[k], variables_.size() - 1));
  if (phase_ == Phase::instantiated)
    for (std::size_t k = 0; k < n; ++k) {
      const Variable& v = variables_[references[k]];
      if (v.kind == Kind::output || v.kind == Kind::calculated)
        return error(
            fmt::format("fmi2GetReal: {} is computed: fmi2EnterInitializationMode before", v.name));
    }
  const bool computed = phase_ == Phase::initializing;
  if (computed) refresh();
  for (std::size_t k = 0; k < n; ++k) values[k] = values_.*variables_[references[k]].value;
  return computed ? tell_warnings() : fmi2OK;
}

/// Sets all values or none.
fmi2Status Component::set(const fmi2ValueReference* references, std::size_t n,
                          const double* values) {
  if (n > 0 && (references == nullptr || values == nullptr))
    return error("fmi2SetReal: the value references or the values are NULL");
  const bool before = phase_ == Phase::instantiated || phase_ == Phase::initializing;
  for (std::size_t k = 0; k < n; ++k) {
    if (references[k] >= variables_.size())
      return error(fmt::format("fmi2SetReal: there is no value reference {}; 0 to {}",
                               references[k], variables_.size() - 1));
    const Variable& v = variables_[references[k]];
    if (v.kind == Kind::output || v.kind == Kind::calculated)
      return error(fmt::format("fmi2SetReal: {} is computed, and not to be set", v.name));
    if (v.kind == Kind::parameter && !before)
      return error(
          fmt::format("fmi2SetReal: {} stays after initialisation; fmi2Reset before", v.name));
    if (!before && phase_ != Phase::stepping)
      return error(fmt::format("fmi2SetReal: {}: it has ended; fmi2Reset before", v.name));
    if (const std::string wrong = refusal(v, values[k]); !wrong.empty())
      return error("fmi2SetReal: " + wrong);
  }
  for (std::size_t k = 0; k < n; ++k) values_.*variables_[references[k]].value = values[k];
  if (before) stale_ = true;
  return fmi2OK;
}

fmi2Status Component::step(double at, double length) {
  if (phase_ != Phase::stepping)
    return error(phase_ == Phase::failed
                     ? "fmi2DoStep: it has failed; fmi2Reset or fmi2SetFMUstate before"
                     : "fmi2DoStep: fmi2ExitInitializationMode comes before, fmi2Terminate after");
  const double away = std::abs(at - time_);
  if (!(away <= 1e-9 * (std::abs(time_) + std::abs(length))))
    return error(
        fmt::format("fmi2DoStep: the communication point is {:.9g} s, and the wheel is at "
                    "{:.9g} s",
                    at, time_));
  // Importers compute lengths as differences of times.
  const double slack = 8.0 * std::numeric_limits<double>::epsilon() * (std::abs(at) + length);
  if (at + length > stop_ + slack)
    return error(fmt::format("fmi2DoStep: it would end at {:.9g} s, after the stopTime of {:.9g} s",
                             at + length, stop_));
  if (const std::string wrong = wheel_->refuse(values_, length, slack); !wrong.empty())
    return error("fmi2DoStep: " + wrong);
  phase_ = Phase::failed;  // remains if an exception is thrown
  const std::string wrong = wheel_->go_on(values_, length);
  if (!wrong.empty()) return fail("fmi2DoStep: " + wrong);
  phase_ = Phase::stepping;
  time_ = at + length;
  return tell_warnings();
}

}  // namespace rondo::fmu
