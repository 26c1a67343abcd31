// SPDX-License-Identifier: BSD-3-Clause
namespace {
constexpr int register_bytes = 16;
}  // namespace

#include "rondo/rom/solid/kernels/products.hpp"

namespace rondo::rom::kernels {
constinit const ConeTable baseline_cone = cone_table_of("baseline");
}  // namespace rondo::rom::kernels
