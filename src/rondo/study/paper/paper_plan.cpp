// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/paper_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rondo/study/paper/shipped_cases.hpp"

namespace rondo::study {
namespace {

using Settings = std::vector<std::string>;

/// Half the layers. The columns stay: with half of them the polygon of the mesh, or of the tread,
/// is felt in the contact, and rolling is no longer as reducible as the crush.
const Settings coarse_smooth{"disk.mesh.radial=6"};
const Settings coarse_treaded{"disk.mesh.radial=5", "disk.tread.layers=1"};

class PlanMaker {
 public:
  explicit PlanMaker(bool quick) : quick_(quick) {}

  void run(const std::string& name, const std::string& case_name, Settings settings,
           bool may_fail = false) {
    if (quick_) {
      const bool treaded = case_name.ends_with("treaded");
      const Settings& coarse = treaded ? coarse_treaded : coarse_smooth;
      settings.insert(settings.end(), coarse.begin(), coarse.end());
    }
    plan.runs.push_back({name, case_name, std::move(settings), may_fail});
  }

  /// `count` spans between snapshots, a fraction of them in the quick study.
  [[nodiscard]] std::string snapshots(int count, int quick_fraction) const {
    return fmt::format("output.snapshots={}", (quick_ ? count / quick_fraction : count) + 1);
  }

  PaperPlan plan;

 private:
  bool quick_;
};

/// Figure 2. At 50 rad/s what the printed scheme creates is seen in the swing after half a second;
/// at 200 rad/s it ends the run. The swing is the same all round: half the columns, and room for
/// eleven snapshots a period of 2.9 ms.
void add_spin_up(PlanMaker& make) {
  const std::string no_stress = "output.stress=false", printed = "time.scheme=as-printed";
  make.run("spin-up-damped", "spin-up-damped", {make.snapshots(600, 1), no_stress});
  Settings undamped{"time.end=0.5", "disk.mesh.circumferential=90", make.snapshots(2000, 1),
                    no_stress};
  make.run("spin-up-undamped", "spin-up-undamped", undamped);
  undamped.push_back(printed);
  make.run("spin-up-as-printed", "spin-up-undamped", undamped);
  const Settings fast{"motion.angular_velocity=200.0", "time.end=0.5", "time.safety=0.9",
                      "output.snapshots=0"};
  make.run("spin-up-fast", "spin-up-undamped", fast);
  Settings fast_printed = fast;
  fast_printed.push_back(printed);
  make.run("spin-up-fast-as-printed", "spin-up-undamped", fast_printed, true);
}

/// Figures 3 and 4: a snapshot each 0.25 ms meets the paper's times, 12.5, 62.5 and 100 ms. The
/// disk starts nearer to the ledge than in the case file, to be climbing at the first of them.
void add_ledge(PlanMaker& make) {
  for (const char* body : {"smooth", "treaded"})
    make.run(fmt::format("ledge-{}", body), fmt::format("ledge-{}", body),
             {"motion.start_x=-0.15", make.snapshots(480, 5)});
  for (const char* friction : {"0.0", "0.2", "0.4", "0.6"})
    make.run(fmt::format("friction-{}", friction), "ledge-smooth",
             {fmt::format("ground.friction={}", friction), "output.snapshots_from=0.095",
              make.snapshots(250, 1), "output.stress=false"});
}

/// Figures 5 and 6: one turn of steady rolling from 0.07 s on, and the crush. Ten snapshots a pitch
/// of the treaded disk: other numbers meet the tread in more phases (docs/validation.md, V20).
void add_turn_and_crush(PlanMaker& make) {
  make.run("turn-smooth", "ledge-smooth",
           {"time.end=0.2585", "output.snapshots_from=0.07", make.snapshots(594, 2),
            "output.stress=false"});
  make.run("turn-treaded", "ledge-treaded",
           {"time.end=0.2584956", "output.snapshots_from=0.07", make.snapshots(600, 2),
            "output.stress=false"});
  for (const char* body : {"smooth", "treaded"})
    make.run(fmt::format("crush-{}", body), fmt::format("crush-{}", body), {});
}

}  // namespace

PaperPlan paper_plan(bool quick) {
  PlanMaker make(quick);
  add_spin_up(make);
  add_ledge(make);
  add_turn_and_crush(make);
  for (const char* body : {"smooth", "treaded"})
    for (const char* field : {"velocity", "displacement", "contact"}) {
      for (const char* frame : {"rotating", "rectified"})
        make.plan.pods.push_back({fmt::format("turn-{}", body), field, frame});
      make.plan.pods.push_back({fmt::format("crush-{}", body), field, "rotating"});
    }
  return std::move(make.plan);
}

Case case_of(const PaperRun& run) {
  return read_case_text("cases/" + run.case_name + ".toml",
                        std::string(shipped_case(run.case_name)), run.settings);
}

std::string command_of(const PaperRun& run, const std::filesystem::path& directory) {
  std::string command = fmt::format("rondo run cases/{}.toml -o {}", run.case_name,
                                    (directory / "runs" / run.name).string());
  for (const std::string& setting : run.settings) command += " --set " + setting;
  return command;
}

std::string command_of(const PaperPod& pod, const std::filesystem::path& directory) {
  return fmt::format("rondo pod {} --field {} --frame {} --modes {} --reconstruct 0",
                     (directory / "runs" / pod.run).string(), pod.field, pod.frame, paper_modes);
}

}  // namespace rondo::study
