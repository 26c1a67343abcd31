// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/window_compliance.hpp"

#include "rondo/core/contract.hpp"

namespace rondo::rom {

using Eigen::Index;

void WindowCompliance::resize(Index size, Index sectors) {
  RONDO_DEMAND(size > 0 && sectors > 0, size, sectors);
  size_ = size;
  sectors_ = sectors;
  columns_.resize((2 * sectors - 1) * size, size);
  rounded_.resize((2 * sectors - 1) * size, size);
}

void WindowCompliance::set(Index lag, const Eigen::MatrixXd& block) {
  RONDO_DEMAND(-sectors_ < lag && lag < sectors_ && block.rows() == size_ && block.cols() == size_,
               lag, sectors_, block.rows(), size_);
  columns_.middleRows((sectors_ - 1 + lag) * size_, size_) = block;
  rounded_.middleRows((sectors_ - 1 - lag) * size_, size_) = block.transpose().cast<float>();
}

}  // namespace rondo::rom
