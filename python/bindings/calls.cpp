// SPDX-License-Identifier: BSD-3-Clause
#include "calls.hpp"

#include <thread>

#include "rondo/core/error.hpp"

namespace rondo::python {
namespace {

std::atomic<int> at_work{0};
std::atomic<bool> ending{false};

/// From before the interpreter's lock is given up until it is held again.
struct AtWork {
  AtWork() {
    ++at_work;
    if (!ending.load()) return;
    --at_work;
    throw request_error("rondo", "", "Python is ending, and nothing is begun any more", "");
  }
  ~AtWork() { --at_work; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
};

}  // namespace

bool is_ending() noexcept {
  return ending.load();
}

void end_calls() {
  ending.store(true);
  const py::gil_scoped_release release;  // those that end want it
  for (int k = 0; k < 1000 && at_work.load() > 0; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

std::function<void(const std::string&)> Call::warn() {
  return [this](const std::string& text) { warnings_.push_back(text); };
}

std::function<void(long long, long long)> Call::progress() {
  return [this](long long, long long) { look(); };
}

void Call::give(study::RunOptions& options) {
  options.stop = &stop_;
  options.warn = warn();
  options.progress = progress();
}

void Call::look() {
  if (ending.load()) stop_.store(true);
  if (stop_.load() || Clock::now() - looked_ < period) return;
  looked_ = Clock::now();
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() == 0) return;
  PyErr_Fetch(&type_.ptr(), &value_.ptr(), &trace_.ptr());
  stop_.store(true);
}

void Call::work(const std::function<void()>& work) {
  const AtWork counted;
  try {
    const py::gil_scoped_release release;
    work();
  } catch (...) {
    finish();
    throw;
  }
}

void Call::finish() {
  const std::vector<std::string> warnings = std::move(warnings_);
  warnings_.clear();
  const py::object warn = py::module_::import("rondo.native").attr("warn");
  for (const std::string& text : warnings) warn(text);
  if (!type_) return;
  PyErr_Restore(type_.release().ptr(), value_.release().ptr(), trace_.release().ptr());
  throw py::error_already_set();
}

}  // namespace rondo::python
