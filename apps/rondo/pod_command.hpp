// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo pod: calls the library, prints the figures on stdout, returns an exit code.
#pragma once
#include "rondo/study/pod/pod.hpp"

namespace rondo::app {

/// @param quiet no plan and no progress, only warnings and the figures
int pod(study::PodRequest request, bool quiet);

}  // namespace rondo::app
