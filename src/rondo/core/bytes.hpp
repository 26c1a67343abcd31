// SPDX-License-Identifier: BSD-3-Clause
/// @file  Amounts of memory and disk space written for people.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace rondo {

/// 2.5e9 for "2.5GB"; B, kB, MB, GB, TB, or KiB, MiB, GiB, TiB; none if `text` is not an amount.
std::optional<std::size_t> bytes_in(const std::string& text);

/// "512 MB", "1.8 TB".
std::string readable_bytes(std::size_t bytes);

}  // namespace rondo
