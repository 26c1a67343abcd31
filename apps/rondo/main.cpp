// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

#include "options.hpp"
#include "process.hpp"
#include "report/python_commands.hpp"
#include "report/report_command.hpp"
#include "rondo/core/build_id.hpp"
#include "rondo/core/build_record.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/limits/processors.hpp"
#include "rondo/core/text/edit_distance.hpp"
#include "rondo/core/version.hpp"
#include "rondo/output/run_files.hpp"
#include "signals.hpp"

namespace {

using namespace rondo;

/// Also handles --help, which prints no document.
int parse_failure(const CLI::App& program, const CLI::ParseError& error, app::Telling& tell) {
  if (error.get_exit_code() == 0 || !tell.json) {
    tell.json = false;
    return program.exit(error) == 0 ? exit_done : exit_input;
  }
  throw InputError(Fault{"", 0, 0, "", "", error.what(), "see --help of the command"});
}

/// Called before parsing, because an option such as --help would hide an unknown command.
void demand_command(CLI::App& program, const std::string& name) {
  std::string names, nearest;
  std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == name) return;
    if (command->get_group().empty()) continue;  // removed command
    names += (names.empty() ? "" : ", ") + command->get_name();
    const std::size_t distance = edit_distance(name, command->get_name());
    if (distance >= least) continue;
    least = distance;
    nearest = fmt::format("; did you mean rondo {}?", command->get_name());
  }
  throw InputError(
      Fault{"", 0, 0, "rondo " + name, "", "there is no such command" + nearest, names});
}

int dispatch_command(CLI::App& program, int argc, char** argv, app::Telling& tell) {
  std::string schema_of;
  app::RunArguments run_arguments;
  app::RunArguments check_arguments;
  study::PodRequest pod_request;
  study::ReduceRequest reduce_request;
  study::FmuRequest fmu_request;
  app::ModesArguments modes_arguments;
  app::MatricesArguments matrices_arguments;
  app::SweepArguments sweep_arguments;
  app::ReportArguments report_arguments;
  const CLI::App* run = app::add_run(program, run_arguments, tell);
  const CLI::App* check = app::add_check(program, check_arguments, tell);
  const CLI::App* pod = app::add_pod(program, pod_request, tell);
  const CLI::App* reduce = app::add_reduce(program, reduce_request, tell);
  const CLI::App* fmu = app::add_fmu(program, fmu_request, tell);
  const CLI::App* modes = app::add_modes(program, modes_arguments, tell);
  const CLI::App* matrices = app::add_matrices(program, matrices_arguments, tell);
  const CLI::App* sweep = app::add_sweep(program, sweep_arguments, tell);
  const CLI::App* report = app::add_report(program, report_arguments);
  const CLI::App* schema = app::add_schema(program, schema_of);
  app::add_python_commands(program);
  if (argc > 1 && argv[1][0] != '-') demand_command(program, argv[1]);
  if (argc > 1 && app::is_python_command(argv[1])) app::do_python_command(argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parse_failure(program, error, tell);
  }
  if (run->parsed()) return app::run(run_arguments, tell);
  if (check->parsed()) return app::check(check_arguments, tell);
  if (pod->parsed()) return app::pod(pod_request, tell);
  if (reduce->parsed()) return app::reduce(reduce_request, tell);
  if (fmu->parsed()) return app::fmu(fmu_request, tell);
  if (modes->parsed()) return app::modes(modes_arguments, tell);
  if (matrices->parsed()) return app::matrices(matrices_arguments, tell);
  if (sweep->parsed()) return app::sweep(sweep_arguments, tell);
  if (report->parsed()) app::report(report_arguments);
  if (schema->parsed()) return app::schema(schema_of);
  return exit_input;
}

/// Catches all exceptions.
int run_command(CLI::App& program, int argc, char** argv, app::Telling& tell) {
  try {
    return dispatch_command(program, argc, argv, tell);
  } catch (const std::exception& error) {
    return app::tell_failure(error);
  }
}

int run_program(int argc, char** argv) {
  app::open_standard_streams();
  spdlog::set_default_logger(spdlog::stderr_color_st("rondo"));
  spdlog::set_pattern("rondo: %^%l%$: %v");
  CLI::App program{"rondo: explicit non-smooth dynamics of rolling bodies", "rondo"};
  program.set_version_flag("--version", [] {
    std::string text =
        fmt::format("rondo {} ({}; build id {}; kernels {})\n{}", version, build_options,
                    build_id(), study::dispatch_level(), in_lines(build_record()));
    text.pop_back();  // it is printed with a line feed
    return text;
  });
  program.require_subcommand(1);
  program.footer(
      "Example:\n  rondo run cases/ledge-smooth.toml -o results/ledge\n"
      "Each command has its own help: rondo run --help");
  std::signal(SIGPIPE, SIG_IGN);  // a closed reader of our output must not end us
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too long gives a write error
  app::end_at_stop_signals();
  use_allowed_processors();
  app::Telling tell;
  tell.json = app::is_json_asked_for(argc, argv);
  if (tell.json) app::begin_answer(argv[1]);
  const int code = run_command(program, argc, argv, tell);
  try {
    if (tell.json) app::print_answer(tell, code);
    if (std::fflush(stdout) == 0) return code;
    throw FileError("standard output", "cannot be written");
  } catch (const std::exception& error) {
    return app::tell_failure(error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  rondo::set_build_id(rondo::modules_id);
  rondo::set_commit(rondo::built_commit, rondo::built_modified);
  rondo::app::leave(run_program(argc, argv));
}
