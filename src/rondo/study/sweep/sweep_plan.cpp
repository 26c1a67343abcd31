// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <random>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/toml_text.hpp"

namespace rondo::study {
namespace {

/// A number in [0, 1) that is the same with every standard library.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

std::string sampled(const Vary& vary, double u) {
  const auto [from, to] = *vary.uniform;
  const double value = from + (to - from) * u;
  const CaseKey* key = find_case_key(vary.key);
  if (key && type_of(*key) == KeyType::integer)
    return fmt::format("{}", static_cast<long long>(std::floor(from + (to - from + 1.0) * u)));
  return toml_number(value);
}

std::size_t grid_size(const SweepStudy& study) {
  std::size_t n = 1;
  for (const Vary& vary : study.parameters) {
    n *= vary.uniform || vary.goes_with_previous ? 1 : vary.values.size();
    if (n > most_members) return n;
  }
  return n;
}

}  // namespace

std::vector<std::vector<double>> latin_hypercube(int dimensions, int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> points;
  for (int d = 0; d < dimensions; ++d) {
    std::vector<int> part(static_cast<std::size_t>(n));
    std::iota(part.begin(), part.end(), 0);
    for (std::size_t k = part.size(); k > 1; --k)  // Fisher-Yates shuffle
      std::swap(part[k - 1],
                part[static_cast<std::size_t>(uniform(random) * static_cast<double>(k))]);
    std::vector<double> row;
    for (const int p : part) row.push_back((p + uniform(random)) / n);
    points.push_back(std::move(row));
  }
  return points;
}

std::vector<Member> members_of(const SweepStudy& study) {
  const std::size_t grid = grid_size(study);
  const std::size_t samples = study.sample ? static_cast<std::size_t>(study.sample->count) : 1;
  if (grid > most_members || grid * samples > most_members)
    throw InputError(Fault{study.file.string(), 0, 0, "vary", "", "the study has too many members",
                           fmt::format("at most {}", most_members)});
  int dimensions = 0;
  for (const Vary& vary : study.parameters) dimensions += vary.uniform ? 1 : 0;
  const auto points = study.sample
                          ? latin_hypercube(dimensions, study.sample->count, study.sample->seed)
                          : std::vector<std::vector<double>>{};
  std::vector<Member> members(grid * samples);
  for (std::size_t m = 0; m < members.size(); ++m) {
    std::size_t rest = m / samples, dimension = points.size();
    members[m].values.resize(study.parameters.size());
    for (std::size_t k = study.parameters.size(); k-- > 0;) {
      const Vary& vary = study.parameters[k];
      if (vary.uniform) {
        members[m].values[k] = sampled(vary, points[--dimension][m % samples]);
        continue;
      }
      members[m].values[k] = vary.values[rest % vary.values.size()];
      if (!vary.goes_with_previous) rest /= vary.values.size();
    }
  }
  return members;
}

std::vector<std::string> settings_of(const SweepStudy& study, const Member& member) {
  std::vector<std::string> settings = study.settings;
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    settings.push_back(study.parameters[k].key + "=" + member.values[k]);
  return settings;
}

std::string name_of(const SweepStudy& study, const Member& member, std::size_t number) {
  std::string said;
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    said += fmt::format("{}{} = {}", said.empty() ? "" : ", ", study.parameters[k].key,
                        member.values[k]);
  return fmt::format("run {} ({})", number, said);
}

}  // namespace rondo::study
