// SPDX-License-Identifier: BSD-3-Clause
/// @file  The matrices of a motion as arrays of numpy: rondo.Simulation.matrices().
#pragma once
#include "arrays.hpp"
#include "rondo/analysis/matrices/contact_rows.hpp"

namespace rondo::python {

/// mass, damping, ...: (data, indices, indptr, shape) each; nodes, clamped, reference,
/// contact_nodes (none without a ground).
py::dict operator_arrays(const study::Operators& operators, const study::Setup& setup);

/// rows: (data, indices, indptr, shape); normal, normal_corotating, gap.
py::dict contact_arrays(const study::ContactRows& contact, std::size_t components);

/// Angle [rad], and center (c) [m].
py::tuple frame_arrays(const study::FramePlace& frame, std::size_t components);

/// The center from its components: none of them for z in the plane.
Vec3 center_of(const std::vector<double>& center);

}  // namespace rondo::python
