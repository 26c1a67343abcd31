// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using fem::SolidSector;
using kernels::SolidKind;
using Block = std::array<double, 9>;
using Place = SolidCoupling::Place;

/// In the frames a of the row and b of the column. The transposed block, of b and a, becomes the
/// transposed of it to the last bit.
Block turned(const Block& k, Complex a, Complex b) noexcept {
  const double cc = a.re * b.re, ss = a.im * b.im, cs = a.re * b.im, sc = a.im * b.re;
  return {(cc * k[0] + ss * k[4]) + (cs * k[3] + sc * k[1]),
          (cs * k[4] - sc * k[0]) + (cc * k[1] - ss * k[3]),
          b.re * k[2] + b.im * k[5],
          (sc * k[4] - cs * k[0]) + (cc * k[3] - ss * k[1]),
          (ss * k[0] + cc * k[4]) - (sc * k[3] + cs * k[1]),
          b.re * k[5] - b.im * k[2],
          a.re * k[6] + a.im * k[7],
          a.re * k[7] - a.im * k[6],
          k[8]};
}

Block transposed(const Block& k) noexcept {
  return {k[0], k[3], k[6], k[1], k[4], k[7], k[2], k[5], k[8]};
}

bool before(const Place& a, const Place& b) noexcept {
  return std::pair{a.row, a.shift} < std::pair{b.row, b.shift};
}

/// Signs of D k D, D = diag(1, -1, 1).
constexpr std::array<double, 9> mirror_sign{1, -1, 1, -1, 1, -1, 1, -1, 1};

using Numbers = std::array<double, kernels::n_mirror>;

/// Three nodes of a row's neighbours that have the same radius and z: on the meridian of the row's
/// node, and as far before as after it.
struct Trio {
  int ring;
  std::array<const SolidBlock*, 3> of{};  ///< here, last, next
};

/// The mirrored part of three blocks. @param worst largest part that is not
Numbers mirrored(const Block& here, const Block& last, const Block& next, double& worst) noexcept {
  Block outer{};
  for (std::size_t i = 0; i < 9; ++i) {
    const double sign = mirror_sign[i];
    outer[i] = 0.5 * (next[i] + sign * last[i]);
    worst = std::max({worst, std::abs(next[i] - outer[i]), sign > 0.0 ? 0.0 : std::abs(here[i])});
  }
  Numbers k{};
  k[kernels::mirror_rr] = here[0], k[kernels::mirror_zr] = here[2];
  k[kernels::mirror_tt] = here[4];
  k[kernels::mirror_rz] = here[6], k[kernels::mirror_zz] = here[8];
  k[kernels::mirror_rr1] = outer[0], k[kernels::mirror_zr1] = outer[2];
  k[kernels::mirror_tr1] = outer[1], k[kernels::mirror_rt1] = outer[3];
  k[kernels::mirror_tt1] = outer[4], k[kernels::mirror_zt1] = outer[5];
  k[kernels::mirror_rz1] = outer[6], k[kernels::mirror_zz1] = outer[8];
  k[kernels::mirror_tz1] = outer[7];
  return k;
}

/// The blocks that they stand for: here, last, next.
std::array<Block, 3> blocks_of(const Numbers& k) noexcept {
  using namespace kernels;
  const Block here{k[mirror_rr], 0.0,          k[mirror_zr], 0.0,         k[mirror_tt],
                   0.0,          k[mirror_rz], 0.0,          k[mirror_zz]};
  const Block next{k[mirror_rr1], k[mirror_tr1], k[mirror_zr1], k[mirror_rt1], k[mirror_tt1],
                   k[mirror_zt1], k[mirror_rz1], k[mirror_tz1], k[mirror_zz1]};
  Block last{};
  for (std::size_t i = 0; i < 9; ++i) last[i] = mirror_sign[i] * next[i];
  return {here, last, next};
}

/// These numbers, as the nodes of the other ring have them.
Numbers transposed(const Numbers& k) noexcept {
  using namespace kernels;
  Numbers t = k;
  t[mirror_zr] = k[mirror_rz], t[mirror_rz] = k[mirror_zr];
  t[mirror_zr1] = k[mirror_rz1], t[mirror_rz1] = k[mirror_zr1];
  t[mirror_tr1] = -k[mirror_rt1], t[mirror_rt1] = -k[mirror_tr1];
  t[mirror_zt1] = -k[mirror_tz1], t[mirror_tz1] = -k[mirror_zt1];
  return t;
}

