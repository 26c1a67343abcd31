// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields: a vector at each of a number of points, with two components in the plane and
/// three in space. A Field owns its numbers and gives access to them as Vec2 or Vec3. Files and
/// other languages receive a FieldView, in which only the number of components matters.
#pragma once
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo {

static_assert(sizeof(Vec2) == 2 * sizeof(double) && sizeof(Vec3) == 3 * sizeof(double));

struct FieldView {
  std::span<const double> values;  ///< (points, components)
  std::size_t components = 2;

  constexpr FieldView() = default;
  constexpr FieldView(std::span<const double> v, std::size_t c) : values(v), components(c) {}
  FieldView(std::span<const Vec2> plane)
      : values(reinterpret_cast<const double*>(plane.data()), 2 * plane.size()) {}
  FieldView(std::span<const Vec3> space)
      : values(reinterpret_cast<const double*>(space.data()), 3 * space.size()), components(3) {}
  FieldView(const std::vector<Vec2>& plane) : FieldView(std::span<const Vec2>(plane)) {}
  FieldView(const std::vector<Vec3>& space) : FieldView(std::span<const Vec3>(space)) {}

  [[nodiscard]] constexpr std::size_t size() const { return values.size() / components; }
  [[nodiscard]] constexpr bool empty() const { return values.empty(); }
  /// The components at a point.
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
  MutableFieldView(std::span<Vec3> space)
      : values(reinterpret_cast<double*>(space.data()), 3 * space.size()), components(3) {}
  MutableFieldView(std::vector<Vec2>& plane) : MutableFieldView(std::span<Vec2>(plane)) {}
  MutableFieldView(std::vector<Vec3>& space) : MutableFieldView(std::span<Vec3>(space)) {}

  [[nodiscard]] constexpr std::size_t size() const { return values.size() / components; }
};

/// A copy of the values as vectors.
template <class Vec>
std::vector<std::remove_const_t<Vec>> to_vector(std::span<Vec> values) {
  return {values.begin(), values.end()};
}

/// A field of points × components. Access with the wrong number of components violates the
/// contract, except that an empty field allows both.
class Field {
 private:
  template <class Vec, class Self>
  static auto as(Self& self) {
    auto* own = std::get_if<std::vector<Vec>>(&self.values_);
    RONDO_DEMAND(own || self.empty(), self.components());
    return own ? std::span(*own) : decltype(std::span(*own))();
  }

 public:
  Field() = default;
  /// Zero everywhere. @pre components is 2 or 3
  Field(std::size_t points, std::size_t components) {
    RONDO_DEMAND(components == 2 || components == 3, components);
    if (components == 2)
      values_ = std::vector<Vec2>(points);
    else
      values_ = std::vector<Vec3>(points);
  }
  Field(std::vector<Vec2> plane) noexcept : values_(std::move(plane)) {}
  Field(std::vector<Vec3> space) noexcept : values_(std::move(space)) {}
  /// Copies the values; reuses the storage if it is large enough, as std::vector does.
  template <class Vec>
  Field& operator=(const std::vector<Vec>& values) {
    if (auto* own = std::get_if<std::vector<Vec>>(&values_))
      *own = values;
    else
      values_ = values;
    return *this;
  }

  /// Makes the field empty, with storage for the given number of points.
  void reserve(std::size_t points, std::size_t components) {
    *this = Field(0, components);
    std::visit([&](auto& v) { v.reserve(points); }, values_);
  }

  [[nodiscard]] std::size_t size() const noexcept {
    return std::visit([](const auto& v) { return v.size(); }, values_);
  }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] std::size_t components() const noexcept { return values_.index() + 2; }

  [[nodiscard]] std::span<Vec2> plane() { return as<Vec2>(*this); }
  [[nodiscard]] std::span<const Vec2> plane() const { return as<Vec2>(*this); }
  [[nodiscard]] std::span<Vec3> space() { return as<Vec3>(*this); }
  [[nodiscard]] std::span<const Vec3> space() const { return as<Vec3>(*this); }
  operator std::span<Vec2>() { return plane(); }
  operator std::span<const Vec2>() const { return plane(); }
  operator std::span<Vec3>() { return space(); }
  operator std::span<const Vec3>() const { return space(); }
  operator FieldView() const {
    return std::visit([](const auto& v) { return FieldView(v); }, values_);
  }
  operator MutableFieldView() {
    return std::visit([](auto& v) { return MutableFieldView(v); }, values_);
  }
  /// Calls work(span of Vec2) or work(span of Vec3).
  template <class Work>
  void visit(Work&& work) {
    std::visit([&](auto& v) { work(std::span(v)); }, values_);
  }

  friend bool operator==(const Field&, const Field&) = default;

 private:
  std::variant<std::vector<Vec2>, std::vector<Vec3>> values_;
};

}  // namespace rondo
