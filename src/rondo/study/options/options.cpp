// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/options/options.hpp"

namespace rondo::study {
namespace {

/// The options `--from` and `--to` of a time window.
Option first_time(std::optional<double>& from) {
  return {"--from", "from_time", &from, "Time of the first snapshot used", "s"};
}
Option last_time(std::optional<double>& to) {
  return {"--to", "to_time", &to, "Time of the last snapshot used", "s"};
}

constexpr OtherOption reduced_run{"--reduced", "reduced", "is an option of a reduced run",
                                  "with reduced = 'case', or a file of rondo.reduce"};
constexpr OtherOption not_overwrite{"--overwrite", "overwrite",
                                    "continues what overwrite would remove", "one of the two"};

}  // namespace

Option threads_option(int& threads) {
  return {.words = "--threads,--jobs",
          .python = "threads",
          .target = &threads,
          .help = "Number of threads; chosen by the size of the case if left out",
          .range = OptionRange{1, 1024}};
}

Options run_options(RunOptions& r) {
  return {
      threads_option(r.threads),
      {"--overwrite", "overwrite", &r.overwrite, "Replaces the results of another run"},
      {.words = "--resume",
       .python = "resume",
       .target = &r.resume,
       .help =
           "Resumes the run from its last checkpoint, with bitwise the same results; begins it if "
           "there is none; with a later time.end a finished run continues",
       .excludes = not_overwrite},
      {"--modes-from", "modes_from", &r.modes_from,
       "Results directory of a run of the same body; a crush by analysis.solver = latin-pgd begins "
       "with the modes of this run"},
      {.words = "--reduced",
       .python = "reduced",
       .target = &r.reduced,
       .help = "Runs a reduced wheel instead of the mesh: one made of the case, or one with the "
               "modes in this file (rondo reduce); docs/reduced.md",
       .in_python =
           "Runs a reduced wheel instead of the mesh: `case` for one made of the case, or a "
           "file of rondo.reduce",
       .alone = wheel_of_case},
      {.words = "--modes",
       .python = "modes",
       .target = &r.reduced_modes,
       .help =
           "Number of modes of a reduced wheel made of the case; chosen by its step if left out",
       .needs = reduced_run},
      {.words = "--estimate",
       .python = "estimate",
       .target = &r.reduced_estimate,
       .help = "Runs a reduced wheel again, with half the step and with twice the modes, and tells "
               "how far its mean forces differ",
       .needs = reduced_run},
      {.words = "--reduced-step",
       .python = "reduced_step",
       .target = &r.reduced_step,
       .help = "Step of a reduced wheel; chosen by spin and contact if left out",
       .unit = "s",
       .needs = reduced_run},
      {.words = "--law-residual",
       .python = "law_residual",
       .target = &r.law_residual,
       .help =
           "Largest residual of the law of contact of a reduced wheel in three dimensions, over "
           "the largest force; 1e-6 if left out",
       .needs = reduced_run},
  };
}

Options modes_options(ModesRequest& r) {
  return {
      {.words = "--count",
       .python = "count",
       .target = &r.count,
       .help = "Number of modes at each spin, besides rigid-body motions",
       .range = OptionRange{1, 100000}},
      {"--spin", "spins", &r.spins,
       "Rotation speeds, > 0 rolls towards +x; if left out, 0 and that of the case at t = 0",
       "rad/s"},
      {"--spins", "sweep", &r.sweep,
       "Rotation speeds, FROM:TO:NUMBER, at which the frequencies of a Campbell diagram are found",
       "rad/s"},
      {.words = "--diameters",
       .python = "diameters",
       .target = &r.diameters,
       .help = "Largest number of nodal diameters for critical speeds",
       .range = OptionRange{0, 1000000}},
      {"--standing", "standing", &r.standing,
       "Holds the nodes of a wheel in three dimensions that touch the ground when it is pressed at "
       "rest to motion.height, or under analysis.load: in all directions, or without friction "
       "along "
       "the normal"},
      {"--overwrite", "overwrite", &r.run.overwrite, "Replaces the results of another run"},
  };
}

Options pod_options(PodRequest& r) {
  return {
      {"--field", "field", &r.field, "Field that is decomposed", "",
       "displacement | velocity | contact"},
      {"--frame", "frame", &r.frame, "Frame of the modes", "", "co-rotating | rectified"},
      first_time(r.from),
      last_time(r.to),
      {"--modes", "modes", &r.modes,
       "Number of modes; if left out, as many as leave out 1e-6 of the energy"},
      {"--weight", "weight", &r.weight, "Norm; default mass, delassus for contact", "",
       "mass | delassus | none"},
      {"--shift", "shift", &r.shift, "Rectification by the angle itself or by whole sectors", "",
       "fourier | pitch"},
      {"--memory", "memory", &r.memory,
       "Memory limit, e.g. 500MB; snapshots that exceed it are streamed"},
      {"--method", "method", &r.method, "Method of the decomposition", "",
       "auto | direct | tsqr | incremental"},
      {"--reconstruct", "reconstruct", &r.reconstruct,
       "Number of snapshots rebuilt from the modes for ParaView; 0: none"},
  };
}

Options reduce_options(ReduceRequest& r) {
  return {
      {"--basis", "basis", &r.basis,
       "Modes of the wheel: those of a case at rest, or those of displacements that runs went "
       "through; by default by what is named",
       "", "eigenmodes | pod"},
      {"--modes", "modes", &r.modes,
       "Number of modes; if left out, chosen as for rondo run --reduced, of a POD 40"},
      first_time(r.from),
      last_time(r.to),
  };
}

Options sweep_options(SweepRequest& r) {
  return {
      {"--overwrite", "overwrite", &r.overwrite, "Replaces another sweep's results"},
      {.words = "--resume",
       .python = "resume",
       .target = &r.resume,
       .help = "Resumes a sweep, or a shard, that was interrupted",
       .excludes = not_overwrite},
  };
}

Options fmu_options(FmuRequest& r) {
  return {
      {.words = "--modes",
       .python = "modes",
       .target = &r.modes,
       .help = "Number of modes; if left out, chosen as for rondo run --reduced"},
      {.words = "--reduced-step",
       .python = "reduced_step",
       .target = &r.step,
       .help = "Largest internal step; if left out, chosen as for rondo run --reduced",
       .unit = "s"},
  };
}

Options matrices_options(MatricesRequest& r) {
  return {{"--time", "", &r.time, "Time at which the contact rows are those of the motion", "s"}};
}

}  // namespace rondo::study
