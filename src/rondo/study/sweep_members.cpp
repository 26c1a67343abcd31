// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "rondo/study/build.hpp"
#include "rondo/study/case_keys.hpp"
#include "rondo/study/check.hpp"
#include "rondo/study/estimate.hpp"
#include "rondo/study/memory_limits.hpp"
#include "rondo/study/run_files.hpp"
#include "rondo/study/sweep_target.hpp"
#include "rondo/study/toml_text.hpp"

namespace rondo::study {
namespace {

/// Faults of members, each text once.
class Faults {
 public:
  explicit Faults(const SweepStudy& study) : study_(study) {}

  void add(std::size_t member, const std::string& text) {
    auto [found, is_new] = members_.try_emplace(text);
    if (is_new) order_.push_back(text);
    found->second.insert(member);
  }
  void add(std::size_t member, const InputError& error) {
    for (const Fault& fault : error.faults()) add(member, fault.text());
  }
  [[nodiscard]] bool any() const { return !order_.empty(); }
  [[nodiscard]] bool has(std::size_t member) const {
    return std::ranges::any_of(members_,
                               [&](const auto& fault) { return fault.second.contains(member); });
  }

  [[noreturn]] void raise(const std::vector<PlannedMember>& members) const {
    std::vector<Fault> faults;
    for (const std::string& text : order_) {
      const std::set<std::size_t>& of = members_.at(text);
      const std::size_t first = *of.begin();
      const std::string whom = name_of(study_, members[first].member, first + 1);
      const std::string more =
          of.size() == 1 ? ""
                         : fmt::format(" and {} of {} others", of.size() - 1, members.size() - 1);
      faults.push_back({study_.file.string(), 0, 0, "", "", whom + more + ": " + text, ""});
    }
    throw InputError(std::move(faults));
  }

