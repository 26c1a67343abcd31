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
#include "rondo/core/limits/memory_limits.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/hash.hpp"
#include "rondo/io/road_hash.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/members/member_blocks.hpp"
#include "rondo/study/sweep/members/member_faults.hpp"

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

/// Hashes of mesh files; each file is read once.
class MeshHashes {
 public:
  /// Empty if the case has a disk.
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

/// Estimate before a mesh file is read: some bytes of memory for each byte of the file.
std::size_t guessed_memory(const Case& c) {
  constexpr std::size_t per_byte = 60;
  if (is_generated(c)) return mesh_memory(n_generated_nodes(c));
  std::error_code error;
  const auto size = fs::file_size(mesh_file_of(c)->file, error);
  const std::size_t bytes = error ? 0 : per_byte * static_cast<std::size_t>(size);
  return c.section ? bytes * static_cast<std::size_t>(c.section->sectors) : bytes;
}

nlohmann::json faults_of(const InputError& error) {
  nlohmann::json j = nlohmann::json::array();
  for (const Fault& fault : error.faults())
    j.push_back({{"kind", fault.key + '\n' + fault.message}, {"text", fault.text()}});
  return {{"faults", j}};
}

/// Hash of the road under a wheel in three dimensions, wherever its file is; empty: there is none,
/// or the case has its points.
std::string road_hash_of(const Case& c) {
  return is_on_road_surface(c) ? io::road_hash(*c.ground->road.read) : std::string();
}

/// The data of a member that are known from its case alone.
nlohmann::json read_member(const MembersRequest& request, const PlannedMember& member,
                           MeshHashes& meshes) {
  try {
    const Case c = case_of(request.study, member);
    check_window(request.study, c);
    if (request.accept) request.accept(c);
    const AnalysisType& type = type_of(c);
    return {{"columns", type.figures.columns.size()},
            {"hash",
             hash_of(write_case(kept_case(c)) + meshes.of(c) + road_hash_of(c))},  // wherever it is
            {"body", hash_of(body_key(c) + meshes.of(c))},
            {"shared", type.shared_key ? hash_of(type.shared_key(c)) : std::string()},
            {"is_linear", !has_large_strains(c)},
            {"finds_modes", type.finds_modes},
            {"memory_bytes", guessed_memory(c)}};
  } catch (const InputError& error) {
    return faults_of(error);
  }
}

/// Returns false if there are faults instead.
bool take_faults(const nlohmann::json& j, std::size_t m, MemberFaults& faults) {
  if (!j.contains("faults")) return false;
  for (const nlohmann::json& fault : j["faults"])
    faults.add(m, fault["kind"].get<std::string>(), fault["text"].get<std::string>());
  return true;
}

void take_reading(const nlohmann::json& j, PlannedMember& member) {
  j["hash"].get_to(member.hash);
  j["body"].get_to(member.body);
  j["shared"].get_to(member.shared);
  j["is_linear"].get_to(member.is_linear);
  j["finds_modes"].get_to(member.finds_modes);
  j["memory_bytes"].get_to(member.memory_bytes);
}

/// All members of a study have the same analysis; only the last columns depend on the member.
void take_type(const SweepStudy& study, std::size_t member, PlannedSweep& plan) {
  const Case c = case_of(study, plan.members[member]);
  plan.type = &type_of(c);
  plan.is_solid = is_solid(c);
  plan.direct = plan.type->direct && !study.snapshots;
}

/// Chooses among the columns of history.csv of a member, which a worker builds for this.
/// False: a stop was requested. @throws InputError: there is no such column
bool choose_columns(const SweepStudy& study, std::size_t member, Team& team, PlannedSweep& plan) {
  const std::string file = study.file.string();
  if (plan.direct)
    throw InputError(Fault{file, 0, 0, "columns", "",
                           "steady rolling without snapshots leaves no history.csv",
                           "snapshots = true at the top of the study, or no columns"});
  std::vector<ColumnLabel> history;
  MemberWork work;
  work.count = 1;
  work.work = [&](std::size_t) {
    nlohmann::json labels = nlohmann::json::array();
    const Case c = case_of(study, plan.members[member]);
    for (const ColumnLabel& label :
         check_case(c, {.threads = 1, .trial_s = 0.0, .columns = true}).columns)
      labels.push_back({label.name, label.unit});
    return labels;
  };
  work.take = [&](std::size_t, const nlohmann::json& labels) {
    for (const nlohmann::json& label : labels)
      history.push_back({label[0].get<std::string>(), label[1].get<std::string>(), ""});
  };
  if (!each_member(work, team)) return false;
  plan.chosen = choose_figures(study.columns, history, plan.type->figures, study.file);
  return true;
}

/// Returns false if a stop was requested.
bool read_members(const MembersRequest& request, Team& team, PlannedSweep& plan,
                  MemberFaults& faults) {
  MeshHashes meshes;
  std::size_t most_columns = 0, typical = 0;
  MemberWork work;
  work.count = plan.members.size();
  work.work = [&](std::size_t m) { return read_member(request, plan.members[m], meshes); };
  work.take = [&](std::size_t m, const nlohmann::json& j) {
    if (take_faults(j, m, faults)) return;
    take_reading(j, plan.members[m]);
    const auto columns = j["columns"].get<std::size_t>();
    if (columns > most_columns) typical = m;
    most_columns = std::max(most_columns, columns);
  };
  work.watch = request.watch("read", work.count);
  if (!each_member(work, team)) return false;
  if (most_columns == 0) return true;
  take_type(request.study, typical, plan);
  return request.study.columns.empty() || faults.any() ||
         choose_columns(request.study, typical, team, plan);
}

/// The first member of each body passes its modes on to all others.
void hand_on_modes(std::vector<PlannedMember>& members) {
  std::map<std::string_view, std::size_t> first;
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (!members[m].finds_modes) continue;
    const auto [of_body, is_first] = first.try_emplace(members[m].body, m);
    if (!is_first) members[m].modes_of = of_body->second;
  }
}

