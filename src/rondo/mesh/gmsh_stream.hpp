// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stream that the program rondo-mesh-reader writes and read_raw_mesh reads.
/// Numbers are written as in memory; a text is its length (u64), then its bytes.
///
///   u64 start mark, u32 0: a mesh follows; 1: a text follows, the reason why there is none
///   u64 nodes the file says it has (0: not known)
///   u64 n, n times text: warnings, what the Gmsh library says among them
///   u64 n, n times i32 type, dimension, order, nodes per element, text name
///   u64 n, n times i32 dimension, tag, text name: physical groups
///   u64 n, n times i32 dimension, tag, u64 m, m times i32: entities, physical groups of each
///   u64 n, n times u64: tags of the nodes, n times 3 doubles: their places
///   u64 n, n times i32 dimension, entity, type, u64 m, m times u64: tags of the elements,
///     m times nodes per element u64: tags of their nodes
///   u64 end mark
#pragma once
#include <cstdint>

namespace rondo::mesh {

/// Changes with the layout, so that a program of another version is recognised.
inline constexpr std::uint64_t stream_start = 0x31'68'73'6d'64'6e'6f'72;  // "rondmsh1"
inline constexpr std::uint64_t stream_end = 0x64'6e'65'2d'64'6e'6f'72;    // "rond-end"

enum class StreamStatus : std::uint32_t { mesh = 0, failure = 1 };

}  // namespace rondo::mesh
