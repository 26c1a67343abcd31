// SPDX-License-Identifier: BSD-3-Clause
/// @file  The three methods of decompose() and their common functions. For this module only.
#pragma once
#include "rondo/pod/decompose.hpp"

namespace rondo::pod {

/// Reports the work done to the caller's function, as the number of matrix entries read.
class Progress {
 public:
  Progress(const SnapshotMatrix& source, const DecomposeOptions& options, int passes)
      : report_(options.progress),
        total_(passes * static_cast<long long>(source.rows()) * source.columns()) {}
  void add(Index numbers) {
    done_ += numbers;
    if (report_) report_(done_, total_);
  }
  void finish() {
    if (done_ != total_) add(static_cast<Index>(total_ - done_));
  }

 private:
  const std::function<void(long long, long long)>& report_;
  long long done_ = 0, total_;
};

[[nodiscard]] Decomposition direct(SnapshotMatrix& source, const DecomposeOptions& options);
[[nodiscard]] Decomposition tsqr(SnapshotMatrix& source, const DecomposeOptions& options,
                                 const DecomposePlan& plan);
[[nodiscard]] Decomposition incremental(SnapshotMatrix& source, const DecomposeOptions& options,
                                        const DecomposePlan& plan);

/// Sets d.rank from sigma. @return the number of modes to keep, at most `most`
[[nodiscard]] Index rank_and_choose(Decomposition& d, Index asked, Index most);

}  // namespace rondo::pod
