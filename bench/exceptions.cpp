// SPDX-License-Identifier: BSD-3-Clause
/// Cost of nodal loads, a free rim, massless contact nodes, implicit elements and sharp corners of
/// the ground in the fused steps, in ns per degree of freedom and step, compared with the same disk
/// without them: `bench_exceptions [ROUNDS [LAYERS]]`. The runs of a line alternate, and the
/// smallest time of a batch of 64 steps counts, because the machine may do other work.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "problem.hpp"

using namespace rondo;
using bench::Steps;
using bench::Variant;

namespace {

struct Size {
  int radial, circumferential;
};

/// A ridge of 1 mm that alone supports the disk.
contact::GroundShape ridge(double fillet) {
  return {.profile = {{-1.0, 0.0}, {-0.01, 0.0}, {0.0, 0.001}, {0.01, 0.0}, {1.0, 0.0}},
          .fillet = fillet};
}

/// The ground ends 40 mm before the middle of the patch.
contact::GroundShape end_of_ground(double fillet) {
  return {.profile = {{-1.0, 0.0}, {0.04, 0.0}, {0.04, -0.1}, {1.0, -0.1}}, .fillet = fillet};
}

/// One run of a line, and the smallest time of its batches.
class Run {
 public:
  Run(Size size, Steps steps, const Variant& variant) : problem_(disk(size)), reports_(64) {
    problem_.stand_at(variant.ground.profile.size() == 5 ? 0.3009 : 0.2995);
    integrator_ = problem_.integrator(steps, variant);
  }

  void round(double seconds) {
    using Clock = std::chrono::steady_clock;
    for (double all = 0.0; all < seconds;) {
      const auto begin = Clock::now();
      integrator_->advance(reports_);
      const double time = std::chrono::duration<double>(Clock::now() - begin).count();
      all += time;
      best_ = std::min(best_, time);
      ++batches_;
      for (const dynamics::StepReport& report : reports_)
        touched_ += report.contact.cluster_largest > 0;
    }
    if (!(reports_.back().balance.relative < 1e-12)) {
      fmt::print(stderr, "the ledger does not close: {:.2g}\n", reports_.back().balance.relative);
      std::exit(1);
    }
  }
  [[nodiscard]] double ns() const {
    return 1e9 * best_ / (64.0 * static_cast<double>(problem_.n_dofs()));
  }
  /// Fraction of the steps in which a corner touched.
  [[nodiscard]] double touched() const {
    return static_cast<double>(touched_) / (64.0 * static_cast<double>(batches_));
  }

 private:
  static mesh::Disk disk(Size size) {
    mesh::Disk disk;
    disk.radial = size.radial;
    disk.circumferential = size.circumferential;
    return disk;
  }

  bench::Problem problem_;
  std::unique_ptr<dynamics::Integrator> integrator_;
  std::vector<dynamics::StepReport> reports_;
  double best_ = 1e9;  ///< [s]
  long batches_ = 0, touched_ = 0;
};

/// Compares a disk without and with the feature.
void compare(std::string_view what, Size size, Steps steps, const Variant& without,
             const Variant& with, int rounds) {
  Run plain(size, steps, without), other(size, steps, with);
  for (int i = 0; i < rounds; ++i)
    for (Run* run : {&plain, &other}) run->round(0.05);
  fmt::print("| {}×{} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.0f} % |\n", size.radial,
             size.circumferential, bench::name_of(steps), what, plain.ns(), other.ns(),
             other.ns() / plain.ns(), 100.0 * other.touched());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 20;
  const int layers = argc > 2 ? std::atoi(argv[2]) : 0;  // 0: all meshes
  fmt::print(
      "| mesh | operator | with | without (ns) | with (ns) | ratio | steps with a corner |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  const Variant flat{.rolling = true};
  const auto with = [&](double pressure, const contact::GroundShape& ground) {
    return Variant{.rolling = true, .ground = ground, .pressure = pressure};
  };
  for (const Size size : {Size{12, 180}, Size{26, 390}, Size{82, 1230}, Size{260, 3900}})
    for (const Steps steps : {Steps::cyclic, Steps::sparse}) {
      if (layers != 0 && size.radial != layers) continue;
      if (steps == Steps::sparse && size.radial > 100) continue;  // as on the smaller mesh
      compare("pressure", size, steps, flat, with(1e5, {}), rounds);
      compare("loaded rim", size, steps, flat, Variant{.rolling = true, .loaded_rim = true},
              rounds);
      compare("massless contact nodes", size, steps, flat,
              Variant{.rolling = true, .massless = true}, rounds);
      compare("one implicit layer", size, steps, flat,
              Variant{.rolling = true, .implicit_layer = size.radial / 2}, rounds);
      compare("sharp corner beside the patch", size, steps, with(0.0, end_of_ground(0.002)),
              with(0.0, end_of_ground(0.0)), rounds);
      compare("stands on a sharp corner", size, steps, with(0.0, ridge(0.002)),
              with(0.0, ridge(0.0)), rounds);
    }
}