double difference(const Numbers& a, const Numbers& b) noexcept {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Numbers of the mirrored rows by the rings of row and column: alike to round-off, they become the
/// same to the last bit, and those of column and row their transposed.
class SharedNumbers {
 public:
  const Numbers& same(int row, int column, const Numbers& k, double round_off) {
    std::vector<Numbers>& known = known_[{row, column}];
    for (const Numbers& other : known)
      if (difference(k, other) <= round_off) return other;
    Numbers own = k;
    if (row == column) {
      const Numbers back = transposed(k);
      for (std::size_t i = 0; i < k.size(); ++i) own[i] = 0.5 * (k[i] + back[i]);
    } else {
      known_[{column, row}].push_back(transposed(k));
    }
    known.push_back(own);
    return known.back();
  }

 private:
  std::map<std::pair<int, int>, std::vector<Numbers>> known_;
};

/// Equal ones get the same number. @param near they are equal up to this
std::vector<int> classes(const std::vector<double>& x, double near) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  std::vector<int> out(x.size());
  int last = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && x[order[i]] - x[order[i - 1]] > near) ++last;
    out[order[i]] = last;
  }
  return out;
}

class Rows {
 public:
  Rows(const Model& model, const SolidSector& sector) : k_(sector) {
    find_frames(model);
    find_rings();
    turn_blocks();
    for (std::size_t a = 0; a < k_.n_local(); ++a) find_mirror(a);
    keep_symmetry();
    for (std::size_t a = 0; a < k_.n_local(); ++a) write_couplings(a);
  }

  SolidStiffness result;

 private:
  void find_frames(const Model& model) {
    for (std::size_t a = 0; a < k_.n_local(); ++a) {
      const std::size_t node = k_.node(a, 0);
      const Vec2 x = conj(k_.turn[0]) * model.reference[node];
      const double radius = norm(x);
      const Complex frame = radius > 0.0 ? Complex{x.x / radius, x.y / radius} : Complex{1.0, 0.0};
      result.frame.push_back(frame);
      result.arm.emplace_back(conj(frame) * x, model.solid->axial[node]);
      near_ = std::max(near_, 1e-9 * (radius + std::abs(result.arm.back().z)));
    }
  }

  void turn_blocks() {
    result.blocks.resize(k_.n_local());
    for (std::size_t a = 0; a < k_.n_local(); ++a) {
      for (const SolidSector::Entry& e : k_.row(a)) {
        const Complex of = result.frame[at(e.column)];
        result.blocks[a].push_back({e.column, e.shift, turned(e.block, result.frame[a], of)});
        largest_ = std::max(largest_, std::abs(result.blocks[a].back().k[0]));
      }
      std::sort(result.blocks[a].begin(), result.blocks[a].end(),
                [](const SolidBlock& x, const SolidBlock& y) {
                  return before({x.row, x.shift}, {y.row, y.shift});
                });
    }
  }

  /// Nodes of the same radius and z are a ring.
  void find_rings() {
    std::vector<double> radius, z;
    for (const Vec3& arm : result.arm) {
      radius.push_back(arm.x);
      z.push_back(arm.z);
    }
    const std::vector<int> of_radius = classes(radius, near_), of_z = classes(z, near_);
    std::map<std::pair<int, int>, int> rings;
    for (std::size_t a = 0; a < radius.size(); ++a)
      ring_.push_back(
          rings.try_emplace({of_radius[a], of_z[a]}, static_cast<int>(rings.size())).first->second);
  }

  /// Sine of the angle from a row's node to that of a block.
  double sine(std::size_t a, const SolidBlock& b) const {
    const auto n = static_cast<std::size_t>(k_.n_sectors);
    const Complex turn = b.shift == 0 ? Complex{1.0, 0.0} : k_.turn[b.shift > 0 ? 1 : n - 1];
    const Complex sector = b.shift == 0 ? turn : turn * conj(k_.turn[0]);
    return (conj(result.frame[a]) * (sector * result.frame[at(b.row)])).im;
  }

