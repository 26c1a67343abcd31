// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint, and the run that goes on from it. Input: "P" and patches (mutate.hpp) of what the
/// hash of a small run's checkpoint is made of, with the hash made anew, so that they get past it;
/// or the bytes of a checkpoint as they are. Faults within the HDF5 library end the process
/// (hdf5_faults.hpp).
#include <span>

#include "fuzz.hpp"
#include "hdf5_faults.hpp"
#include "mutate.hpp"
#include "rondo/analysis/run.hpp"
#include "rondo/io/checkpoint_file.hpp"
#include "rondo/io/h5/hash.hpp"
#include "rondo/output/checkpoint.hpp"
#include "tiny_run.hpp"

using namespace rondo;
namespace fs = std::filesystem;

namespace {

constexpr char patch_mark = 'P';

const fs::path& base_folder() {
  static const fs::path path = fuzz::scratch_folder() / "base";
  return path;
}

const fs::path& run_folder() {
  static const fs::path path = fuzz::scratch_folder() / "run";
  return path;
}

/// Of the small run's checkpoint: the block with the hash, and what follows.
struct Base {
  std::string block, content;
};
const Base& base() {
  static const Base parts = [] {
    const std::string file = fuzz::text_of(base_folder() / study::checkpoint_name);
    return Base{file.substr(0, io::hash_block_bytes), file.substr(io::hash_block_bytes)};
  }();
  return parts;
}

std::string hash_of(const std::string& content) {
  io::Hash hash;
  hash.add(std::span<const char>(content));
  return hash.text();
}

/// A checkpoint whose hash is right.
std::string whole(const std::string& content) {
  std::string block = base().block;
  const std::string old = hash_of(base().content);
  const std::size_t at = block.find(old);
  fuzz::check(at != std::string::npos, "the hash is not where it was: the target is out of date");
  return block.replace(at, old.size(), hash_of(content)) + content;
}

void restore_run() {
  fs::remove_all(run_folder());
  fs::copy(base_folder(), run_folder(), fs::copy_options::recursive);
}

/// A little longer, so that it has steps to make.
study::Case longer_case() {
  study::Case c = fuzz::tiny_case();
  c.time.end *= 1.5;
  return c;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  if (fuzz::view(data, size).starts_with(patch_mark))
    return 1 + fuzz::mutate_patches(data + 1, size - 1, max - 1, seed, base().content);
  return fuzz::mutate_in_place(data, size, seed, 0);
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::make_tiny_run(base_folder());
  restore_run();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const study::Case longer = longer_case();
  const std::string_view bytes = fuzz::view(data, size);
  const fs::path file = run_folder() / study::checkpoint_name;
  if (bytes.starts_with(patch_mark))
    fuzz::put(file, whole(fuzz::patched(base().content, bytes.substr(1))));
  else
    fuzz::put(file, bytes);
  if (!fuzz::accepted([] { static_cast<void>(study::read_checkpoint(run_folder())); })) return 0;
  study::RunOptions options;
  options.directory = run_folder();
  options.threads = 1;
  options.resume = true;
  fuzz::accepted([&] { static_cast<void>(study::run_case(longer, options)); });
  restore_run();
  return 0;
}
