// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/files/removed_at_signal.hpp"

#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <string>

#include "rondo/core/index.hpp"

namespace rondo {
namespace {

struct Listed {
  std::atomic<pid_t> owner{0};  ///< 0: the entry is free; -1: it is being filled
  std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<pid_t>::is_always_lock_free, "read in a signal handler");

std::array<Listed, 32>& places() noexcept {
  static std::array<Listed, 32> list;
  return list;
}
// Created before a signal can arrive: a handler must not be the first to use it.
[[maybe_unused]] const auto& made_at_start = places();

}  // namespace

RemovedAtSignal::RemovedAtSignal(const std::filesystem::path& path) noexcept {
  const std::string& text = path.native();
  if (text.size() >= PATH_MAX) return;
  auto& list = places();
  for (std::size_t k = 0; k < list.size(); ++k) {
    pid_t none = 0;
    if (!list[k].owner.compare_exchange_strong(none, -1)) continue;
    std::memcpy(list[k].path.data(), text.c_str(), text.size() + 1);
    list[k].owner.store(::getpid());
    place_ = static_cast<int>(k);
    return;
  }
}

RemovedAtSignal::~RemovedAtSignal() {
  if (place_ >= 0) places()[at(place_)].owner.store(0);
}

void remove_at_signal() noexcept {
  const pid_t own = ::getpid();
  // Folders are removed after the files in them.
  for (const bool folders : {false, true})
    for (const Listed& listed : places()) {
      if (listed.owner.load() != own) continue;
      if (folders)
        ::rmdir(listed.path.data());
      else
        ::unlink(listed.path.data());
    }
}

}  // namespace rondo