  /// The trios of a row; none: there is a node without its two others.
  std::vector<Trio> trios_of(std::size_t a) const {
    std::vector<Trio> trios;
    std::vector<double> to_last, to_next;
    for (const SolidBlock& b : result.blocks[a]) {
      const auto row = static_cast<std::size_t>(b.row);
      const double angle = sine(a, b);
      const bool here = std::abs(angle) * result.arm[row].x < near_;
      auto trio = std::find_if(trios.begin(), trios.end(),
                               [&](const Trio& t) { return t.ring == ring_[row]; });
      if (trio == trios.end()) trio = trios.insert(trio, {ring_[row]});
      const SolidBlock*& place = trio->of[here ? 0 : angle < 0.0 ? 1 : 2];
      if (place) return {};
      place = &b;
    }
    for (const Trio& t : trios) {
      if (!t.of[0] || !t.of[1] || !t.of[2]) return {};
      const double radius = result.arm[at(t.of[0]->row)].x;
      if (std::abs(sine(a, *t.of[1]) + sine(a, *t.of[2])) * radius > near_) return {};
    }
    return trios;
  }

  /// A row that is its own mirror needs half of the products; its blocks become those that the
  /// numbers stand for.
  void find_mirror(std::size_t a) {
    const double round_off = 1e-11 * largest_;  // of the coordinates, over the size of an element
    const std::vector<Trio> trios = trios_of(a);
    std::vector<Numbers> numbers;
    double worst = 0.0;
    for (const Trio& t : trios)
      numbers.push_back(mirrored(t.of[0]->k, t.of[1]->k, t.of[2]->k, worst));
    const bool is = !trios.empty() && worst <= round_off;
    result.kind.push_back(is ? SolidKind::mirrored : SolidKind::general);
    trios_.emplace_back();
    if (!is) return;
    std::vector<SolidBlock>& blocks = result.blocks[a];
    for (std::size_t i = 0; i < trios.size(); ++i) {
      const Numbers& k = shared_.same(ring_[a], trios[i].ring, numbers[i], round_off);
      const std::array<Block, 3> parts = blocks_of(k);
      MirroredTrio& trio = trios_[a].emplace_back(MirroredTrio{{}, k});
      for (std::size_t p = 0; p < 3; ++p) {
        trio.at[p] = static_cast<std::size_t>(trios[i].of[p] - blocks.data());
        blocks[trio.at[p]].k = parts[p];
      }
    }
  }

  /// Gives a row without the symmetry, transposed, what a mirrored row has in place of its blocks.
  void keep_symmetry() {
    for (std::size_t a = 0; a < k_.n_local(); ++a) {
      if (result.kind[a] != SolidKind::general) continue;
      for (SolidBlock& b : result.blocks[a]) {
        const auto row = static_cast<std::size_t>(b.row);
        if (result.kind[row] == SolidKind::general) continue;
        for (const SolidBlock& back : result.blocks[row])
          if (back.row == static_cast<int>(a) && back.shift == -b.shift) b.k = transposed(back.k);
      }
    }
  }

  void write_couplings(std::size_t a) {
    std::vector<SolidCoupling>& out = result.couplings.emplace_back();
    const std::vector<SolidBlock>& blocks = result.blocks[a];
    const auto place = [&](std::size_t i) { return Place{blocks[i].row, blocks[i].shift}; };
    if (result.kind[a] == SolidKind::general) {
      for (std::size_t i = 0; i < blocks.size(); ++i)
        out.push_back({place(i), place(i), place(i), {blocks[i].k.begin(), blocks[i].k.end()}});
      return;
    }
    for (const auto& [at, numbers] : trios_[a]) {
      out.push_back({place(at[0]), place(at[1]), place(at[2]), {numbers.begin(), numbers.end()}});
    }
    std::sort(out.begin(), out.end(), [](const SolidCoupling& x, const SolidCoupling& y) {
      return before(x.here, y.here);
    });
  }

  const SolidSector& k_;
  double near_ = 0.0;      ///< places that are as near are the same                        [m]
  double largest_ = 0.0;   ///< largest |k[0]| of the blocks
  std::vector<int> ring_;  ///< (n_local)
  SharedNumbers shared_;
  struct MirroredTrio {
    std::array<std::size_t, 3> at;  ///< in `blocks`
    Numbers k;
  };
  std::vector<std::vector<MirroredTrio>> trios_;  ///< (n_local) of mirrored rows
};

}  // namespace

SolidStiffness solid_stiffness(const Model& model, const SolidSector& sector) {
  static_assert(std::tuple_size_v<Numbers> == kernels::n_mirror);
  RONDO_DEMAND(sector.turn.size() == static_cast<std::size_t>(sector.n_sectors) &&
                   sector.row_start.size() == sector.n_local() + 1,
               sector.turn.size(), sector.n_sectors, sector.row_start.size(), sector.n_local());
  return std::move(Rows(model, sector).result);
}

}  // namespace rondo::dynamics
