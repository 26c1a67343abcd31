// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/member_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "rondo/analysis/build/build.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/case/toml_text.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/sweep_target.hpp"

namespace rondo::study {
namespace {

/// Members of one crush, with several loads.
using Group = std::vector<std::size_t>;

bool is_depth(const SweepStudy& study) {
  return study.parameters[target_of(study)].key == "analysis.depth";
}

InputError study_error(const SweepStudy& study, const std::string& key, const std::string& message,
                       const std::string& allowed) {
  return InputError(Fault{study.file.string(), 0, 0, key, "", message, allowed});
}

/// The crush of a case on flat ground, as deep as half of the body.
Case crush_of(const SweepStudy& study, const std::vector<std::string>& settings) {
  const Case c = read_case(study.base, settings);
  const std::string& key = study.parameters[target_of(study)].key;
  if (!means_to(*find_case_key(key), c.analysis.kind))
    throw study_error(study, key,
                      fmt::format("means nothing to a {} analysis", rules_of(c.analysis.kind).name),
                      is_depth(study) ? "target of motion.height" : "target of analysis.depth");
  const double most = c.mesh ? c.analysis.depth : 0.5 * (c.disk.outer_radius - c.disk.inner_radius);
  if (!(most > 0.0))
    throw study_error(study, "vary",
                      "a target needs a generated disk, or a crush of a mesh whose analysis.depth "
                      "says how deep to search",
                      "another base, or heights as values");
  std::vector<std::string> all = settings;
  for (std::string& setting : crush_settings(most, c.analysis.increments))
    all.push_back(std::move(setting));
  return read_case(study.base, all);
}

/// Of a crush: all that its force hangs on.
std::string key_of(const Case& crush) {
  return fmt::format("{}\n{} {} {}", body_key(crush), toml_number(crush.ground->friction),
                     toml_number(crush.analysis.depth), crush.analysis.increments);
}

/// The height table of the member's case, with the height found at its end.
std::string height_text(const Case& c, double height) {
  const auto& points = c.motion.height.points();
  if (points.size() == 1) return toml_number(height);
  std::string text;
  for (std::size_t k = 0; k < points.size(); ++k)
    text += fmt::format("{}[{}, {}]", k > 0 ? ", " : "", toml_number(points[k][0]),
                        toml_number(k + 1 == points.size() ? height : points[k][1]));
  return "[" + text + "]";
}

std::vector<Group> group(const SweepStudy& study, std::vector<PlannedMember>& members,
                         MemberFaults& faults) {
  std::map<std::string, std::size_t> place;
  std::vector<Group> groups;
  for (std::size_t m = 0; m < members.size(); ++m) {
    try {
      const auto [found, is_new] =
          place.try_emplace(key_of(crush_of(study, members[m].settings)), groups.size());
      if (is_new) groups.emplace_back();
      groups[found->second].push_back(m);
    } catch (const InputError& error) {
      faults.add(m, error);
    }
  }
  return groups;
}

std::string solve(const SweepStudy& study, const Group& of,
                  const std::vector<PlannedMember>& members) {
  const std::size_t parameter = target_of(study);
  std::vector<double> forces;  // those of members that differ in other things are the same
  for (const std::size_t m : of) forces.push_back(std::stod(members[m].member.values[parameter]));
  std::vector<double> different = forces;
  std::ranges::sort(different);
  different.erase(std::unique(different.begin(), different.end()), different.end());
  const std::vector<TargetFound> found =
      find_depths(crush_of(study, members[of.front()].settings), different);
  Json all = Json::array();
  for (const double force : forces) {
    const auto place = std::ranges::lower_bound(different, force) - different.begin();
    const TargetFound& f = found[static_cast<std::size_t>(place)];
    all.push_back({{"depth", f.depth}, {"height", f.height}, {"trouble", f.trouble}});
  }
  return all.dump();
}

void take(const SweepStudy& study, const Json& found, std::size_t m, PlannedMember& member,
          MemberFaults& faults) {
  const std::size_t parameter = target_of(study);
  const std::string& key = study.parameters[parameter].key;
  const std::string trouble = text_in(found, "trouble");
  if (!trouble.empty())
    return faults.add(m, key + member.member.values[parameter],
                      fmt::format("{} has no value for {} = {} N/m: {}", key, target_force_y,
                                  member.member.values[parameter], trouble));
  const double value = found[is_depth(study) ? "depth" : "height"].get<double>();
  member.targets[parameter] = value;
  const std::string text = is_depth(study)
                               ? toml_number(value)
                               : height_text(read_case(study.base, member.settings), value);
  member.settings.push_back(key + "=" + text);
}

}  // namespace

std::size_t target_of(const SweepStudy& study) {
  const auto found = std::ranges::find_if(study.parameters, &Vary::is_target);
  return static_cast<std::size_t>(found - study.parameters.begin());
}

bool find_targets(const MembersRequest& request, Team& team, std::vector<PlannedMember>& members,
                  MemberFaults& faults) {
  const SweepStudy& study = request.study;
  if (std::ranges::count_if(study.parameters, &Vary::is_target) > 1)
    throw study_error(study, "vary", "two parameters have a target",
                      "one of motion.height and analysis.depth");
  if (target_of(study) == study.parameters.size()) return true;
  const std::vector<Group> groups = group(study, members, faults);
  if (faults.any()) return true;
  TeamWork work;
  work.count = groups.size();
  work.work = [&](std::size_t g, const std::atomic<bool>&) {
    return solve(study, groups[g], members);
  };
  work.watch = request.watch("load", groups.size());
  const std::vector<Piece> pieces = team.each(work);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (pieces[g].state == Piece::State::missing) return false;
    demand_done(pieces[g]);
    const Json found = Json::parse(pieces[g].text);
    for (std::size_t k = 0; k < groups[g].size(); ++k)
      take(study, found[k], groups[g][k], members[groups[g][k]], faults);
  }
  return true;
}

}  // namespace rondo::study
