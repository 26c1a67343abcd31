// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <string>
#include <type_traits>
#include <variant>

#include "report/axes_option.hpp"
#include "rondo/core/error.hpp"

namespace rondo::app {
namespace {

/// Adds a flag, or an option with its default, allowed values, and required or excluded options.
void add_option(CLI::App& command, const study::Option& o) {
  const std::string names(o.words), help = help_text(o, o.help);
  CLI::Option* added = std::visit(
      [&](auto* target) {
        if constexpr (std::is_same_v<decltype(target), bool*>)
          return command.add_flag_callback(
              names, [target, to = !*target] { *target = to; }, help);
        else
          return command.add_option(names, *target, help);
      },
      o.target);
  if (o.words == "--reduced-step")
    added->check([](const std::string& text) -> std::string {
      if (text != "midpoint" && text != "explicit") return {};
      return "a reduced wheel has one scheme: a number of seconds, or no --reduced-step";
    });
  if (!default_text(o).empty()) added->capture_default_str();
  if (!o.alone.empty())
    added->expected(0, 1)->default_str(std::string(o.alone))->option_text("TEXT");
  if (o.range) added->check(CLI::Range(o.range->low, o.range->high));
  if (o.needs) added->needs(command.get_option(std::string(o.needs->words)));
  if (o.excludes) added->excludes(command.get_option(std::string(o.excludes->words)));
}

void add_options(CLI::App& command, const study::Options& options) {
  for (const study::Option& option : options) add_option(command, option);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings, const char* what) {
  command.add_option("--set", settings, what)->take_all()->expected(1);
}

void add_case(CLI::App& command, CaseArguments& arguments,
              const char* what = "Case file (TOML, docs/cases.md)") {
  command.add_option("case", arguments.case_file, what)->required();
  add_settings(
      command, arguments.settings,
      "KEY=VALUE, which overrides a key of the case, e.g. ground.friction=0.6; repeatable");
}

/// @param output  a path or a text
template <class Name>
CLI::Option* add_output(CLI::App& command, Name& output, const char* what) {
  return command.add_option("-o,--output", output, what)->check(refuse_empty);
}

void add_json(CLI::App& command, Telling& tell) {
  command.add_flag("--json", tell.json,
                   "Prints one JSON document, also if the command fails (docs/machine.md)");
}

void add_telling(CLI::App& command, Telling& tell, const char* quiet) {
  command.add_flag("--quiet", tell.quiet, quiet);
  add_json(command, tell);
}

/// A hidden option of earlier versions: it is accepted and does nothing, and a warning says so.
void accept_gone(CLI::App& command, const std::string& name, int values, const char* instead) {
  const auto warn = [name, instead](const CLI::results_t&) {
    spdlog::warn("{} has gone and is ignored: {}", name, instead);
    return true;
  };
  command.add_option(name, warn)->expected(values)->group("");
}

}  // namespace

CLI::App* add_run(CLI::App& program, RunArguments& arguments, Telling& tell) {
  CLI::App* run = program.add_subcommand("run", "Runs a case into a results directory");
  add_case(*run, arguments,
           "Case file (TOML, docs/cases.md); with --resume a results directory is enough");
  add_output(*run, arguments.options.directory,
             "Results directory; if left out, the case's name in the working folder");
  add_options(*run, run_options(arguments.options));
  accept_gone(*run, "--step-factor", 1,
              "--reduced-step is the step of a reduced wheel, in seconds");
  accept_gone(*run, "--snapshots", 1, "snapshots of a reduced wheel are fields");
  run->add_flag("--realtime-factor", arguments.realtime_factor,
                "Prints the ratio of simulated time to the time that the steps took");
  add_axes(*run, arguments.axes);
  add_telling(*run, tell, "Prints warnings and errors only");
  run->footer(
      "Example:\n  rondo run cases/ledge-smooth.toml -o results/mu06 --set ground.friction=0.6\n"
      "  rondo run results/mu06 --resume --set time.end=0.5\n"
      "Exit codes: 0 done, 2 wrong input, 3 numerical failure, 4 files, 130 interrupted.");
  return run;
}

CLI::App* add_check(CLI::App& program, RunArguments& arguments, Telling& tell) {
  CLI::App* check = program.add_subcommand(
      "check", "Validates a case and estimates its cost; runs nothing, writes nothing");
  add_case(*check, arguments);
  for (const study::Option& option : study::run_options(arguments.options))
    for (const std::string_view words :
         {"--threads,--jobs", "--reduced", "--modes", "--reduced-step"})
      if (option.words == words) add_option(*check, option);
  add_json(*check, tell);
  check->footer(
      "Example:\n  rondo check cases/ledge-smooth.toml --set disk.mesh.radial=24\n"
      "  rondo check cases/ledge-smooth.toml --reduced");
  return check;
}

CLI::App* add_reduce(CLI::App& program, study::ReduceRequest& r, Telling& tell) {
  CLI::App* reduce = program.add_subcommand(
      "reduce", "Keeps the modes of a reduced wheel in a file, with its matrices and tables");
  reduce
      ->add_option("case", r.sources,
                   "Case file, for its eigenmodes; or results directories of one disk, for the POD "
                   "of their displacements")
      ->required();
  add_output(*reduce, r.output, "File of the reduced wheel, e.g. wheel.h5")->required();
  add_settings(*reduce, r.settings,
               "KEY=VALUE, which overrides a key of the case, e.g. disk.mesh.radial=24; "
               "repeatable");
  add_options(*reduce, reduce_options(r));
  for (const char* gone : {"--displacement-modes", "--velocity-modes", "--tolerance",
                           "--velocity-tolerance", "--contact-weight", "--contact-stride",
                           "--contact-phases", "--contact", "--frame", "--memory"})
    accept_gone(*reduce, gone, 1,
                "reduced wheels have exact contact at the nodes; --modes sets their number of "
                "modes");
  accept_gone(*reduce, "--validate", 1, "rondo validate REDUCED FULL compares two runs");
  accept_gone(*reduce, "--no-error-estimate", 0, "rondo run --reduced --estimate estimates errors");
  add_telling(*reduce, tell, "Prints warnings and the results only");
  reduce->footer(
      "Example:\n  rondo reduce cases/rolling-flat.toml --modes 20 -o wheel.h5\n"
      "  rondo reduce results/mu0 results/mu06 --basis pod -o wheel.h5\n"
      "  rondo run cases/rolling-flat.toml --reduced wheel.h5 -o results/reduced\n"
      "Use, limits and accuracy: docs/reduced.md.");
  return reduce;
}

CLI::App* add_fmu(CLI::App& program, study::FmuRequest& r, Telling& tell) {
  CLI::App* fmu = program.add_subcommand(
      "fmu", "Makes an FMU (FMI 2.0, co-simulation) of a reduced wheel: hub motion in, forces out");
  fmu->add_option("case", r.case_file, "Case file of the wheel and its ground")->required();
  fmu->add_option("-o,--output", r.output, "File of the FMU, e.g. wheel.fmu")->required();
  add_settings(*fmu, r.settings, "KEY=VALUE, which overrides a key of the case; repeatable");
  add_options(*fmu, fmu_options(r));
  add_telling(*fmu, tell, "Prints warnings and errors only");
  fmu->footer(
      "Example:\n  rondo fmu cases/quarter-car-bump.toml -o wheel.fmu\n"
      "Inputs, outputs and coupling: docs/fmu.md.");
  return fmu;
}

CLI::App* add_pod(CLI::App& program, study::PodRequest& r, Telling& tell) {
  CLI::App* pod = program.add_subcommand(
      "pod", "Decomposes the snapshots of runs into proper orthogonal modes");
  pod->add_option("run", r.runs, "Results directories; several give one common basis")->required();
  add_options(*pod, pod_options(r));
  add_output(*pod, r.directory,
             "The results go to OUTPUT/<field>-<frame>; OUTPUT is RUN/pod if left out");
  add_telling(*pod, tell, "Prints warnings and the results only");
  pod->footer(
      "Example:\n  rondo pod results/ledge --field velocity --frame rectified --from 0.07\n"
      "Modes, spectrum and figures: docs/results.md.");
  return pod;
}

CLI::App* add_modes(CLI::App& program, ModesArguments& arguments, Telling& tell) {
  CLI::App* modes = program.add_subcommand(
      "modes",
      "Finds frequencies and shapes of a case's body, at rest and spinning, and critical speeds");
  add_case(*modes, arguments);
  add_output(
      *modes, arguments.request.run.directory,
      "Results directory; if left out, the case's name and \"-modes\" in the working folder");
  add_options(*modes, modes_options(arguments.request));
  add_telling(*modes, tell, "Prints warnings and the results only");
  modes->footer(
      "Example:\n  rondo modes cases/modes-annulus.toml -o results/modes --spins 0:400:41\n"
      "  rondo campbell results/modes\n"
      "Exit code 3: a spin beyond the softening limit. More: docs/modes.md.");
  return modes;
}

CLI::App* add_matrices(CLI::App& program, MatricesArguments& arguments, Telling& tell) {
  CLI::App* matrices = program.add_subcommand(
      "matrices", "Writes mass, damping, stiffness, gyroscopic matrix and contact rows of a case");
  add_case(*matrices, arguments);
  add_output(*matrices, arguments.request.output, "File of the matrices, e.g. matrices.h5")
      ->required();
  add_options(*matrices, matrices_options(arguments.request));
  add_telling(*matrices, tell, "Prints warnings and errors only");
  matrices->footer(
      "Example:\n  rondo matrices cases/rolling-flat.toml -o matrices.h5\n"
      "Equation, signs, layout of the file, a reduced model made from it: docs/operators.md.");
  return matrices;
}

CLI::App* add_schema(CLI::App& program, std::string& of) {
  CLI::App* schema = program.add_subcommand(
      "schema",
      "Prints a JSON Schema of case or study files, of run.json, or of what --json prints");
  schema
      ->add_option("of", of,
                   "Kind of file, or command with --json: "
                   "case | study | run.json | check | run | sweep | pod | reduce | fmu | modes | "
                   "matrices")
      ->required();
  schema->footer("Example:\n  rondo schema case > case.json\nFor editors: docs/machine.md.");
  return schema;
}

CLI::App* add_sweep(CLI::App& program, SweepArguments& arguments, Telling& tell) {
  study::SweepRequest& r = arguments.request;
  CLI::App* sweep = program.add_subcommand(
      "sweep", "Runs a parametric study: many runs of one case, on all cores or under mpirun");
  sweep->add_option("study", r.study, "Study file (TOML, docs/studies.md)")->required();
  add_output(*sweep, r.directory,
             "Directory of the study; if left out, its name in the working folder");
  add_settings(*sweep, r.settings,
               "KEY=VALUE, which overrides a key of the base case in all runs; repeatable");
  sweep
      ->add_option("--jobs,--threads", arguments.jobs,
                   "Number of runs at once, each on one core; all cores if left out")
      ->check(CLI::Range(1, 1024));
  sweep->add_flag("--dry-run", arguments.dry_run,
                  "Checks all runs and lists them with their expected cost; writes nothing");
  add_options(*sweep, sweep_options(r));
  sweep->add_option("--shard", arguments.shard,
                    "Part of the study that is made, i/n, for jobs that share only the directory");
  sweep->add_flag("--collect", arguments.collect,
                  "Writes the tables of all shards, the same as without --shard");
  add_axes(*sweep, arguments.axes);
  add_telling(*sweep, tell, "Prints warnings and errors only");
  sweep->footer(
      "Example:\n  rondo sweep cases/studies/traction.toml -o results/traction\n"
      "  mpirun -n 64 rondo sweep cases/studies/traction.toml -o results/traction\n"
      "  rondo sweep cases/studies/traction.toml -o results/traction --shard 3/16\n"
      "  rondo sweep cases/studies/traction.toml -o results/traction --collect\n"
      "A run that fails is recorded, and the others continue; the exit code is then that of the "
      "worst\n"
      "failure. The study file: docs/studies.md; clusters: docs/clusters.md.");
  return sweep;
}

}  // namespace rondo::app
