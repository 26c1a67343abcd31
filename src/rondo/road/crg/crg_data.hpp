// SPDX-License-Identifier: BSD-3-Clause
/// @file  The sequential data of an OpenCRG file: rows of numbers in records of 80 characters or
/// bytes (ASAM OpenCRG 1.2.0, section 6.4.8).
#pragma once
#include <cstddef>
#include <functional>
#include <istream>
#include <optional>
#include <span>
#include <string>

#include "rondo/road/crg/crg_channels.hpp"

namespace rondo::road {

struct CrgDataPlan {
  std::string file;
  CrgFormat format;
  std::size_t n_columns = 0;   ///< >= 2
  std::optional<double> rows;  ///< that the header promises; none: until the end of the file
  int header_lines = 0;        ///< lines before the data
  std::size_t data_begin = 0;  ///< byte [B]
  std::size_t file_size = 0;   ///< [B]
};

/// Takes one row: (n_columns) numbers, NaN where a value is missing.
using TakeCrgRow = std::function<void(std::span<const double>)>;

/// Reads all rows. @param in stands at the beginning of the data
/// @throws FileError: less or more data than the header promises, a record that is not one, a
/// number that is not finite or larger than 1e5 in magnitude
void read_crg_text_rows(std::istream& in, const CrgDataPlan& plan, const TakeCrgRow& take);
void read_crg_binary_rows(std::istream& in, const CrgDataPlan& plan, const TakeCrgRow& take);

/// A number of the data beyond this magnitude is a sign of damage: neither heights nor angles are
/// so large.
inline constexpr double largest_crg_number = 1e5;

}  // namespace rondo::road
