// SPDX-License-Identifier: BSD-3-Clause
/// A results directory: all its fields, and a POD of them. Input: "P" and patches (mutate.hpp) of
/// the results.h5 of a small run; or the bytes of a results.h5, which begin with HDF5's mark; or
/// else the text of run.json.
#include <array>
#include <cmath>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/reduction/decompose.hpp"
#include "rondo/study/paper_results.hpp"
#include "rondo/study/pod_input.hpp"
#include "tiny_run.hpp"

using namespace rondo;

namespace {

constexpr char hdf5_mark = '\x89', patch_mark = 'P';
constexpr std::size_t mark_length = 8;

bool is_hdf5(std::string_view bytes) {
  return bytes.starts_with(hdf5_mark);
}

bool is_patches(std::string_view bytes) {
  return bytes.starts_with(patch_mark);
}

/// Of the small run.
struct Base {
  std::string results, summary;
};
Base& base() {
  static Base files;
  return files;
}

const std::filesystem::path& run_folder() {
  static const std::filesystem::path folder = fuzz::scratch_folder() / "run";
  return folder;
}

void put_run(std::string_view bytes) {
  const bool patches = is_patches(bytes), hdf5 = is_hdf5(bytes);
  fuzz::put(run_folder() / "results.h5", patches ? fuzz::patched(base().results, bytes.substr(1))
                                         : hdf5  ? std::string(bytes)
                                                 : base().results);
  fuzz::put(run_folder() / "run.json", patches || hdf5 ? base().summary : std::string(bytes));
}

void read_fields(const io::RunReader& run) {
  for (const auto quantity :
       {io::Quantity::displacement, io::Quantity::velocity, io::Quantity::contact}) {
    if (!run.has(quantity)) continue;
    std::vector<Vec2> field(run.n_points(quantity));
    for (std::size_t k = 0; k < run.n_snapshots(); ++k) run.read(quantity, k, 0, field);
  }
  for (std::size_t k = 1; k < run.n_snapshots(); ++k)
    fuzz::check(run.times().time[k] > run.times().time[k - 1], "times that do not rise");
}

study::PodRequest request_of(std::uint32_t choice) {
  static constexpr std::array fields{"displacement", "velocity", "contact"};
  study::PodRequest request;
  request.runs = {run_folder()};
  request.field = fields[choice % 3];
  request.frame = choice / 3 % 2 == 0 ? "rotating" : "rectified";
  request.shift = choice / 6 % 2 == 0 ? "fourier" : "pitch";
  request.directory = fuzz::scratch_folder() / "pod";
  return request;
}

void decompose(const study::PodRequest& request) {
  const study::SnapshotChoice choice = study::choice_of(request);
  const std::vector<io::RunReader> runs = study::open_runs(request, choice);
  study::RunSnapshots snapshots(runs, study::columns_of(request, choice, runs), choice);
  const reduction::Decomposition found = reduction::decompose(snapshots, {});
  for (const double sigma : found.sigma)
    fuzz::check(std::isfinite(sigma) && sigma >= 0.0, "a singular value that is none");
}

void read_motion(const io::RunReader& run) {
  static_cast<void>(study::edge_motion(run));
  static_cast<void>(study::outside_cone(run, 0.5));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  const std::string_view bytes = fuzz::view(data, size);
  if (is_patches(bytes))
    return 1 + fuzz::mutate_patches(data + 1, size - 1, max - 1, seed, base().results);
  if (!is_hdf5(bytes)) return fuzz::mutate_text(data, size, max, seed);
  return fuzz::mutate_in_place(data, size, seed, mark_length);
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::make_tiny_run(run_folder());
  base() = {fuzz::text_of(run_folder() / "results.h5"), fuzz::text_of(run_folder() / "run.json")};
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = fuzz::view(data, size);
  put_run(bytes);
  const std::uint32_t choice = fuzz::hash(bytes);
  if (!fuzz::accepted([&] { read_fields(io::RunReader(run_folder())); })) return 0;
  fuzz::accepted([&] { decompose(request_of(choice)); });
  fuzz::accepted([&] { read_motion(io::RunReader(run_folder())); });
  constexpr std::uint32_t seldom = 32;  // it writes its own files
  if (choice / 16 % seldom == 0)
    fuzz::accepted([&] { static_cast<void>(study::run_pod(request_of(choice))); });
  return 0;
}