 private:
  const SweepStudy& study_;
  std::map<std::string, std::set<std::size_t>> members_;
  std::vector<std::string> order_;
};

// Targets ---------------------------------------------------------------------------------------

/// Place of the parameter with a target; as many as parameters: there is none.
std::size_t target_of(const SweepStudy& study) {
  const auto found = std::ranges::find_if(study.parameters, &Vary::is_target);
  return static_cast<std::size_t>(found - study.parameters.begin());
}

void demand_one_target(const SweepStudy& study) {
  if (std::ranges::count_if(study.parameters, &Vary::is_target) > 1)
    throw InputError(Fault{study.file.string(), 0, 0, "vary", "", "two parameters have a target",
                           "one of motion.height and analysis.depth"});
}

/// The crush of a case on flat ground, as deep as half of the body.
Case crush_of(const SweepStudy& study, const std::vector<std::string>& settings) {
  const Case c = read_case(study.base, settings);
  const bool is_crush = c.analysis.kind == AnalysisKind::crush;
  const std::string& key = study.parameters[target_of(study)].key;
  if (is_crush != (key == "analysis.depth"))
    throw InputError(
        Fault{study.file.string(), 0, 0, key, "",
              is_crush ? "means nothing to a crush" : "means nothing to a dynamic analysis",
              is_crush ? "target of analysis.depth" : "target of motion.height"});
  const double most = c.mesh ? c.analysis.depth : 0.5 * (c.disk.outer_radius - c.disk.inner_radius);
  if (!(most > 0.0))
    throw InputError(Fault{study.file.string(), 0, 0, "vary", "",
                           "a target needs a generated disk, or a crush of a mesh whose "
                           "analysis.depth says how deep to search",
                           "another base, or heights as values"});
  std::vector<std::string> all = settings;
  for (std::string& setting : crush_settings(most)) all.push_back(std::move(setting));
  Case crush = read_case(study.base, all);
  crush.title.clear();  // no difference
  return crush;
}

/// The height table of the member's case, with the height found at its end.
std::string height_text(const Case& c, double height) {
  auto points = c.motion.height.points();
  if (points.size() == 1) return toml_number(height);
  std::string text;
  for (std::size_t k = 0; k < points.size(); ++k)
    text += fmt::format("{}[{}, {}]", k > 0 ? ", " : "", toml_number(points[k][0]),
                        toml_number(k + 1 == points.size() ? height : points[k][1]));
  return "[" + text + "]";
}

/// Members whose targets one crush after the other of one body finds.
struct TargetGroup {
  std::vector<std::size_t> members;
};

void take_targets(const SweepStudy& study, std::size_t parameter, const TargetGroup& group,
                  const Piece& piece, std::vector<PlannedMember>& members, Faults& faults) {
  const std::string& key = study.parameters[parameter].key;
  const Json found = piece.state == Piece::State::done ? Json::parse(piece.text) : Json::array();
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    PlannedMember& member = members[group.members[k]];
    if (piece.state != Piece::State::done) {
      faults.add(group.members[k], piece.text);
      continue;
    }
    const std::string trouble = text_in(found[k], "trouble");
    if (!trouble.empty()) {
      faults.add(group.members[k],
                 fmt::format("{} has no value for {} = {} N/m: {}", key, target_force_y,
                             member.member.values[parameter], trouble));
      continue;
    }
    const bool is_depth = key == "analysis.depth";
    const double value = found[k][is_depth ? "depth" : "height"].get<double>();
    member.targets[parameter] = value;
    const std::string text =
        is_depth ? toml_number(value) : height_text(read_case(study.base, member.settings), value);
    member.settings.push_back(key + "=" + text);
  }
}

std::string solve_targets(const SweepStudy& study, std::size_t parameter, const TargetGroup& group,
                          const std::vector<PlannedMember>& members) {
  std::vector<double> forces;
  for (const std::size_t m : group.members)
    forces.push_back(std::stod(members[m].member.values[parameter]));
  const Case crush = crush_of(study, members[group.members.front()].settings);
  Json all = Json::array();
  for (const TargetFound& found : find_depths(crush, forces))
    all.push_back({{"depth", found.depth}, {"height", found.height}, {"trouble", found.trouble}});
  return all.dump();
}

void find_targets(const SweepStudy& study, Team& team, std::vector<PlannedMember>& members,
                  Faults& faults) {
  demand_one_target(study);
  const std::size_t parameter = target_of(study);
  if (parameter == study.parameters.size()) return;
  std::map<std::string, std::size_t> place;
  std::vector<TargetGroup> groups;
  for (std::size_t m = 0; m < members.size(); ++m) {
    try {
      const auto [found, is_new] =
          place.try_emplace(write_case(crush_of(study, members[m].settings)), groups.size());
      if (is_new) groups.emplace_back();
      groups[found->second].members.push_back(m);
    } catch (const InputError& error) {
      faults.add(m, error);
    }
  }
  if (faults.any()) faults.raise(members);
  TeamWork work;
  work.count = groups.size();
  work.work = [&](std::size_t g, const std::atomic<bool>&) {
    return solve_targets(study, parameter, groups[g], members);
  };
  const std::vector<Piece> pieces = team.each(work);
  for (std::size_t g = 0; g < groups.size(); ++g)
    take_targets(study, parameter, groups[g], pieces[g], members, faults);
}

// Reading and building --------------------------------------------------------------------------

void check_window(const SweepStudy& study, const Case& c) {
  if (c.analysis.kind == AnalysisKind::crush) {
    if (study.window.from || study.window.to)
      throw InputError(Fault{study.file.string(), 0, 0, "window", "",
                             "means nothing to crushes, whose ends are compared", "no [window]"});
    return;
  }
  const double to = std::min(study.window.to.value_or(c.time.end), c.time.end);
  const double from = study.window.from.value_or(0.5 * to);
  if (!(from >= 0.0 && to - from > 2.0 * c.output.history_interval))
    throw InputError(
        Fault{study.file.string(), 0, 0, "window", "",
              fmt::format("from {:.6g} to {:.6g} s there are not two rows of history.csv (time.end "
                          "= {:.6g} s, output.history_interval = {:.6g} s)",
                          from, to, c.time.end, c.output.history_interval),
              "a longer part of the run, or rows that are closer"});
}

void read_members(const SweepStudy& study, PlannedSweep& plan, Faults& faults) {
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    PlannedMember& member = plan.members[m];
    try {
      const Case c = case_of(study, member);
      check_window(study, c);
      plan.kind = c.analysis.kind;
      member.body = body_key(c);
      if (!c.mesh) member.memory_bytes = estimated_memory(c, size_of(c.disk));
    } catch (const InputError& error) {
      faults.add(m, error);
    }
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

/// One member, built on the body of the one before where it fits.
std::string check_member(const MembersRequest& request, const PlannedMember& member,
                         SharedBody& shared) {
  Json j;
  try {
    const Case c = case_of(request.study, member);
    const CheckReport r =
        check_case(c, {.threads = 1, .trial_s = request.seconds ? 0.02 : 0.0, .shared = &shared});
    j = {{"steps", c.analysis.kind == AnalysisKind::crush ? r.increments : r.steps},
         {"nodes", r.nodes},
         {"dofs", r.dofs},
         {"seconds", r.seconds},
         {"memory", r.memory_bytes},
         {"disk", r.disk_bytes},
         {"warnings", r.warnings}};
  } catch (const InputError& error) {
    j["faults"] = Json::array();
    for (const Fault& fault : error.faults()) j["faults"].push_back(fault.text());
  }
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void take_check(const Piece& piece, std::size_t m, PlannedMember& member, Faults& faults) {
  if (piece.state == Piece::State::failed) return faults.add(m, piece.text);
  if (piece.state == Piece::State::missing) return;  // a stop was asked for
  const Json j = Json::parse(piece.text);
  if (j.contains("faults")) {
    for (const Json& text : j["faults"]) faults.add(m, text.get<std::string>());
    return;
  }
  member.steps = j["steps"].get<long long>();
  member.nodes = j["nodes"].get<std::size_t>();
  member.dofs = j["dofs"].get<std::size_t>();
  member.seconds = j["seconds"].get<double>();
  member.memory_bytes = j["memory"].get<std::size_t>();
  member.disk_bytes = j["disk"].get<std::size_t>();
  member.warnings = j["warnings"].get<std::vector<std::string>>();
}

void build_members(const MembersRequest& request, Team& team, PlannedSweep& plan, Faults& faults) {
  std::vector<std::size_t> order = by_body(plan.members);
  std::erase_if(order, [&](std::size_t m) { return faults.has(m); });
  SharedBody shared;
  TeamWork work;
  work.count = order.size();
  work.work = [&](std::size_t k, const std::atomic<bool>&) {
    return check_member(request, plan.members[order[k]], shared);
  };
  const std::vector<Piece> pieces = team.each(work);
  for (std::size_t k = 0; k < order.size(); ++k)
    take_check(pieces[k], order[k], plan.members[order[k]], faults);
}

/// As many workers as there is memory for.
void limit_workers(const std::vector<PlannedMember>& members, Team& team) {
  std::size_t most = 1;
  for (const PlannedMember& member : members) most = std::max(most, member.memory_bytes);
  const std::size_t at_once = allowed_memory().bytes / most;
  team.limit_workers(static_cast<int>(std::clamp<std::size_t>(at_once, 1, 100'000)));
}

}  // namespace

Case case_of(const SweepStudy& study, const PlannedMember& member) {
  return read_case(study.base, member.settings);
}

PlannedSweep plan_sweep(const MembersRequest& request, Team& team) {
  const SweepStudy& study = request.study;
  PlannedSweep plan;
  for (Member& member : members_of(study)) {
    PlannedMember& planned = plan.members.emplace_back();
    planned.settings = settings_of(study, member);
    planned.targets.assign(study.parameters.size(), 0.0);
    planned.member = std::move(member);
  }
  Faults faults(study);
  find_targets(study, team, plan.members, faults);
  if (faults.any()) faults.raise(plan.members);
  read_members(study, plan, faults);
  limit_workers(plan.members, team);
  build_members(request, team, plan, faults);
  if (faults.any()) faults.raise(plan.members);
  limit_workers(plan.members, team);
  plan.order = by_cost(plan.members);
  return plan;
}

}  // namespace rondo::study
