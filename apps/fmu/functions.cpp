// SPDX-License-Identifier: BSD-3-Clause
/// @file  Functions exported by the FMU (FMI 2.0.4, 2.1 and 4.2); no exception leaves them.
#include <exception>
#include <limits>
#include <new>

#include "component.hpp"

#define RONDO_EXPORT __attribute__((visibility("default")))

namespace {

using rondo::fmu::Component;

/// Returns fmi2Error for an instance that is null or freed, which cannot log the error.
template <class Work>
fmi2Status guarded(fmi2Component c, const Work& work) noexcept {
  Component* const instance = rondo::fmu::living(c);
  if (instance == nullptr) return fmi2Error;
  try {
    return work(*instance);
  } catch (const std::bad_alloc&) {
    return fmi2Fatal;
  } catch (const std::exception& e) {
    try {
      return instance->error(e.what());
    } catch (...) {
      return fmi2Error;
    }
  } catch (...) {
    return fmi2Fatal;
  }
}

/// For types other than real, of which there are no variables.
fmi2Status none_of(fmi2Component c, const char* function, std::size_t n) noexcept {
  return guarded(c, [&](Component& k) {
    return n == 0 ? fmi2OK : k.error(std::string(function) + ": all variables are real");
  });
}

}  // namespace

extern "C" {

RONDO_EXPORT const char* fmi2GetTypesPlatform() {
  return "default";
}

RONDO_EXPORT const char* fmi2GetVersion() {
  return "2.0";
}

RONDO_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                           fmi2String resources,
                                           const fmi2CallbackFunctions* callbacks,
                                           fmi2Boolean /*visible*/, fmi2Boolean logging) {
  const auto say = [&](const char* text) {
    if (callbacks != nullptr && callbacks->logger != nullptr)
      callbacks->logger(callbacks->componentEnvironment, name != nullptr ? name : "", fmi2Error,
                        "logStatusError", "%s", text);
    return nullptr;
  };
  if (name == nullptr || *name == '\0' || guid == nullptr || resources == nullptr ||
      callbacks == nullptr)
    return say("fmi2Instantiate: name, GUID, resources and callbacks are needed");
  if (type != fmi2CoSimulation) return say("fmi2Instantiate: it is for co-simulation alone");
  try {
    return rondo::fmu::enroll(
        std::make_unique<Component>(name, resources, guid, *callbacks, logging != 0));
  } catch (const std::exception& e) {
    return say(e.what());
  } catch (...) {
    return say("fmi2Instantiate has failed");
  }
}

RONDO_EXPORT void fmi2FreeInstance(fmi2Component c) {
  rondo::fmu::dismiss(c);
}

RONDO_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t n,
                                            const fmi2String categories[]) {
  return guarded(c, [&](Component& k) { return k.set_logging(on != 0, n, categories); });
}

RONDO_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start,
                                            fmi2Boolean stops, fmi2Real stop) {
  const double last = stops != 0 ? stop : std::numeric_limits<double>::infinity();
  return guarded(c, [&](Component& k) { return k.setup(start, last); });
}

RONDO_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return guarded(c, [](Component& k) { return k.enter_initialization(); });
}

RONDO_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return guarded(c, [](Component& k) { return k.exit_initialization(); });
}

RONDO_EXPORT fmi2Status fmi2Terminate(fmi2Component c) {
  return guarded(c, [](Component& k) { return k.terminate(); });
}

RONDO_EXPORT fmi2Status fmi2Reset(fmi2Component c) {
  return guarded(c, [](Component& k) { return k.reset(); });
}

RONDO_EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                    fmi2Real value[]) {
  return guarded(c, [&](Component& k) { return k.get(vr, n, value); });
}

RONDO_EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                                    const fmi2Real value[]) {
  return guarded(c, [&](Component& k) { return k.set(vr, n, value); });
}

RONDO_EXPORT fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                       fmi2Integer*) {
  return none_of(c, "fmi2GetInteger", n);
}

RONDO_EXPORT fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                       fmi2Boolean*) {
  return none_of(c, "fmi2GetBoolean", n);
}

RONDO_EXPORT fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                      fmi2String*) {
  return none_of(c, "fmi2GetString", n);
}

RONDO_EXPORT fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                       const fmi2Integer*) {
  return none_of(c, "fmi2SetInteger", n);
}

RONDO_EXPORT fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                       const fmi2Boolean*) {
  return none_of(c, "fmi2SetBoolean", n);
}

RONDO_EXPORT fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                      const fmi2String*) {
  return none_of(c, "fmi2SetString", n);
}

RONDO_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return guarded(c, [&](Component& k) { return k.save(state); });
}

RONDO_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return guarded(c, [&](Component& k) { return k.restore(state); });
}

RONDO_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return guarded(c, [&](Component& k) { return k.free(state); });
}

RONDO_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state,
                                                   std::size_t* n) {
  return guarded(c, [&](Component& k) { return k.serialized_size(state, n); });
}

RONDO_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                              std::size_t n) {
  return guarded(c, [&](Component& k) { return k.serialize(state, bytes, n); });
}

RONDO_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[],
                                                std::size_t n, fmi2FMUstate* state) {
  return guarded(c, [&](Component& k) { return k.deserialize(bytes, n, state); });
}

RONDO_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference*,
                                                     std::size_t, const fmi2ValueReference*,
                                                     std::size_t, const fmi2Real*, fmi2Real*) {
  return guarded(c, [](Component& k) {
    return k.error("fmi2GetDirectionalDerivative: providesDirectionalDerivative is false");
  });
}

RONDO_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                                    std::size_t, const fmi2Integer*,
                                                    const fmi2Real*) {
  return guarded(c, [](Component& k) {
    return k.error(
        "fmi2SetRealInputDerivatives: canInterpolateInputs is false: inputs are led to "
        "linearly");
  });
}

RONDO_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                                     std::size_t, const fmi2Integer*, fmi2Real*) {
  return guarded(c, [](Component& k) {
    return k.error("fmi2GetRealOutputDerivatives: maxOutputDerivativeOrder is 0");
  });
}

RONDO_EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real at, fmi2Real length, fmi2Boolean) {
  return guarded(c, [&](Component& k) { return k.step(at, length); });
}

RONDO_EXPORT fmi2Status fmi2CancelStep(fmi2Component c) {
  return guarded(
      c, [](Component& k) { return k.error("fmi2CancelStep: canRunAsynchronuously is false"); });
}

RONDO_EXPORT fmi2Status fmi2GetStatus(fmi2Component, const fmi2StatusKind, fmi2Status*) {
  return fmi2Discard;
}

RONDO_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind,
                                          fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  return guarded(c, [&](Component& k) {
    if (value == nullptr) return k.error("fmi2GetRealStatus: the pointer to the value is NULL");
    *value = k.time();
    return fmi2OK;
  });
}

RONDO_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) {
  return fmi2Discard;
}

RONDO_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind,
                                             fmi2Boolean* value) {
  if (kind != fmi2Terminated) return fmi2Discard;
  return guarded(c, [&](Component& k) {
    if (value == nullptr) return k.error("fmi2GetBooleanStatus: the pointer to the value is NULL");
    *value = k.is_terminated() ? 1 : 0;
    return fmi2OK;
  });
}

RONDO_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) {
  return fmi2Discard;
}

}  // extern "C"
