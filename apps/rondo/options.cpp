// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "rondo/core/error.hpp"

namespace rondo::app {
namespace {

void add_case(CLI::App& command, CaseArguments& arguments,
              const char* what = "case file (TOML, docs/cases.md)") {
  command.add_option("case", arguments.case_file, what)->required();
  command
      .add_option("--set", arguments.settings,
                  "KEY=VALUE: overrides a key of the case, e.g. ground.friction=0.6; repeatable")
      ->take_all()
      ->expected(1);
}

void add_threads(CLI::App& command, int& threads) {
  command
      .add_option("--threads,--jobs", threads,
                  "number of threads; chosen by the size of the case if left out")
      ->check(CLI::Range(1, 1024));
}

void add_json(CLI::App& command, Telling& tell) {
  command.add_flag("--json", tell.json,
                   "prints one JSON document, also if the command fails (docs/machine.md)");
}

void add_telling(CLI::App& command, Telling& tell, const char* quiet) {
  command.add_flag("--quiet", tell.quiet, quiet);
  add_json(command, tell);
}

void add_reduced(CLI::App& run, study::RunOptions& options) {
  CLI::Option* reduced = run.add_option(
      "--reduced", options.reduced,
      "uses the modes of this model (rondo reduce) instead of the mesh; docs/reduced.md");
  run.add_option("--step-factor", options.step_factor,
                 "step of a reduced run over that of the full run")
      ->capture_default_str()
      ->needs(reduced);
  run.add_option("--reduced-step", options.reduced_step,
                 "midpoint | explicit: scheme of a reduced run; implicit, or central differences")
      ->capture_default_str()
      ->needs(reduced);
  run.add_option(
         "--snapshots", options.reduced_snapshots,
         "fields | modes: snapshots of a reduced run; modes: coordinates only, far cheaper, "
         "no stress; Python computes the fields from them")
      ->capture_default_str()
      ->needs(reduced);
}

}  // namespace

CLI::App* add_run(CLI::App& program, RunArguments& arguments, Telling& tell) {
  study::RunOptions& options = arguments.options;
  CLI::App* run = program.add_subcommand("run", "runs a case into a results directory");
  add_case(*run, arguments,
           "case file (TOML, docs/cases.md); with --resume a results directory is enough");
  add_threads(*run, options.threads);
  run->add_option("-o,--output", options.directory,
                  "results directory; if left out, the case's name in the working folder")
      ->check(refuse_empty);
  CLI::Option* overwrite =
      run->add_flag("--overwrite", options.overwrite, "replaces the results of another run");
  run->add_flag("--resume", options.resume,
                "resumes the run from its last checkpoint, with bitwise the same results; begins "
                "it if there is none; with a later time.end a finished run continues")
      ->excludes(overwrite);
  run->add_option("--modes-from", options.modes_from,
                  "for a crush by analysis.solver = latin-pgd: begins with the modes of this run "
                  "of the same body")
      ->type_name("RUN");
  add_reduced(*run, options);
  run->add_flag("--realtime-factor", arguments.realtime_factor,
                "prints the ratio of simulated time to the time that the steps took");
  add_telling(*run, tell, "prints warnings and errors only");
  run->footer(
      "Example:\n  rondo run cases/ledge-smooth.toml -o results/mu06 --set ground.friction=0.6\n"
      "  rondo run results/mu06 --resume --set time.end=0.5\n"
      "Exit codes: 0 done, 2 wrong input, 3 numerical failure, 4 files, 130 interrupted.");
  return run;
}

CLI::App* add_check(CLI::App& program, CaseArguments& arguments, int& threads, Telling& tell) {
  CLI::App* check = program.add_subcommand(
      "check", "validates a case and estimates its cost; runs nothing, writes nothing");
  add_case(*check, arguments);
  add_threads(*check, threads);
  add_json(*check, tell);
  check->footer("Example:\n  rondo check cases/ledge-smooth.toml --set disk.mesh.radial=24");
  return check;
}

CLI::App* add_reduce(CLI::App& program, study::ReduceRequest& r, Telling& tell) {
  CLI::App* reduce = program.add_subcommand(
      "reduce", "makes a reduced model of a rolling disk from the snapshots of runs");
  reduce
      ->add_option("run", r.runs,
                   "results directories of one disk; friction, speed, height and spin may differ")
      ->required();
  reduce->add_option("-o,--output", r.output, "file of the reduced model, e.g. model.h5")
      ->required()
      ->check(refuse_empty);
  reduce->add_option(
      "--displacement-modes", r.displacement_modes,
      "number of displacement modes, each with its derivative by the angle; 30 if left out");
  reduce->add_option("--velocity-modes", r.velocity_modes,
                     "number of velocity modes; 30 if left out");
  reduce->add_option("--tolerance", r.displacement_tolerance,
                     "share of the displacements' energy left out, instead of a number of modes");
  reduce->add_option("--velocity-tolerance", r.velocity_tolerance, "tolerance for the velocities");
  reduce
      ->add_option(
          "--contact-weight", r.contact_weight,
          "weight of the boundary's motion near the contact in the choice of modes, relative "
          "to that of the mass; 0: none")
      ->capture_default_str();
  reduce->add_option("--from", r.from, "time of the first snapshot used [s]");
  reduce->add_option("--to", r.to, "time of the last snapshot used [s]");
  reduce
      ->add_option(
          "--contact-stride", r.contact_stride,
          "boundary nodes for each contact point, a divisor of their number; if left out, as "
          "many as give 180 points")
      ->check(CLI::Range(1, 1000000));
  reduce
      ->add_option("--contact-phases", r.contact_phases,
                   "contact points for each boundary node; more than 1 also lie between nodes, for "
                   "comparisons")
      ->capture_default_str()
      ->check(CLI::Range(1, 16));
  reduce->add_option(
      "--contact", r.contact,
      "places | nodes: contact points that are fixed in space, or the nodes that pass by; if left "
      "out, places on a smooth disk, nodes otherwise");
  reduce
      ->add_option("--frame", r.frame,
                   "rectified | co-rotating: frame of the modes; co-rotating (with the disk) for "
                   "comparisons")
      ->capture_default_str();
  reduce->add_option("--memory", r.memory, "memory limit of the decompositions")
      ->capture_default_str();
  reduce->add_flag_callback(
      "--no-error-estimate", [&r] { r.error_estimate = false; },
      "makes no error estimate, which by default predicts each of 3 or more runs from the others");
  reduce
      ->add_option_function<std::string>(
          "--validate",
          [](const std::string&) {
            throw InputError(Fault{"rondo reduce --validate", 0, 0, "", "",
                                   "is not part of this command",
                                   "rondo run CASE --reduced MODEL -o REDUCED, then rondo validate "
                                   "REDUCED RUN"});
          })
      ->group("");  // not in the help
  add_telling(*reduce, tell, "prints warnings and the results only");
  reduce->footer(
      "Example:\n  rondo reduce results/mu0 results/mu06 -o model.h5\n"
      "  rondo run cases/rolling-flat.toml --reduced model.h5 -o results/reduced\n"
      "  rondo validate results/reduced results/full\n"
      "Use, limits and accuracy: docs/reduced.md.");
  return reduce;
}

CLI::App* add_pod(CLI::App& program, study::PodRequest& r, Telling& tell) {
  CLI::App* pod =
      program.add_subcommand("pod", "proper orthogonal decomposition of the snapshots of runs");
  pod->add_option("run", r.runs, "results directories; several give one common basis")->required();
  pod->add_option("--field", r.field, "displacement | velocity | contact")->capture_default_str();
  pod->add_option("--frame", r.frame, "co-rotating | rectified")->capture_default_str();
  pod->add_option("--from", r.from, "time of the first snapshot used [s]");
  pod->add_option("--to", r.to, "time of the last snapshot used [s]");
  pod->add_option("--modes", r.modes,
                  "number of modes; if left out, as many as leave out 1e-6 of the energy");
  pod->add_option("--weight", r.weight,
                  "mass | delassus | none: norm; if left out mass, delassus for contact");
  pod->add_option("--shift", r.shift,
                  "fourier | pitch: fields are rectified by the angle itself or by whole sectors")
      ->capture_default_str();
  pod->add_option("--memory", r.memory,
                  "memory limit, e.g. 500MB; snapshots that exceed it are streamed")
      ->capture_default_str();
  pod->add_option("--method", r.method, "auto | direct | tsqr | incremental")
      ->capture_default_str();
  pod->add_option("--reconstruct", r.reconstruct,
                  "number of snapshots rebuilt from the modes for ParaView; 0: none")
      ->capture_default_str();
  pod->add_option("-o,--output", r.directory,
                  "the results go to OUTPUT/<field>-<frame>; OUTPUT is RUN/pod if left out")
      ->check(refuse_empty);
  add_telling(*pod, tell, "prints warnings and the results only");
  pod->footer(
      "Example:\n  rondo pod results/ledge --field velocity --frame rectified --from 0.07\n"
      "Modes, spectrum and figures: docs/results.md.");
  return pod;
}

CLI::App* add_modes(CLI::App& program, ModesArguments& arguments, Telling& tell) {
  CLI::App* modes = program.add_subcommand(
      "modes", "frequencies and shapes of a case's body, at rest and spinning; critical speeds");
  study::ModesRequest& r = arguments.request;
  add_case(*modes, arguments);
  modes
      ->add_option(
          "-o,--output", r.run.directory,
          "results directory; if left out, the case's name and \"-modes\" in the working folder")
      ->check(refuse_empty);
  modes->add_option("--count", r.count, "number of modes at each spin, besides rigid-body motions")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  modes->add_option("--spin", r.spins,
                    "rotation speeds [rad/s], > 0 rolls towards +x; if left out, 0 and that of the "
                    "case at t = 0");
  modes->add_option(
      "--spins", r.sweep,
      "FROM:TO:NUMBER [rad/s]: frequencies over the rotation speed, for a Campbell diagram");
  modes->add_option("--diameters", r.diameters, "largest number of diameters for critical speeds")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  modes->add_flag("--overwrite", r.run.overwrite, "replaces the results of another run");
  add_telling(*modes, tell, "prints warnings and the results only");
  modes->footer(
      "Example:\n  rondo modes cases/modes-annulus.toml -o results/modes --spins 0:400:41\n"
      "  rondo campbell results/modes\n"
      "Exit code 3: a spin beyond the softening limit. More: docs/modes.md.");
  return modes;
}

CLI::App* add_schema(CLI::App& program, std::string& of) {
  CLI::App* schema = program.add_subcommand(
      "schema", "prints a JSON Schema of case or study files, or of what --json prints");
  schema->add_option("of", of, "case | study | check | run | sweep | pod | reduce | fmu | modes")
      ->required();
  schema->footer("Example:\n  rondo schema case > case.json\nFor editors: docs/machine.md.");
  return schema;
}

CLI::App* add_sweep(CLI::App& program, SweepArguments& arguments, Telling& tell) {
  study::SweepRequest& r = arguments.request;
  CLI::App* sweep = program.add_subcommand(
      "sweep", "runs a parametric study: many runs of one case, on all cores or under mpirun");
  sweep->add_option("study", r.study, "study file (TOML, docs/studies.md)")->required();
  sweep
      ->add_option("-o,--output", r.directory,
                   "directory of the study; if left out, its name in the working folder")
      ->check(refuse_empty);
  sweep
      ->add_option("--set", r.settings,
                   "KEY=VALUE: overrides a key of the base case in all runs; repeatable")
      ->take_all()
      ->expected(1);
  sweep
      ->add_option("--jobs,--threads", arguments.jobs,
                   "number of runs at once, each on one core; all cores if left out")
      ->check(CLI::Range(1, 1024));
  sweep->add_flag("--dry-run", arguments.dry_run,
                  "checks all runs and lists them with their expected cost; writes nothing");
  CLI::Option* overwrite =
      sweep->add_flag("--overwrite", r.overwrite, "replaces another sweep's results");
  sweep->add_flag("--resume", r.resume, "resumes a sweep, or a shard, that was interrupted")
      ->excludes(overwrite);
  sweep->add_option("--shard", arguments.shard,
                    "i/n: makes part i of n, for jobs that share only the directory");
  sweep->add_flag("--collect", arguments.collect,
                  "writes the tables of all shards, the same as without --shard");
  add_telling(*sweep, tell, "prints warnings and errors only");
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
