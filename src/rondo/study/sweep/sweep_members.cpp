// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/case/solid/wheel_of.hpp"
#include "rondo/core/memory_limits.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/hash.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/member_faults.hpp"

namespace rondo::study {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemberCost, memory_bytes, disk_bytes, nodes, dofs, steps,
                                   seconds, warnings)

namespace {

namespace fs = std::filesystem;

void check_window(const SweepStudy& study, const Case& c) {
  const auto wrong = [&](const std::string& message, const char* allowed) {
    throw InputError(Fault{study.file.string(), 0, 0, "window", "", message, allowed});
  };
  if (!type_of(c).figures.has_window) {
    if (study.window.from || study.window.to)
      wrong("means nothing to runs whose ends are compared", "no [window]");
    return;
  }
  const double to = study.window.to.value_or(c.time.end);
  const double from = study.window.from.value_or(0.5 * to);
  if (to > c.time.end * (1.0 + 1e-12))
    wrong(fmt::format("ends at {:.6g} s, after time.end = {:.6g} s", to, c.time.end),
          "to <= time.end of every run, or leave it out");
  if (!(from >= 0.0 && to - from > 2.0 * c.output.history_interval))
    wrong(fmt::format("from {:.6g} to {:.6g} s there are not two rows of history.csv "
                      "(output.history_interval = {:.6g} s)",
                      from, to, c.output.history_interval),
          "a longer part of the run, or rows that are closer");
}

std::string hash_of(const std::string& text) {
  io::Hash hash;
  hash.add(std::span<const char>(text));
  return hash.text();
}

/// Of mesh files, each read once.
class MeshHashes {
 public:
  /// Empty where the case has a disk.
  const std::string& of(const Case& c) {
    const MeshCase* const mesh = mesh_file_of(c);
    if (!mesh) return none_;
    const auto [found, is_new] = hashes_.try_emplace(mesh->file);
    if (is_new) found->second = hash_of(io::text_of(mesh->file));
    return found->second;
  }

 private:
  std::map<fs::path, std::string> hashes_;
  const std::string none_;
};

/// Before a mesh file is read: some bytes of memory for each of its own.
std::size_t guessed_memory(const Case& c) {
  constexpr std::size_t per_byte = 60;
  if (is_generated(c)) return mesh_memory(n_generated_nodes(c));
  std::error_code error;
  const auto size = fs::file_size(mesh_file_of(c)->file, error);
  const std::size_t bytes = error ? 0 : per_byte * static_cast<std::size_t>(size);
  return c.section ? bytes * static_cast<std::size_t>(c.section->sectors) : bytes;
}

void read_members(const SweepStudy& study, PlannedSweep& plan, MemberFaults& faults) {
  MeshHashes meshes;
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    PlannedMember& member = plan.members[m];
    try {
      const Case c = case_of(study, member);
      check_window(study, c);
      const AnalysisType& type = type_of(c);  // those of one study differ in the last columns alone
      if (!plan.type || type.figures.columns.size() > plan.type->figures.columns.size())
        plan.type = &type;
      plan.is_solid = is_solid(c);
      plan.direct = plan.type->direct && !study.snapshots;
      member.hash = hash_of(write_case(kept_case(c)) + meshes.of(c));  // wherever it is read from
      member.body = hash_of(body_key(c) + meshes.of(c));
      member.is_linear = !has_rubber(c);
      member.finds_modes = finds_modes(c);
      member.memory_bytes = guessed_memory(c);
    } catch (const InputError& error) {
      faults.add(m, error);
    }
  }
}

/// The first member of a body hands its modes on to all others.
void hand_on_modes(std::vector<PlannedMember>& members) {
  std::map<std::string_view, std::size_t> first;
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (!members[m].finds_modes) continue;
    const auto [of_body, is_first] = first.try_emplace(members[m].body, m);
    if (!is_first) members[m].modes_of = of_body->second;
  }
}

/// Members that share a body one after the other.
std::vector<std::size_t> by_body(const std::vector<PlannedMember>& members) {
  std::vector<std::size_t> order(members.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::size_t m) -> const std::string& { return members[m].body; });
  return order;
}

/// The longest bodies first, and their longest members.
std::vector<std::size_t> by_cost(const std::vector<PlannedMember>& members) {
  const auto cost = [&](std::size_t m) {
    return static_cast<double>(members[m].steps) * static_cast<double>(members[m].dofs);
  };
  std::map<std::string_view, double> longest;
  for (std::size_t m = 0; m < members.size(); ++m)
    longest[members[m].body] = std::max(longest[members[m].body], cost(m));
  std::vector<std::size_t> order = by_body(members);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t m) {
    return std::tuple(longest[members[m].body], std::string_view(members[m].body), cost(m));
  });
  return order;
}

/// What a worker keeps from one member to the next.
struct Checker {
  SharedBody shared;
  std::string body;       ///< whose steps were timed
  double per_step = 0.0;  ///< [s]
};

