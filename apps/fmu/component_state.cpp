// SPDX-License-Identifier: BSD-3-Clause
/// @file  Saved states of an instance and their bytes; registry of existing instances and states.
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "component.hpp"
#include "rondo/fmu/saved_bytes.hpp"

namespace rondo::fmu {
namespace {

constexpr const char* no_state = "this is no state of this instance, or it is freed";

/// Existing instances and states; an importer may pass pointers that it has freed.
struct Alive {
  std::mutex mutex;
  std::set<const void*> instances;
  std::map<const void*, const void*> states;  ///< each state and its instance
};

Alive& alive() {
  static Alive pointers;
  return pointers;
}

bool is_state(const void* pointer, const void* instance) noexcept {
  const std::lock_guard<std::mutex> lock(alive().mutex);
  const auto found = alive().states.find(pointer);
  return found != alive().states.end() && found->second == instance;
}

}  // namespace

Component* living(fmi2Component c) noexcept {
  const std::lock_guard<std::mutex> lock(alive().mutex);
  return alive().instances.count(c) > 0 ? static_cast<Component*>(c) : nullptr;
}

fmi2Component enroll(std::unique_ptr<Component> component) {
  const std::lock_guard<std::mutex> lock(alive().mutex);
  alive().instances.insert(component.get());
  return component.release();
}

void dismiss(fmi2Component c) noexcept {
  std::size_t erased = 0;
  {
    const std::lock_guard<std::mutex> lock(alive().mutex);
    erased = alive().instances.erase(c);
  }
  if (erased > 0) delete static_cast<Component*>(c);
}

/// Also frees states that the importer has not freed: another instance may get the same address.
Component::~Component() {
  const std::lock_guard<std::mutex> lock(alive().mutex);
  std::erase_if(alive().states, [this](const auto& of) {
    if (of.second == this) delete static_cast<const State*>(of.first);
    return of.second == this;
  });
}

/// Replaces an existing state, as the standard requires.
fmi2Status Component::hand_over(std::unique_ptr<State> saved, fmi2FMUstate* state) {
  {
    const std::lock_guard<std::mutex> lock(alive().mutex);
    alive().states.emplace(saved.get(), this);
  }
  if (*state != nullptr) static_cast<void>(free(state));
  *state = saved.release();
  return fmi2OK;
}

/// What is wrong with the destination of a state.
const char* Component::no_place_for_state(const fmi2FMUstate* state) const noexcept {
  if (state == nullptr) return "the pointer to the state is NULL";
  if (*state != nullptr && !is_state(*state, this))
    return "the state to be replaced is none of this instance, or is freed; NULL for a new one";
  return nullptr;
}

fmi2Status Component::save(fmi2FMUstate* state) {
  if (const char* wrong = no_place_for_state(state))
    return error(std::string("fmi2GetFMUstate: ") + wrong);
  auto saved = std::make_unique<State>();
  saved->stale = stale_;
  saved->phase = phase_;
  saved->time = time_;
  if (stale_)
    saved->wheel.values = values_;
  else
    saved->wheel = wheel_->save(values_);
  return hand_over(std::move(saved), state);
}

fmi2Status Component::restore(fmi2FMUstate state) {
  if (!is_state(state, this)) return error(std::string("fmi2SetFMUstate: ") + no_state);
  const State& saved = *static_cast<const State*>(state);
  phase_ = Phase::failed;  // remains if an exception is thrown
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

fmi2Status Component::free(fmi2FMUstate* state) noexcept {
  if (state == nullptr || *state == nullptr) return fmi2OK;
  {
    const std::lock_guard<std::mutex> lock(alive().mutex);
    const auto found = alive().states.find(*state);
    if (found == alive().states.end() || found->second != this) return fmi2Error;
    alive().states.erase(found);
  }
  delete static_cast<State*>(*state);
  *state = nullptr;
  return fmi2OK;
}

namespace {

/// Data before those of the wheel.
struct Head {
  double time;
  int phase, stale;
};

}  // namespace

fmi2Status Component::serialized_size(fmi2FMUstate state, std::size_t* n) {
  if (!is_state(state, this)) return error(std::string("fmi2SerializedFMUstateSize: ") + no_state);
  if (n == nullptr) return error("fmi2SerializedFMUstateSize: the pointer to the size is NULL");
  *n = sizeof(Head) + bytes_of(static_cast<const State*>(state)->wheel, guid_).size() +
       fmu::hash_size;
  return fmi2OK;
}

fmi2Status Component::serialize(fmi2FMUstate state, char* bytes, std::size_t n) {
  if (!is_state(state, this)) return error(std::string("fmi2SerializeFMUstate: ") + no_state);
  if (bytes == nullptr) return error("fmi2SerializeFMUstate: the pointer to the bytes is NULL");
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
  if (bytes == nullptr) return error("fmi2DeSerializeFMUstate: the pointer to the bytes is NULL");
  if (const char* wrong = no_place_for_state(state))
    return error(std::string("fmi2DeSerializeFMUstate: ") + wrong);
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
  return hand_over(std::move(saved), state);
}

}  // namespace rondo::fmu
