// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_rows.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"
#include "rondo/study/sweep/sweep_directory.hpp"

namespace rondo::study {
namespace {

constexpr const char* leader_failed = "failed";
constexpr std::string_view running = "running";
constexpr std::size_t most_told = 5;

/// Members that run for a millisecond would spend a fifth of it on returning memory to the system
/// and requesting it again.
void keep_freed_memory() noexcept {
  constexpr int bytes = 32 << 20;  // largest threshold that is accepted
  mallopt(M_MMAP_THRESHOLD, bytes);
  mallopt(M_TRIM_THRESHOLD, 4 * bytes);
}

MemberRow lost_row(const std::string& file) {
  MemberRow row;
  row.status = MemberStatus::failed;
  row.code = exit_files;
  row.message = fmt::format(
      "it was done, and {} was removed while the sweep went on; --resume makes it again", file);
  return row;
}

/// The case with all its keys. Files are told by their names alone, as those of the study and its
/// base are: shards that call the study by other paths write the same.
std::string text_without_folders(Case c) {
  if (MeshCase* mesh = mesh_file_of(c)) mesh->file = mesh->file.filename();
  if (c.ground && !c.ground->road.file.empty())
    c.ground->road.file = std::filesystem::path(c.ground->road.file).filename().string();
  return write_case(c);
}

}  // namespace

SweepRows::SweepRows(const SweepRequest& request, const SweepStudy& study, const PlannedSweep& plan)
    : request_(request),
      study_(study),
      plan_(plan),
      first_case_(text_without_folders(case_of(study, plan.members.front()))),
      rows_(plan.members.size()) {}

void SweepRows::write(const char* status) const {
  io::write_json(request_.directory / "sweep.json", describe(status));
}

void SweepRows::take(const std::vector<std::size_t>& members, const std::vector<Piece>& pieces) {
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    MemberRow& row = rows_[members[k]];
    if (pieces[k].state == Piece::State::done) row = unpacked(pieces[k].text);
    if (pieces[k].state == Piece::State::failed) {
      row.status = MemberStatus::failed;
      row.code = pieces[k].code;
      row.message = pieces[k].text;
    }
    row.worker = pieces[k].worker;
  }
}

void SweepRows::compare_with_files(const MemberRunner& runner) {
  if (plan_.direct) return;
  for (std::size_t m = 0; m < rows_.size(); ++m) {
    if (!is_own(m)) continue;
    if (rows_[m].status == MemberStatus::waiting) {
      if (std::optional<MemberRow> row = kept_row(runner, m)) rows_[m] = *std::move(row);
    } else if (rows_[m].status == MemberStatus::done) {
      const std::string lost = missing_file(request_.directory, m, rows_.size());
      if (!lost.empty()) rows_[m] = lost_row(lost);
    }
  }
}

bool SweepRows::is_unfinished(const std::vector<std::size_t>& members) const {
  return std::ranges::any_of(members,
                             [&](std::size_t m) { return study::is_unfinished(rows_[m]); });
}

SweepReport SweepRows::report() const {
  SweepReport r;
  for (std::size_t m = 0; m < rows_.size(); ++m) {
    if (!is_own(m)) continue;
    const MemberRow& row = rows_[m];
    ++r.members;
    r.kept += row.kept ? 1 : 0;
    r.done += row.status == MemberStatus::done ? 1 : 0;
    const bool unfinished = study::is_unfinished(row);
    r.interrupted += unfinished ? 1 : 0;
    if (unfinished) r.code = exit_interrupted;
    if (row.status != MemberStatus::failed) continue;
    add_failure(m, r);
  }
  add_strains(r);
  r.wall_s = wall_s_.value_or(std::chrono::duration<double>(Clock::now() - begin_).count());
  return r;
}

std::string SweepRows::place_of(std::size_t m) const {
  if (plan_.direct) return {};
  return " in " + run_directory(request_.directory, m, rows_.size()).string();
}

void SweepRows::add_failure(std::size_t m, SweepReport& r) const {
  ++r.failed;
  if (r.code != exit_interrupted) r.code = std::max(r.code, rows_[m].code);
  if (r.failures.size() < most_told)
    r.failures.push_back(name_of(study_, plan_.members[m].member, m + 1) + place_of(m) + ": " +
                         rows_[m].message);
}

void SweepRows::add_strains(SweepReport& r) const {
  const std::span<const FigureColumn> columns = plan_.type->figures.columns;
  const auto found = std::ranges::find(columns, "strain_max", &FigureColumn::name);
  if (found == columns.end()) return;
  const auto place = static_cast<std::size_t>(found - columns.begin());
  for (std::size_t m = 0; m < rows_.size(); ++m) {
    if (!is_own(m) || rows_[m].figures.empty() || !plan_.members[m].is_linear) continue;
    const double strain = rows_[m].figures[place];  // comparisons with NaN are false
    r.strained += strain > small_strain ? 1 : 0;
    if (!(strain > r.strain_max)) continue;
    r.strain_max = strain;
    r.strain_run = m + 1;
  }
}

