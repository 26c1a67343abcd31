// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/window_compliance.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {

using Eigen::Index;

void WindowCompliance::resize(Index size, Index sectors) {
  RONDO_DEMAND(size > 0 && sectors > 0, size, sectors);
  size_ = size;
  sectors_ = sectors;
  columns_.resize(at(rows() * size));
  rounded_.resize(at(rows() * size));
}

void WindowCompliance::set(Index lag, const Eigen::MatrixXd& block) {
  RONDO_DEMAND(-sectors_ < lag && lag < sectors_ && block.rows() == size_ && block.cols() == size_,
               lag, sectors_, block.rows(), size_);
  Eigen::Map<Eigen::MatrixXd>(columns_.data(), rows(), size_)
      .middleRows((sectors_ - 1 + lag) * size_, size_) = block;
  Eigen::Map<Eigen::MatrixXf>(rounded_.data(), rows(), size_)
      .middleRows((sectors_ - 1 - lag) * size_, size_) = block.transpose().cast<float>();
}

}  // namespace rondo::rom
