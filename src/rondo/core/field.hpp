// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of vectors as they are handed from one part of the program to another: numbers,
/// point after point, and how many a point has. Inside, plane fields are vectors of Vec2.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"

namespace rondo {

static_assert(sizeof(Vec2) == 2 * sizeof(double));

struct FieldView {
  std::span<const double> values;  ///< (points, components)
  std::size_t components = 2;

  constexpr FieldView() = default;
  constexpr FieldView(std::span<const double> v, std::size_t c) : values(v), components(c) {}
  FieldView(std::span<const Vec2> plane)
      : values(reinterpret_cast<const double*>(plane.data()), 2 * plane.size()) {}
  FieldView(const std::vector<Vec2>& plane) : FieldView(std::span<const Vec2>(plane)) {}

  [[nodiscard]] constexpr std::size_t size() const { return values.size() / components; }
  [[nodiscard]] constexpr bool empty() const { return values.empty(); }
  /// (components) of a point.
  [[nodiscard]] constexpr std::span<const double> operator[](std::size_t point) const {
    return values.subspan(point * components, components);
  }
};

struct MutableFieldView {
  std::span<double> values;  ///< (points, components)
  std::size_t components = 2;

  constexpr MutableFieldView(std::span<double> v, std::size_t c) : values(v), components(c) {}
  MutableFieldView(std::span<Vec2> plane)
      : values(reinterpret_cast<double*>(plane.data()), 2 * plane.size()) {}
  MutableFieldView(std::vector<Vec2>& plane) : MutableFieldView(std::span<Vec2>(plane)) {}

  [[nodiscard]] constexpr std::size_t size() const { return values.size() / components; }
};

}  // namespace rondo
