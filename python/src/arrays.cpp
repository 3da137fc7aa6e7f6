// Reading arrays element by element through their strides: what is contiguous of the wanted type
// costs no more than a copy, and nothing else need be converted before.
#include "arrays.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "hexwright/base/error.h"

namespace hexwright::python {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::BadArgument, what, name);
}

std::string describe_shape(const AnyArray& array) {
  std::string text = "(";
  for (std::size_t d = 0; d < array.ndim(); ++d)
    text += fmt::format("{}{}", d == 0 ? "" : ", ", array.shape(d));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// Rows and columns, where a plain list is one column.
void check_shape(const AnyArray& array, std::size_t columns, const std::string& name) {
  const std::size_t dimensions = columns == 0 ? 1 : 2;
  if (array.ndim() == dimensions && (columns == 0 || array.shape(1) == columns)) return;
  refuse(name, fmt::format("has the shape {}, but must have {}", describe_shape(array),
                           columns == 0 ? "one dimension" : fmt::format("(n, {})", columns)));
}

template <class T, class Use>
void visit_as(const AnyArray& array, std::size_t columns, Use&& use) {
  const auto* data = static_cast<const T*>(array.data());
  const std::int64_t row_stride = array.ndim() > 0 ? array.stride(0) : 0;
  const std::int64_t column_stride = columns > 0 ? array.stride(1) : 0;
  const std::size_t width = columns == 0 ? 1 : columns;
  for (std::size_t i = 0; i < array.shape(0); ++i)
    for (std::size_t k = 0; k < width; ++k)
      use(i, k,
          data[static_cast<std::int64_t>(i) * row_stride +
               static_cast<std::int64_t>(k) * column_stride]);
}

/// Calls use(row, column, value) with the elements in order when they are of one of these types;
/// false when they are of another.
template <class... Types, class Use>
bool visit(const AnyArray& array, std::size_t columns, Use&& use) {
  const auto visit_if = [&]<class T>(std::type_identity<T>) {
    if (array.dtype() != nb::dtype<T>()) return false;
    visit_as<T>(array, columns, use);
    return true;
  };
  return (visit_if(std::type_identity<Types>()) || ...);
}

template <class Use>
bool visit_integers(const AnyArray& array, std::size_t columns, Use&& use) {
  return visit<std::int32_t, std::int64_t, std::uint32_t, std::uint64_t, std::int16_t,
               std::uint16_t, std::int8_t, std::uint8_t>(array, columns, use);
}

template <class Use>
void visit_numbers(const AnyArray& array, std::size_t columns, const std::string& name, Use&& use) {
  if (!visit<double, float>(array, columns, use) && !visit_integers(array, columns, use))
    refuse(name, "must hold integers or floating-point numbers");
}

}  // namespace

std::vector<Vec3> to_points(const AnyArray& array, const std::string& name) {
  check_shape(array, 3, name);
  std::vector<Vec3> points(array.shape(0));
  visit_numbers(array, 3, name, [&](std::size_t i, std::size_t k, auto value) {
    const auto number = static_cast<double>(value);
    if (!std::isfinite(number))
      refuse(name,
             fmt::format("row {} is not finite; remove the point or the faces that use it", i));
    points[i][static_cast<int>(k)] = number;
  });
  return points;
}

std::vector<std::int32_t> to_indices(const AnyArray& array, std::size_t columns,
                                     const IndexRange& range, const std::string& name) {
  check_shape(array, columns, name);
  const std::size_t width = columns == 0 ? 1 : columns;
  std::vector<std::int32_t> indices(array.shape(0) * width);
  const bool is_read = visit_integers(array, columns, [&](std::size_t i, std::size_t k, auto v) {
    const bool is_inside = std::cmp_greater_equal(v, range.least) && std::cmp_less(v, range.limit);
    if (!is_inside)
      refuse(name, fmt::format("row {} holds {}, which is none of {} (counted from {})", i,
                               static_cast<std::conditional_t<std::is_signed_v<decltype(v)>,
                                                              std::int64_t, std::uint64_t>>(v),
                               range.of, range.least));
    indices[i * width + k] = static_cast<std::int32_t>(v);
  });
  if (!is_read) refuse(name, "must hold integers; convert with .astype(int)");
  return indices;
}

std::vector<double> to_numbers(const AnyArray& array, std::size_t count, const std::string& name) {
  check_shape(array, 0, name);
  if (array.shape(0) != count)
    refuse(name, fmt::format("has {} values for {} elements", array.shape(0), count));
  std::vector<double> numbers(count);
  visit_numbers(array, 0, name, [&](std::size_t i, std::size_t, auto value) {
    numbers[i] = static_cast<double>(value);
    if (!std::isfinite(numbers[i])) refuse(name, fmt::format("value {} is not finite", i));
  });
  return numbers;
}

}  // namespace hexwright::python
