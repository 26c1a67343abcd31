// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case.hpp"
#include "rondo/case/case_keys.hpp"

namespace rondo::study {

InputError case_error(const Case& c, const std::string& key, const std::string& message,
                      const std::string& allowed) {
  Fault fault;
  fault.file = c.file.string();
  fault.key = key;
  fault.message = message;
  fault.allowed = allowed;
  auto place = c.places.find(key);
  for (auto table = table_of(key); place == c.places.end() && !table.empty();
       table = table_of(table))
    place = c.places.find(std::string(table));
  if (place != c.places.end()) {
    fault.file = place->second.file;
    fault.line = place->second.line;
    fault.column = place->second.column;
    fault.found = place->second.written;
  }
  return InputError(fault);
}

}  // namespace rondo::study
