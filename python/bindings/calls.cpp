// SPDX-License-Identifier: BSD-3-Clause
#include "calls.hpp"

#include <algorithm>
#include <regex>
#include <thread>

#include "options.hpp"
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

void Call::take(const py::dict& given, const study::Options& options) {
  take_options(given, options);
  for (const study::Option& option : options)
    if (!option.python.empty())
      names_.emplace_back(option.words.substr(0, option.words.find(',')), option.python);
}

std::string Call::in_python(const std::string& text) const {
  static const std::regex option("--?[a-z][a-z-]*");
  std::string named;
  auto from = text.cbegin();
  for (std::sregex_iterator found(text.begin(), text.end(), option), end; found != end; ++found) {
    const std::string word = found->str();
    const auto name = std::ranges::find(names_, word, [](const auto& n) { return n.first; });
    named.append(from, (*found)[0].first).append(name == names_.end() ? word : name->second);
    from = (*found)[0].second;
  }
  return named.append(from, text.cend());
}

std::function<void(const std::string&)> Call::warn() {
  return [this](const std::string& text) { warnings_.push_back(in_python(text)); };
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
  } catch (const InputError& error) {
    finish();
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults)
      for (std::string* text : {&fault.key, &fault.message, &fault.allowed})
        *text = in_python(*text);
    throw InputError(std::move(faults));
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
