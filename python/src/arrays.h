// Numpy arrays in: any integer or float type, any strides, copied once. Numpy views out: read-only
// and without a copy.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "hexwright/base/ids.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright::python {

namespace nb = nanobind;

/// An array of any type that lies in memory, as it was given.
using AnyArray = nb::ndarray<nb::ro, nb::device::cpu>;

/// Rows of three coordinates. `name` is that of the argument, for messages. Throws
/// Error{BadArgument} for other shapes and types, and naming the first row that is not finite.
std::vector<Vec3> to_points(const AnyArray& array, const std::string& name);

/// Numbers of an array of `columns` columns (0: an array of one dimension), row by row, each from
/// `least` up to below `limit`. Throws Error{BadArgument} naming the first that is not.
struct IndexRange {
  std::int64_t least = 0, limit = 0;
  std::string of;  ///< what they are, for messages: "the 8 points"
};
std::vector<std::int32_t> to_indices(const AnyArray& array, std::size_t columns,
                                     const IndexRange& range, const std::string& name);

/// Of arrays that refer to so many points.
inline IndexRange all_points(std::size_t count) {
  return {0, static_cast<std::int64_t>(count), "the " + std::to_string(count) + " points"};
}

/// Rows of N vertices.
template <std::size_t N>
std::vector<std::array<VertId, N>> to_elements(const AnyArray& array, const IndexRange& range,
                                               const std::string& name) {
  const auto flat = to_indices(array, N, range, name);
  std::vector<std::array<VertId, N>> elements(flat.size() / N);
  for (std::size_t i = 0; i < flat.size(); ++i) elements[i / N][i % N] = VertId(flat[i]);
  return elements;
}

/// One finite number per element.
std::vector<double> to_numbers(const AnyArray& array, std::size_t count, const std::string& name);

/// A view of memory that `owner` keeps. Strides count elements; 0 = packed rows.
template <class T>
nb::object view_rows(const T* data, std::size_t rows, std::size_t columns, nb::handle owner,
                     std::size_t row_stride = 0) {
  static const T kNothing{};
  const std::size_t shape[2] = {rows, columns};
  const auto stride = static_cast<std::int64_t>(row_stride == 0 ? columns : row_stride);
  const std::int64_t strides[2] = {stride, 1};
  return nb::cast(
      nb::ndarray<nb::numpy, const T>(rows == 0 ? &kNothing : data, 2, shape, owner, strides),
      nb::rv_policy::reference);
}

template <class T>
nb::object view_values(const T* data, std::size_t count, nb::handle owner, std::size_t stride = 1) {
  static const T kNothing{};
  const std::size_t shape[1] = {count};
  const std::int64_t strides[1] = {static_cast<std::int64_t>(stride)};
  return nb::cast(
      nb::ndarray<nb::numpy, const T>(count == 0 ? &kNothing : data, 1, shape, owner, strides),
      nb::rv_policy::reference);
}

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(std::array<VertId, 8>) == 32,
              "views take them for rows of numbers");

inline nb::object view_points(const std::vector<Vec3>& points, nb::handle owner) {
  return view_rows(reinterpret_cast<const double*>(points.data()), points.size(), 3, owner);
}

template <std::size_t N>
nb::object view_elements(const std::vector<std::array<VertId, N>>& elements, nb::handle owner) {
  return view_rows(reinterpret_cast<const std::int32_t*>(elements.data()), elements.size(), N,
                   owner);
}

template <class Tag>
nb::object view_ids(const std::vector<Id<Tag>>& ids, nb::handle owner) {
  return view_values(reinterpret_cast<const std::int32_t*>(ids.data()), ids.size(), owner);
}

/// What arrays are to view, and its owner: it lives as long as one of them.
template <class T>
std::pair<const T*, nb::capsule> keep(T&& value) {
  auto held = std::make_unique<T>(std::move(value));
  nb::capsule owner(held.get(), [](void* p) noexcept { delete static_cast<T*>(p); });
  return {held.release(), std::move(owner)};
}

/// An array of its own that takes the vector.
template <class T>
nb::object give_values(std::vector<T>&& values) {
  const auto [held, owner] = keep(std::move(values));
  return view_values(held->data(), held->size(), owner);
}

}  // namespace hexwright::python
