// SPDX-License-Identifier: BSD-3-Clause
/// The record of a study as `rondo paper` finds it again: what is there already, and the table
/// from it. Input: the files run.json, history.csv, pod.json, spectrum.csv in parts (fuzz.hpp),
/// which all runs and PODs of the study share; BUILD_ID in them stands for that of this program.
#include <cmath>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/core/build_id.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/paper/paper_checks.hpp"
#include "rondo/study/paper/paper_jobs.hpp"
#include "tiny_run.hpp"

using namespace rondo;
namespace fs = std::filesystem;

namespace {

const fs::path& study_folder() {
  static const fs::path folder = fuzz::scratch_folder() / "study";
  return folder;
}

const fs::path& run_folder() {
  static const fs::path folder = fuzz::scratch_folder() / "run";
  return folder;
}

const study::PaperPlan& plan() {
  static const study::PaperPlan quick = study::paper_plan(true);
  return quick;
}

/// Only the first run and its POD are looked for: the others would say the same.
study::PaperPlan short_plan() {
  study::PaperPlan few;
  few.runs = {plan().runs.front()};
  few.pods = {{few.runs.front().name, plan().pods.front().field, plan().pods.front().frame}};
  return few;
}

void link_pod(const std::string& name) {
  fs::create_directories(run_folder() / "pod");
  if (!fs::exists(run_folder() / "pod" / name))
    fs::create_symlink(run_folder() / "a-pod", run_folder() / "pod" / name);
}

void put_files(std::string_view text) {
  for (fuzz::Part part; fuzz::next_part(text, part);) {
    std::string content(part.text);
    if (const auto at = content.find("BUILD_ID"); at != std::string::npos)
      content.replace(at, 8, study::build_id());
    for (const char* name : {"run.json", "history.csv"})
      if (part.name == name) fuzz::put(run_folder() / name, content);
    for (const char* name : {"pod.json", "spectrum.csv"})
      if (part.name == name) fuzz::put(run_folder() / "a-pod" / name, content);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::make_tiny_run(run_folder());
  fuzz::put(run_folder() / "case.toml",
            study::write_case(study::kept_case(study::case_of(plan().runs.front()))));
  fs::create_directories(study_folder() / "runs");
  fs::create_directories(run_folder() / "a-pod");
  fs::copy_file(run_folder() / "results.h5", run_folder() / "a-pod" / "pod.h5");
  for (const study::PaperRun& run : plan().runs)
    fs::create_symlink(run_folder(), study_folder() / "runs" / run.name);
  for (const study::PaperPod& pod : plan().pods) link_pod(pod.field + "-" + pod.frame);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const char* name : {"run.json", "history.csv", "a-pod/pod.json", "a-pod/spectrum.csv"})
    fs::remove(run_folder() / name);
  put_files(fuzz::view(data, size));
  fuzz::accepted([] { static_cast<void>(study::paper_jobs(study_folder(), short_plan(), false)); });
  fuzz::accepted([] {
    for (const study::PaperRow& row : study::check_rolling(study_folder(), plan(), false))
      fuzz::check(std::isfinite(row.ours) || !study::passes(row), "no number passes");
  });
  return 0;
}