Json SweepRows::describe_parameters() const {
  Json all = Json::array();
  std::string leader;  // the first parameter of a [[vary]]
  for (const Vary& vary : study_.parameters) {
    const CaseKey* key = find_case_key(vary.key);
    all.push_back({{"key", vary.key},
                   {"unit", std::string(key ? rondo::unit_of(key->unit, plan_.is_solid) : "-")},
                   {"kind", vary.uniform ? "uniform" : "values"}});
    if (!vary.goes_with_previous) leader = vary.key;
    if (leader != vary.key) all.back()["with"] = leader;
  }
  return all;
}

Json SweepRows::describe(std::string_view status) const {
  const auto time = [](const std::optional<double>& t) { return t ? Json(*t) : Json(); };
  Json j;
  j["format"] = sweep_format;
  j["status"] = status;
  j["title"] = study_.title;
  describe_program(j);
  if (status == running) j["process"] = ::getpid();
  j["analysis"] = rules_of(plan_.type->kind).name;
  j["study"] = as_utf8(study_.file.filename().string());
  j["base"] = as_utf8(study_.base.filename().string());
  j["parameters"] = describe_parameters();
  j["case"] = as_utf8(first_case_);
  j["columns"] = Json::array();
  for (const ColumnLabel& column : figure_labels(plan_))
    j["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  j["window"] = {{"from", time(study_.window.from)}, {"to", time(study_.window.to)}};
  j["members"] = rows_.size();
  j["members_hash"] = hash_of(study_, plan_);
  const SweepReport r = report();
  j["done"] = r.done;
  j["failed"] = r.failed;
  j["failures"] = Json::array();
  for (std::size_t m = 0; m < rows_.size(); ++m)
    if (rows_[m].status == MemberStatus::failed)
      j["failures"].push_back({{"run", m + 1}, {"message", as_utf8(rows_[m].message)}});
  j["wall_s"] = r.wall_s;
  return j;
}

const char* status_of(const SweepReport& report) noexcept {
  if (report.interrupted > 0) return "interrupted";
  return report.failed > 0 ? "failed" : "done";
}

SweepStudy study_of(const SweepRequest& request) {
  SweepStudy study = read_study(request.study);
  study.settings.insert(study.settings.end(), request.settings.begin(), request.settings.end());
  check_settings(study);
  return study;
}

void warn_of_another_host(const SweepRequest& request, const std::filesystem::path& directory) {
  const std::string other = warning_of_another_host(directory);
  if (request.warn && !other.empty()) request.warn(other);
}

/// Gives each warning once, with the number of members that it concerns.
void warn_of_members(const SweepRequest& request, const PlannedSweep& plan) {
  if (!request.warn) return;
  std::map<std::string, std::pair<std::size_t, std::size_t>> said;  // first member, count
  for (std::size_t m = 0; m < plan.members.size(); ++m)
    for (const std::string& warning : plan.members[m].warnings)
      ++said.try_emplace(warning, m + 1, 0).first->second.second;
  for (const auto& [text, of] : said)
    request.warn(of.second == 1 ? fmt::format("run {}: {}", of.first, text)
                                : fmt::format("run {} and {} other{}: {}", of.first, of.second - 1,
                                              of.second == 2 ? "" : "s", text));
}

void lead(Team& team, const std::function<void()>& part) {
  if (team.leads()) {
    try {
      part();
    } catch (const std::exception&) {
      static_cast<void>(team.from_leader(leader_failed));
      throw;
    }
  }
  if (team.from_leader("") == leader_failed)
    throw std::runtime_error("the leader of the team has failed");
}

void run_members(const SweepRequest& request, MemberRunner& runner, Team& team, SweepRows& rows) {
  if (runner.plan.direct) keep_freed_memory();
  std::size_t before = 0, all = 0;
  const std::vector<std::vector<std::size_t>> phases = phases_of(runner.plan);
  for (const std::vector<std::size_t>& members : phases) all += members.size();
  for (const std::vector<std::size_t>& members : phases) {
    TeamWork work;
    work.count = members.size();
    work.work = [&](std::size_t k, const std::atomic<bool>& stop) {
      return packed(run_member(runner, members[k], stop));
    };
    if (request.progress)
      work.watch = [&](std::size_t ended) {
        request.progress(static_cast<long long>(before) + static_cast<long long>(ended),
                         static_cast<long long>(all));
      };
    rows.take(members, team.each(work));
    if (rows.is_unfinished(members)) return;
    before += members.size();
  }
}

SweepReport interrupted_report(const PlannedSweep& plan) {
  SweepReport report;
  for (const PlannedMember& member : plan.members)
    report.members += member.part == Part::own ? 1 : 0;
  report.interrupted = report.members;
  report.code = exit_interrupted;
  return report;
}

}  // namespace rondo::study