/// Orders the members so that those that share a body, and what else they share, follow one
/// another.
std::vector<std::size_t> by_body(const std::vector<PlannedMember>& members) {
  std::vector<std::size_t> order(members.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t m) {
    return std::tuple(std::string_view(members[m].body), std::string_view(members[m].shared));
  });
  return order;
}

/// Orders the members: the longest bodies first, and in each its longest members.
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

/// Data that a worker keeps from one member to the next.
struct Checker {
  SharedBody shared;
  std::string body;       ///< body whose steps were timed
  double per_step = 0.0;  ///< [s]
};

/// Builds one member, on the body of the previous one if that matches.
nlohmann::json check_member(const MembersRequest& request, const PlannedMember& member,
                            Checker& checker) {
  using Clock = std::chrono::steady_clock;
  const bool timed = request.seconds && checker.body != member.body;
  const double trial = timed ? 0.05 : 0.0;
  const std::vector<std::string>& asked = request.study.columns;
  try {
    const Case c = case_of(request.study, member);
    const auto begin = Clock::now();
    const CheckReport r = check_case(
        c, {.threads = 1, .trial_s = trial, .shared = &checker.shared, .columns = !asked.empty()});
    static_cast<void>(choose_figures(asked, r.columns, type_of(c).figures, request.study.file));
    const double built = std::chrono::duration<double>(Clock::now() - begin).count() - trial;
    if (timed && r.steps > 0) checker.per_step = r.seconds / static_cast<double>(r.steps);
    checker.body = member.body;
    const double stepping = checker.per_step * static_cast<double>(r.steps);
    constexpr double files = 0.01;  // share of files in a run: measured, docs/studies.md
    return MemberCost{.memory_bytes = r.memory_bytes,
                      .disk_bytes = r.disk_bytes,
                      .nodes = r.nodes,
                      .dofs = r.dofs,
                      .steps = r.steps,
                      .seconds = stepping > 0.0 ? stepping + std::max(0.0, built) + files : 0.0,
                      .warnings = r.warnings};
  } catch (const InputError& error) {
    return faults_of(error);
  }
}

/// Returns false if a stop was requested.
bool build_members(const MembersRequest& request, Team& team, PlannedSweep& plan,
                   MemberFaults& faults) {
  std::vector<std::size_t> order = by_body(plan.members);
  std::erase_if(
      order, [&](std::size_t m) { return faults.has(m) || plan.members[m].part == Part::other; });
  Checker checker;
  MemberWork work;
  work.count = order.size();
  work.work = [&](std::size_t k) { return check_member(request, plan.members[order[k]], checker); };
  work.take = [&](std::size_t k, const nlohmann::json& j) {
    PlannedMember& member = plan.members[order[k]];
    if (take_faults(j, order[k], faults)) return;
    j.get_to(static_cast<MemberCost&>(member));
    if (plan.direct) member.disk_bytes = 0;
  };
  work.watch = request.watch("check", order.size());
  return each_member(work, team);
}

/// Limits the number of workers to what the memory allows.
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
  Case c = read_case(study.base, settings_of(study, member.member));
  if (!study.snapshots) c.output.snapshots = 0;
  return c;
}

PlannedSweep plan_sweep(const MembersRequest& request, Team& team) {
  const SweepStudy& study = request.study;
  PlannedSweep plan;
  for (Member& member : members_of(study)) plan.members.emplace_back().member = std::move(member);
  MemberFaults faults(study, plan.members.size());
  plan.stopped = !read_members(request, team, plan, faults);
  if (plan.stopped) return plan;
  hand_on_modes(plan.members);
  if (request.choose && !faults.any()) request.choose(plan.members);
  limit_workers(plan.members, team);
  plan.stopped = !build_members(request, team, plan, faults);
  if (plan.stopped) return plan;
  if (faults.any()) faults.raise(plan.members);
  limit_workers(plan.members, team);
  plan.order = by_cost(plan.members);
  return plan;
}

std::vector<ColumnLabel> figure_labels(const PlannedSweep& plan) {
  std::vector<ColumnLabel> labels;
  for (const FigureColumn& column : plan.type->figures.columns)
    labels.push_back(
        {std::string(column.name), std::string(column.unit), std::string(column.meaning)});
  for (const ChosenFigure& figure : plan.chosen) labels.push_back(figure.label);
  return labels;
}

std::vector<std::vector<std::size_t>> phases_of(const PlannedSweep& plan) {
  std::vector<std::vector<std::size_t>> phases(2);
  for (const std::size_t m : plan.order)
    if (plan.members[m].part != Part::other) phases[plan.members[m].modes_of ? 1 : 0].push_back(m);
  if (phases[1].empty()) phases.pop_back();
  return phases;
}

}  // namespace rondo::study