/// One member, built on the body of the one before where it fits.
std::string check_member(const MembersRequest& request, const PlannedMember& member,
                         Checker& checker) {
  using Clock = std::chrono::steady_clock;
  const bool timed = request.seconds && checker.body != member.body;
  const double trial = timed ? 0.05 : 0.0;
  nlohmann::json j;
  try {
    const Case c = case_of(request.study, member);
    const auto begin = Clock::now();
    const CheckReport r =
        check_case(c, {.threads = 1, .trial_s = trial, .shared = &checker.shared});
    const double built = std::chrono::duration<double>(Clock::now() - begin).count() - trial;
    if (timed && r.steps > 0) checker.per_step = r.seconds / static_cast<double>(r.steps);
    checker.body = member.body;
    const double stepping = checker.per_step * static_cast<double>(r.steps);
    constexpr double files = 0.01;  // of a run: measured, docs/studies.md
    j = MemberCost{.memory_bytes = r.memory_bytes,
                   .disk_bytes = r.disk_bytes,
                   .nodes = r.nodes,
                   .dofs = r.dofs,
                   .steps = r.steps,
                   .seconds = stepping > 0.0 ? stepping + std::max(0.0, built) + files : 0.0,
                   .warnings = r.warnings};
  } catch (const InputError& error) {
    j["faults"] = nlohmann::json::array();
    for (const Fault& fault : error.faults())
      j["faults"].push_back({{"kind", fault.key + '\n' + fault.message}, {"text", fault.text()}});
  }
  return j.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void take_check(const nlohmann::json& j, std::size_t m, PlannedMember& member,
                MemberFaults& faults) {
  if (j.contains("faults")) {
    for (const nlohmann::json& fault : j["faults"])
      faults.add(m, fault["kind"].get<std::string>(), fault["text"].get<std::string>());
    return;
  }
  j.get_to(static_cast<MemberCost&>(member));
}

/// False: a stop was asked for.
bool build_members(const MembersRequest& request, Team& team, PlannedSweep& plan,
                   MemberFaults& faults) {
  std::vector<std::size_t> order = by_body(plan.members);
  std::erase_if(
      order, [&](std::size_t m) { return faults.has(m) || plan.members[m].part == Part::other; });
  Checker checker;
  TeamWork work;
  work.count = order.size();
  work.work = [&](std::size_t k, const std::atomic<bool>&) {
    return check_member(request, plan.members[order[k]], checker);
  };
  work.watch = request.watch("check", order.size());
  const std::vector<Piece> pieces = team.each(work);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (pieces[k].state == Piece::State::missing) return false;
    demand_done(pieces[k]);
    take_check(nlohmann::json::parse(pieces[k].text), order[k], plan.members[order[k]], faults);
    if (plan.direct) plan.members[order[k]].disk_bytes = 0;
  }
  return true;
}

/// As many workers as there is memory for.
void limit_workers(const std::vector<PlannedMember>& members, Team& team) {
  std::size_t most = 1;
  for (const PlannedMember& member : members)
    if (member.part != Part::other) most = std::max(most, member.memory_bytes);
  const std::size_t at_once = allowed_memory().bytes / most;
  team.limit_workers(static_cast<int>(std::clamp<std::size_t>(at_once, 1, 100'000)));
}

}  // namespace

std::function<void(std::size_t)> MembersRequest::watch(const char* what, std::size_t all) const {
  if (!progress) return {};
  return [this, what, all](std::size_t done) {
    progress(what, static_cast<long long>(done), static_cast<long long>(all));
  };
}

Case case_of(const SweepStudy& study, const PlannedMember& member) {
  Case c = read_case(study.base, member.settings);
  if (!study.snapshots) c.output.snapshots = 0;
  return c;
}

PlannedSweep plan_sweep(const MembersRequest& request, Team& team) {
  const SweepStudy& study = request.study;
  PlannedSweep plan;
  const std::vector<Member> members = members_of(study);
  for (const Member& member : members) {
    PlannedMember& planned = plan.members.emplace_back();
    planned.member = member;
    planned.settings = settings_of(study, member);
  }
  MemberFaults faults(study, members.size());
  read_members(study, plan, faults);
  hand_on_modes(plan.members);
  if (request.choose && !faults.any()) request.choose(plan.members);
  limit_workers(plan.members, team);
  if (!build_members(request, team, plan, faults)) {
    plan.stopped = true;
    return plan;
  }
  if (faults.any()) faults.raise(members);
  limit_workers(plan.members, team);
  plan.order = by_cost(plan.members);
  return plan;
}

std::vector<std::vector<std::size_t>> phases_of(const PlannedSweep& plan) {
  std::vector<std::vector<std::size_t>> phases(2);
  for (const std::size_t m : plan.order)
    if (plan.members[m].part != Part::other) phases[plan.members[m].modes_of ? 1 : 0].push_back(m);
  if (phases[1].empty()) phases.pop_back();
  return phases;
}

}  // namespace rondo::study
