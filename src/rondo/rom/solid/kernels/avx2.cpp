// SPDX-License-Identifier: BSD-3-Clause
namespace {
constexpr int register_bytes = 32;
}  // namespace

#include "rondo/rom/solid/kernels/products.hpp"

namespace rondo::rom::kernels {
constinit const ConeTable avx2_cone = cone_table_of("avx2");
}  // namespace rondo::rom::kernels
