// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/road_hash.hpp"

#include <array>
#include <cstdint>

#include "rondo/io/h5/hash.hpp"

namespace rondo::io {

std::string road_hash(const road::Road& road) {
  Hash hash;
  const auto add = [&](const auto& values) {
    const std::uint64_t size = values.size();
    hash.add(std::span(&size, 1));
    hash.add(std::span(values));
  };
  for (const auto* values : {&road.v, &road.heights, &road.line_height, &road.slope, &road.banking})
    add(*values);
  add(std::array{road.u_first, road.u_step, road.missing_offset, road.edges.offset_u,
                 road.edges.offset_v});
  add(std::array{static_cast<int>(road.missing), static_cast<int>(road.edges.u),
                 static_cast<int>(road.edges.v)});
  return hash.text();
}

}  // namespace rondo::io
