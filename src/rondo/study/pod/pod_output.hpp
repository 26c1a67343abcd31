// SPDX-License-Identifier: BSD-3-Clause
/// @file  Writes the files of a POD (docs/results.md).
#pragma once
#include <filesystem>
#include <vector>

#include "rondo/pod/spectrum.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace rondo::study {

/// Result of a POD, without the snapshots themselves.
struct PodResult {
  std::vector<SnapshotColumn> columns;
  pod::Decomposition d;
  pod::Spectrum spectrum;
  pod::Identity identity;
};

/// Writes all files except pod.json. The modes of `result` become those of the field, Φ = W^{-1/2}
/// U, in the order of the mesh. @throws FileError
void write_pod_files(const PodRequest& request, const PodReport& report, RunSnapshots& snapshots,
                     PodResult& result);

}  // namespace rondo::study
