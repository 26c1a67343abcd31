// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps for comparison: the same scheme, terms and ledger, implemented differently.
#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "rondo/integrators/integrator.hpp"

namespace rondo::bench {

/// K in scalar compressed sparse rows, as in a library; an unknown has the number 2·(index in
/// model.free) + component.
using CsrMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
[[nodiscard]] CsrMatrix csr_matrix(const fem::BlockCsr& k, std::span<const int> free);

/// out = K u, with the rows in as many equal parts as there are threads.
void multiply(const CsrMatrix& k, const Eigen::VectorXd& u, Eigen::VectorXd& out, int threads);

/// The product by Eigen, then the updates in separate loops, as in a program that takes the product
/// from a library. Fields of free nodes only; velocities and works of the ledger in one loop that
/// suits SIMD. @pre the symplectic scheme. Model and matrix must outlive it.
[[nodiscard]] std::unique_ptr<dynamics::Integrator> make_csr_steps(const dynamics::Model& model,
                                                                   const CsrMatrix& k,
                                                                   const dynamics::State& start);

}  // namespace rondo::bench
