// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>

namespace rondo::statics {

/// The imaginary unit.
inline constexpr std::complex<double> i{0.0, 1.0};

}  // namespace rondo::statics
