// SPDX-License-Identifier: BSD-3-Clause
#include "component.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/fmu/saved_bytes.hpp"

namespace rondo::fmu {
namespace {

/// "file:///a%20b" or "file:/a" or "file://localhost/a" to "/a b".
std::filesystem::path folder_of(const std::string& uri) {
  std::string text = uri;
  if (text.rfind("file:", 0) == 0) text = text.substr(5);
  if (text.rfind("//", 0) == 0) text = text.substr(std::min(text.size(), text.find('/', 2)));
  std::string path;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool coded = text[k] == '%' && k + 2 < text.size();
    path += coded ? static_cast<char>(std::stoi(text.substr(k + 1, 2), nullptr, 16)) : text[k];
    if (coded) k += 2;
  }
  return path;
}

nlohmann::json read_settings(const std::filesystem::path& file) {
  demand_regular_file(file);
  std::ifstream in(file);
  nlohmann::json settings = nlohmann::json::parse(in, nullptr, false);
  if (settings.is_object()) return settings;
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
  guid_ = settings.value("guid", "");
  if (guid != guid_) throw request_error("fmuGUID", guid, "is not that of this FMU", guid_);
  study::Case c = study::read_case(folder / "case.toml");
  start_ = start_values(c, settings.value("step", 0.0));
  values_ = start_;
  wheel_ = std::make_unique<Wheel>(std::move(c), folder / "model.h5",
                                   settings.value("step_factor", 20.0));
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

fmi2Status Component::setup(double start) {
  if (phase_ != Phase::instantiated) return error("fmi2SetupExperiment: initialisation is over");
  if (!std::isfinite(start)) return error("fmi2SetupExperiment: startTime is not a number");
  time_ = start;
  return fmi2OK;
}

fmi2Status Component::set_logging(bool on, std::size_t n, const fmi2String* categories) {
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
  return fmi2OK;
}

fmi2Status Component::get(const fmi2ValueReference* references, std::size_t n, double* values) {
  for (std::size_t k = 0; k < n; ++k)
    if (references[k] >= variables().size())
      return error(fmt::format("fmi2GetReal: there is no value reference {}; 0 to {}",
                               references[k], variables().size() - 1));
  if (phase_ == Phase::instantiated)
    for (std::size_t k = 0; k < n; ++k) {
      const Variable& v = variables()[references[k]];
      if (v.kind == Kind::output || v.kind == Kind::calculated)
        return error(
            fmt::format("fmi2GetReal: {} is computed: fmi2EnterInitializationMode before", v.name));
    }
  const bool computed = phase_ == Phase::initializing;
  if (computed) refresh();
  for (std::size_t k = 0; k < n; ++k) values[k] = values_.*variables()[references[k]].value;
  return computed ? tell_warnings() : fmi2OK;
}

/// All or none.
fmi2Status Component::set(const fmi2ValueReference* references, std::size_t n,
                          const double* values) {
  const bool before = phase_ == Phase::instantiated || phase_ == Phase::initializing;
  for (std::size_t k = 0; k < n; ++k) {
    if (references[k] >= variables().size())
      return error(fmt::format("fmi2SetReal: there is no value reference {}; 0 to {}",
                               references[k], variables().size() - 1));
    const Variable& v = variables()[references[k]];
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
  for (std::size_t k = 0; k < n; ++k) values_.*variables()[references[k]].value = values[k];
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
  // Importers take lengths as differences of times.
  const double slack = 8.0 * std::numeric_limits<double>::epsilon() * (std::abs(at) + length);
  if (const std::string wrong = wheel_->refuse(values_, length, slack); !wrong.empty())
    return error("fmi2DoStep: " + wrong);
  phase_ = Phase::failed;  // what throws half way stays so
  const std::string wrong = wheel_->go_on(values_, length);
  if (!wrong.empty()) return fail("fmi2DoStep: " + wrong);
  phase_ = Phase::stepping;
  time_ = at + length;
  return tell_warnings();
}

fmi2Status Component::save(fmi2FMUstate* state) {
  auto saved = std::make_unique<State>();
  saved->stale = stale_;
  saved->phase = phase_;
  saved->time = time_;
  if (stale_)
    saved->wheel.values = values_;
  else
    saved->wheel = wheel_->save(values_);
  delete static_cast<State*>(*state);
  *state = saved.release();
  return fmi2OK;
}

fmi2Status Component::restore(fmi2FMUstate state) {
  const State& saved = *static_cast<const State*>(state);
  phase_ = Phase::failed;  // what throws half way stays so
  if (saved.stale)
    values_ = saved.wheel.values;
  else
    wheel_->restore(saved.wheel, values_);
  stale_ = saved.stale;
  phase_ = saved.phase;
  time_ = saved.time;
  static_cast<void>(wheel_->take_warnings());
  return fmi2OK;
}

void Component::free(fmi2FMUstate* state) noexcept {
  delete static_cast<State*>(*state);
  *state = nullptr;
}

namespace {

/// What precedes the wheel.
struct Head {
  double time;
  int phase, stale;
};

}  // namespace

fmi2Status Component::serialized_size(fmi2FMUstate state, std::size_t* n) {
  *n = sizeof(Head) + bytes_of(static_cast<const State*>(state)->wheel, guid_).size() +
       fmu::hash_size;
  return fmi2OK;
}

fmi2Status Component::serialize(fmi2FMUstate state, char* bytes, std::size_t n) {
  const State& saved = *static_cast<const State*>(state);
  const std::vector<char> wheel = bytes_of(saved.wheel, guid_);
  const std::size_t hashed = sizeof(Head) + wheel.size();
  if (n < hashed + fmu::hash_size)
    return error("fmi2SerializeFMUstate: fewer bytes than fmi2SerializedFMUstateSize has told");
  const Head head{saved.time, static_cast<int>(saved.phase), saved.stale ? 1 : 0};
  std::memcpy(bytes, &head, sizeof head);
  std::memcpy(bytes + sizeof head, wheel.data(), wheel.size());
  std::memcpy(bytes + hashed, fmu::hash_of({bytes, hashed}).data(), fmu::hash_size);
  return fmi2OK;
}

fmi2Status Component::deserialize(const char* bytes, std::size_t n, fmi2FMUstate* state) {
  Head head{};
  const char* const refused =
      "fmi2DeSerializeFMUstate: these bytes are no state of this FMU, or damaged";
  if (n < sizeof head + fmu::hash_size) return error(refused);
  const std::size_t hashed = n - fmu::hash_size;
  if (fmu::hash_of({bytes, hashed}) != std::string(bytes + hashed, fmu::hash_size))
    return error(refused);
  std::memcpy(&head, bytes, sizeof head);
  const bool known = head.phase >= 0 && head.phase <= static_cast<int>(Phase::failed);
  if (!known || (head.stale != 0 && head.phase > static_cast<int>(Phase::initializing)))
    return error(refused);
  auto saved = std::make_unique<State>();
  saved->wheel = saved_of({bytes + sizeof head, hashed - sizeof head}, guid_);
  saved->time = head.time;
  saved->phase = static_cast<Phase>(head.phase);
  saved->stale = head.stale != 0;
  delete static_cast<State*>(*state);
  *state = saved.release();
  return fmi2OK;
}

}  // namespace rondo::fmu
