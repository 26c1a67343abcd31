// SPDX-License-Identifier: BSD-3-Clause
namespace {
constexpr int register_bytes = 64;
}  // namespace

#include "rondo/rom/solid/kernels/products.hpp"

namespace rondo::rom::kernels {
constinit const ConeTable avx512_cone = cone_table_of("avx512");
}  // namespace rondo::rom::kernels
