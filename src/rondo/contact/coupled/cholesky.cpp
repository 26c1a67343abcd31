// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/cholesky.hpp"

#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::contact {

bool solve_cholesky(std::span<double> a, std::span<double> b) noexcept {
  const std::size_t n = b.size();
  RONDO_ASSERT(a.size() == n * n, a.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = a.data() + i * n;
    for (std::size_t k = 0; k <= i; ++k) {
      const double* const other = a.data() + k * n;
      double sum = row[k];
      for (std::size_t m = 0; m < k; ++m) sum -= row[m] * other[m];
      if (i == k && !(sum > 0.0)) return false;
      row[k] = i == k ? std::sqrt(sum) : sum / other[k];
    }
    for (std::size_t m = 0; m < i; ++m) b[i] -= row[m] * b[m];
    b[i] /= row[i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t m = i + 1; m < n; ++m) b[i] -= a[m * n + i] * b[m];
    b[i] /= a[i * n + i];
  }
  return true;
}

}  // namespace rondo::contact
