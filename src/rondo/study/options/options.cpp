// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/options/options.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view memory_help = "Memory allowed to the decompositions, e.g. 500MB";

/// Of `from` and `to` of a window.
Option first_time(std::optional<double>& from) {
  return {"--from", "from_time", &from, "Time of the first snapshot that is taken", "s"};
}
Option last_time(std::optional<double>& to) {
  return {"--to", "to_time", &to, "Time of the last snapshot that is taken", "s"};
}

constexpr OtherOption reduced_run{"--reduced", "reduced", "is of a reduced run",
                                  "with reduced = a model of rondo.reduce"};
constexpr OtherOption not_overwrite{"--overwrite", "overwrite",
                                    "goes on with what overwrite would remove", "one of both"};

}  // namespace

Option threads_option(int& threads) {
  return {.words = "--threads,--jobs",
          .python = "threads",
          .target = &threads,
          .help = "Number of cores that the threads of the run use; chosen by size if left out",
          .range = OptionRange{1, 1024}};
}

Options run_options(RunOptions& r) {
  return {
      threads_option(r.threads),
      {"--overwrite", "overwrite", &r.overwrite,
       "Replaces the results of another run in the results directory"},
      {.words = "--resume",
       .python = "resume",
       .target = &r.resume,
       .help =
           "Resumes the run in the results directory from its last checkpoint, with bitwise the "
           "same results; begins it where there is none; continues a finished run to a later "
           "time.end",
       .excludes = not_overwrite},
      {"--modes-from", "modes_from", &r.modes_from,
       "Results directory of a run of the same body; a crush by "
       "analysis.solver = latin-pgd begins with its modes"},
      {"--reduced", "reduced", &r.reduced,
       "Model (rondo reduce) on whose modes the case is run instead of its mesh; docs/reduced.md"},
      {.words = "--step-factor",
       .python = "step_factor",
       .target = &r.step_factor,
       .help = "Step of a reduced run over that of the full run",
       .needs = reduced_run},
      {.words = "--reduced-step",
       .python = "reduced_step",
       .target = &r.reduced_step,
       .help = "Scheme of a reduced run, implicit or by central differences",
       .choices = "midpoint | explicit",
       .needs = reduced_run},
      {.words = "--snapshots",
       .python = "snapshots",
       .target = &r.reduced_snapshots,
       .help = "Snapshots of a reduced run, as fields, or as coordinates of the modes alone, which "
               "are far "
               "cheaper, have no stress, and are lifted when they are read in Python",
       .choices = "fields | modes",
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
       "Rotation speeds, > 0 where the body rolls towards +x; rest and the case's own at t = 0 if "
       "left out",
       "rad/s"},
      {"--spins", "sweep", &r.sweep,
       "Rotation speeds, FROM:TO:NUMBER, at which the frequencies of a Campbell diagram are found",
       "rad/s"},
      {.words = "--diameters",
       .python = "diameters",
       .target = &r.diameters,
       .help = "Largest number of nodal diameters of the waves whose critical speeds are found",
       .range = OptionRange{0, 1000000}},
      {"--overwrite", "overwrite", &r.run.overwrite,
       "Replaces what another run has left in the results directory"},
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
       "Number of modes that are kept; as many as leave 1e-6 of the energy if left out"},
      {"--weight", "weight", &r.weight,
       "Weight of the inner product; mass if left out, delassus for contact", "",
       "mass | delassus | none"},
      {"--shift", "shift", &r.shift, "Rectification by the angle itself or by whole sectors", "",
       "fourier | pitch"},
      {"--memory", "memory", &r.memory,
       "Memory allowed, e.g. 500MB; beyond it snapshots are streamed"},
      {"--method", "method", &r.method, "Method of the decomposition", "",
       "auto | direct | tsqr | incremental"},
      {"--reconstruct", "reconstruct", &r.reconstruct,
       "Number of snapshots that are rebuilt from the modes, for ParaView; 0: none"},
  };
}

Options reduce_options(ReduceRequest& r) {
  return {
      {"--displacement-modes", "displacement_modes", &r.displacement_modes,
       "Number of modes of the displacements, each with its derivative by the angle; 30 if left "
       "out"},
      {"--velocity-modes", "velocity_modes", &r.velocity_modes,
       "Number of modes of the velocities; 30 if left out"},
      {"--tolerance", "tolerance", &r.displacement_tolerance,
       "Share of the displacements' energy that is left out, instead of a number of modes"},
      {"--velocity-tolerance", "velocity_tolerance", &r.velocity_tolerance,
       "Share of the velocities' energy that is left out, instead of a number of modes"},
      {"--contact-weight", "contact_weight", &r.contact_weight,
       "Weight that the motion of the boundary near the contact has in choosing modes, over that "
       "of "
       "the mass; 0: none"},
      first_time(r.from),
      last_time(r.to),
      {.words = "--contact-stride",
       .python = "contact_stride",
       .target = &r.contact_stride,
       .help =
           "Number of boundary nodes to a contact point, which divides their number; as many as "
           "leave 180 points if left out",
       .range = OptionRange{1, 1000000}},
      {.words = "--contact-phases",
       .python = "contact_phases",
       .target = &r.contact_phases,
       .help = "Number of contact points to a node of the boundary, those between two nodes where "
               "nodes come by; to compare with",
       .range = OptionRange{1, 16}},
      {"--contact", "contact", &r.contact,
       "Points of contact that stand still in space, or the nodes that come by; places on a smooth "
       "disk if left out, nodes otherwise",
       "", "places | nodes"},
      {"--frame", "frame", &r.frame,
       "Frame of the modes; co-rotating, with the disk, to compare with", "",
       "rectified | co-rotating"},
      {"--memory", "memory", &r.memory, memory_help},
      {.words = "--no-error-estimate",
       .python = "error_estimate",
       .target = &r.error_estimate,
       .help = "Leaves out the prediction of each run from the others, which is made by default of "
               "3 runs or more",
       .in_python = "Prediction of each run from the others, where there are 3 runs or more"},
  };
}

Options sweep_options(SweepRequest& r) {
  return {
      {"--overwrite", "overwrite", &r.overwrite,
       "Replaces another sweep in the directory of the study"},
      {.words = "--resume",
       .python = "resume",
       .target = &r.resume,
       .help = "Resumes a sweep, or a shard, that was interrupted",
       .excludes = not_overwrite},
  };
}

Options fmu_options(FmuRequest& r) {
  return {
      {"--case", "case", &r.case_file,
       "Case file with ground, dampings, gravity and start of the wheel; the case of the first run "
       "behind the model if left out"},
      {"--step-factor", "step_factor", &r.step_factor,
       "Largest internal step over that of the full run"},
  };
}

}  // namespace rondo::study
