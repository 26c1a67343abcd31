// SPDX-License-Identifier: BSD-3-Clause
/// @file  A sweep's pieces of work one after the other in this process: a program with threads of
/// its own must not fork (worker_processes.hpp).
#pragma once
#include <functional>
#include <utility>

#include "rondo/study/sweep/sweep_team.hpp"

namespace rondo::python {

class InProcessTeam : public study::Team {
 public:
  /// @param look called now and then
  InProcessTeam(const std::atomic<bool>& stop, std::function<void()> look)
      : stop_(stop), look_(std::move(look)) {}
  [[nodiscard]] bool leads() const override { return true; }
  [[nodiscard]] int workers() const override { return 1; }
  void limit_workers(int /*workers*/) override {}
  [[nodiscard]] std::vector<study::Piece> each(const study::TeamWork& work) override {
    std::vector<study::Piece> pieces(work.count);
    for (std::size_t k = 0; k < work.count && !stop_.load(); ++k) {
      pieces[k] = study::do_piece(work, k, stop_, 0);
      if (work.watch) work.watch(k + 1);
    }
    return pieces;
  }
  [[nodiscard]] std::function<void()> tick() override { return look_; }
  [[nodiscard]] std::string from_leader(std::string text) override { return text; }

 private:
  const std::atomic<bool>& stop_;
  std::function<void()> look_;
};

}  // namespace rondo::python
