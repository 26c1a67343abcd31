// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/figures.hpp"

#include <limits>

namespace rondo::study {

double figure_in(const Json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? j[key].get<double>()
                                               : std::numeric_limits<double>::quiet_NaN();
}

void add_figures_of_all(const Json& j, std::vector<double>& figures) {
  for (const char* key : {"energy_residual_relative", "contact_residual_max", "penetration_max_m",
                          "strain_max", "jacobian_min"})
    figures.push_back(figure_in(j, key));
}

}  // namespace rondo::study
