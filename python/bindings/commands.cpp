// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "in_process_team.hpp"
#include "rondo/analysis/modes/modes.hpp"
#include "rondo/analysis/run.hpp"
#include "rondo/analysis/simulation/solve.hpp"
#include "rondo/core/error.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/reduce/reduce.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::python {
namespace {

namespace fs = std::filesystem;

/// "done", "interrupted" or "failed", and why.
py::tuple outcome(const study::RunReport& r) {
  constexpr std::array<const char*, 3> names{"done", "interrupted", "failed"};
  return py::make_tuple(names[static_cast<std::size_t>(r.status)], r.message);
}

void demand_runs(const std::vector<fs::path>& runs) {
  if (runs.empty())
    throw request_error("runs", "[]", "no run is given", "results directories of runs");
}

py::tuple run(const fs::path& file, const Settings& settings, const fs::path& directory,
              const py::dict& given) {
  Call call;
  study::RunOptions options;
  call.take(given, run_options(options));
  options.directory = directory;
  call.give(options);
  study::RunReport report;
  call.work([&] { report = study::run_case(study::read_case(file, settings), options); });
  call.finish();
  return outcome(report);
}

py::dict arrays_of(study::RecordedSnapshots s) {
  const auto t = static_cast<py::ssize_t>(s.count), n = static_cast<py::ssize_t>(s.nodes),
             c = static_cast<py::ssize_t>(s.components),
             nb = static_cast<py::ssize_t>(s.candidates);
  py::dict arrays;
  arrays["times"] = owned(std::move(s.time));
  arrays["times_velocity"] = owned(std::move(s.time_velocity));
  arrays["angle"] = owned(std::move(s.angle));
  arrays["angle_velocity"] = owned(std::move(s.angle_velocity));
  arrays["center"] = owned(std::move(s.center), {t, c});
  arrays["displacement"] = owned(std::move(s.displacement), {t, n, c});
  arrays["velocity"] = owned(std::move(s.velocity), {t, n, c});
  if (nb > 0) arrays["contact_force"] = owned(std::move(s.contact_force), {t, nb, c});
  return arrays;
}

py::dict solve(const fs::path& file, const Settings& settings, const py::dict& given) {
  Call call;
  study::RunOptions options;
  call.take(given, run_options(options));
  call.give(options);
  study::Solution s;
  call.work([&] { s = study::solve_case(study::read_case(file, settings), options); });
  call.finish();
  std::vector<std::pair<std::string, std::string>> columns;
  for (const ColumnLabel& label : s.columns) columns.emplace_back(label.name, label.unit);
  const auto width = static_cast<py::ssize_t>(s.columns.size());
  const auto rows = width > 0 ? static_cast<py::ssize_t>(s.rows.size()) / width : 0;
  py::dict found = arrays_of(std::move(s.snapshots));
  found["outcome"] = outcome(s.report);
  found["info"] = text_of(s.json);
  found["columns"] = columns;
  found["rows"] = owned(std::move(s.rows), {rows, width});
  found["mesh"] = mesh_arrays(s.mesh, s.mass, s.free_body);
  return found;
}

py::tuple modes(const fs::path& file, const Settings& settings, const fs::path& directory,
                const py::dict& given) {
  Call call;
  study::ModesRequest request;
  call.take(given, modes_options(request));
  request.run.directory = directory;
  call.give(request.run);
  study::ModesReport report;
  call.work([&] { report = study::run_modes(study::read_case(file, settings), request); });
  call.finish();
  return outcome(report.run);
}

fs::path pod(const std::vector<fs::path>& runs, const fs::path& output, const py::dict& given) {
  demand_runs(runs);
  Call call;
  study::PodRequest request;
  request.runs = runs;
  call.take(given, pod_options(request));
  request.directory = output;
  request.warn = call.warn();
  request.progress = call.progress();
  study::PodReport report;
  call.work([&] { report = study::run_pod(request); });
  call.finish();
  if (!report.trouble.empty()) throw NumericalFailure(report.trouble);
  return report.directory;
}

void reduce(const std::vector<fs::path>& sources, const fs::path& output, const Settings& settings,
            const py::dict& given) {
  if (sources.empty())
    throw request_error("source", "[]", "nothing is given", "a case file, or results directories");
  Call call;
  study::ReduceRequest request;
  request.sources = sources;
  request.settings = settings;
  request.output = output;
  call.take(given, reduce_options(request));
  request.warn = call.warn();
  request.progress = call.progress();
  call.work([&] { static_cast<void>(study::run_reduce(request)); });
  call.finish();
}

/// How many members are done, failed, interrupted.
py::tuple sweep(const fs::path& study_file, const Settings& settings, const fs::path& directory,
                const py::dict& given) {
  Call call;
  study::SweepRequest request;
  request.study = study_file;
  request.settings = settings;
  request.directory = directory;
  call.take(given, sweep_options(request));
  request.stop = &call.stop();
  request.warn = call.warn();
  request.progress = call.progress();
  const auto look = call.progress();
  request.checking = [&](const char*, long long done, long long all) { look(done, all); };
  InProcessTeam team(call.stop(), [&] { look(0, 0); });
  study::SweepReport report;
  call.work([&] { report = study::run_sweep(request, team); });
  call.finish();
  return py::make_tuple(report.done, report.failed, report.interrupted);
}

}  // namespace

void add_commands(py::module_& module) {
  module.def("run", run, py::arg("file"), py::arg("settings"), py::arg("directory"),
             py::arg("options"));
  module.def("solve", solve, py::arg("file"), py::arg("settings"), py::arg("options"));
  module.def("modes", modes, py::arg("file"), py::arg("settings"), py::arg("directory"),
             py::arg("options"));
  module.def("pod", pod, py::arg("runs"), py::arg("output"), py::arg("options"));
  module.def("reduce", reduce, py::arg("sources"), py::arg("output"), py::arg("settings"),
             py::arg("options"));
  module.def("sweep", sweep, py::arg("study"), py::arg("settings"), py::arg("directory"),
             py::arg("options"));
}

}  // namespace rondo::python
