// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/paper_table.hpp"

#include <cmath>

namespace rondo::study {

bool passes(const PaperRow& row) noexcept {
  switch (row.comparison) {
    case Comparison::within:
      return std::abs(row.ours - row.expected) <= row.tolerance;
    case Comparison::at_most:
      return row.ours <= row.expected;
    case Comparison::at_least:
      return row.ours >= row.expected;
  }
  return false;
}

const char* name_of(Comparison comparison) noexcept {
  switch (comparison) {
    case Comparison::within:
      return "within";
    case Comparison::at_most:
      return "at most";
    case Comparison::at_least:
      return "at least";
  }
  return "";
}

nlohmann::ordered_json as_json(const PaperRow& row) {
  return {{"figure", row.figure},
          {"name", row.name},
          {"quantity", row.quantity},
          {"unit", row.unit},
          {"ours", row.ours},
          {"expected", row.expected},
          {"comparison", name_of(row.comparison)},
          {"tolerance", row.tolerance},
          {"source", row.source},
          {"pass", passes(row)}};
}

}  // namespace rondo::study
