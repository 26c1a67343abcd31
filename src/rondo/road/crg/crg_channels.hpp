// SPDX-License-Identifier: BSD-3-Clause
/// @file  The block $KD_DEFINITION: the format of the data and what their columns are
/// (ASAM OpenCRG 1.2.0, section 6.4.4).
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "rondo/road/crg/crg_header.hpp"

namespace rondo::road {

/// How the numbers of the data are written.
struct CrgFormat {
  std::string name = "KRBI";  ///< LRFI, LDFI, KRBI, KDBI
  bool text = false;
  bool twofold = false;  ///< double precision

  /// Characters or bytes of a number.
  [[nodiscard]] std::size_t width() const noexcept {
    return text ? (twofold ? 20 : 10) : (twofold ? 8 : 4);
  }
  /// Numbers in a record of 80 characters or bytes.
  [[nodiscard]] std::size_t per_record() const noexcept { return 80 / width(); }
};

enum class CrgColumn { section_at, section_number, heading, banking, slope, position, ignored };

struct CrgChannel {
  CrgColumn column = CrgColumn::ignored;
  double value = 0.0;  ///< v of a long section [m], or its number from 1
  int line = 0;
  std::string text;  ///< as in the file
};

struct CrgDefinition {
  CrgFormat format;
  std::vector<CrgChannel> channels;  ///< in the order of the columns
};

/// @throws InputError: no block, another format, no channels or wrong ones
[[nodiscard]] CrgDefinition read_crg_definition(const CrgHeader& header);

}  // namespace rondo::road
