// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/limits/processors.hpp"

#include <cblas.h>
#include <omp.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "rondo/core/limits/control_groups.hpp"

namespace rondo {
namespace {

namespace fs = std::filesystem;

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view space = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(space), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(space));
  text.remove_prefix(word.size());
  return word;
}

/// Processors in the affinity mask. The machine may have more than a cpu_set_t can represent.
int count_affinity() {
  for (int places = 1024; places <= 1 << 20; places *= 4) {
    const std::unique_ptr<cpu_set_t, void (*)(cpu_set_t*)> set(
        CPU_ALLOC(static_cast<std::size_t>(places)), [](cpu_set_t* s) { CPU_FREE(s); });
    const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(places));
    if (set && sched_getaffinity(0, size, set.get()) == 0) return CPU_COUNT_S(size, set.get());
  }
  return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

std::optional<double> quota_of(std::string_view cpu_max) {
  const std::string_view quota = next_word(cpu_max), period = next_word(cpu_max);
  double time = 0.0, of = 0.0;
  const auto is_read = [](std::string_view word, double& number) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size();
  };
  if (!is_read(quota, time) || !is_read(period, of) || !(time > 0.0) || !(of > 0.0))
    return std::nullopt;
  return time / of;
}

std::optional<double> least_quota(const std::string& groups, const fs::path& mount) {
  std::optional<double> least;
  const auto keep = [&](std::optional<double> quota) {
    if (quota && (!least || *quota < *least)) least = quota;
  };
  for (const fs::path& folder : control_group_folders(groups, mount, "cpu")) {
    keep(quota_of(text_or_nothing(folder / "cpu.max")));
    keep(quota_of(text_or_nothing(folder / "cpu.cfs_quota_us") + " " +
                  text_or_nothing(folder / "cpu.cfs_period_us")));
  }
  return least;
}

int allowed_processors() {
  int allowed = count_affinity();
  if (const auto quota = least_quota(text_or_nothing("/proc/self/cgroup"), "/sys/fs/cgroup"))
    allowed = std::min(allowed, static_cast<int>(std::min(std::floor(*quota), 1e6)));
  return std::max(1, allowed);
}

void use_allowed_processors() {
  if (std::getenv("OPENBLAS_NUM_THREADS") || std::getenv("OMP_NUM_THREADS")) return;
  const int allowed = allowed_processors();
  if (openblas_get_num_threads() > allowed) openblas_set_num_threads(allowed);
  if (omp_get_max_threads() > allowed) omp_set_num_threads(allowed);
}

}  // namespace rondo
