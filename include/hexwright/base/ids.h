// Strong 32-bit ids and containers that accept only the matching id.
//
// `CellId == NodeId` does not compile, and neither does indexing a per-vertex array with a hex. The
// default id is invalid (-1).
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace hexwright {

template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  template <class Integer>
  explicit constexpr Id(Integer value) : value_(static_cast<std::int32_t>(value)) {}

  constexpr std::int32_t value() const { return value_; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value_); }
  constexpr bool is_valid() const { return value_ >= 0; }

  friend constexpr bool operator==(Id a, Id b) { return a.value_ == b.value_; }
  friend constexpr std::strong_ordering operator<=>(Id a, Id b) { return a.value_ <=> b.value_; }
  constexpr Id& operator++() {
    ++value_;
    return *this;
  }

 private:
  std::int32_t value_ = -1;
};

/// Iterates over the ids 0 .. count-1: `for (HexId h : id_range<HexId>(mesh.num_hexes()))`.
template <class IdType>
class IdRange {
 public:
  class Iterator {
   public:
    explicit constexpr Iterator(IdType id) : id_(id) {}
    constexpr IdType operator*() const { return id_; }
    constexpr Iterator& operator++() {
      ++id_;
      return *this;
    }
    constexpr bool operator==(const Iterator& other) const { return id_ == other.id_; }

   private:
    IdType id_;
  };

  explicit constexpr IdRange(std::size_t count) : count_(count) {}
  constexpr Iterator begin() const { return Iterator(IdType(0)); }
  constexpr Iterator end() const { return Iterator(IdType(count_)); }

 private:
  std::size_t count_;
};

template <class IdType>
constexpr IdRange<IdType> id_range(std::size_t count) {
  return IdRange<IdType>(count);
}

/// A vector indexed by one kind of id. `raw()` gives the plain vector to kernels and bindings.
template <class IdType, class T>
class IdVector {
 public:
  using value_type = T;

  IdVector() = default;
  explicit IdVector(std::size_t count) : data_(count) {}
  IdVector(std::size_t count, const T& value) : data_(count, value) {}
  IdVector(std::initializer_list<T> values) : data_(values) {}
  explicit IdVector(std::vector<T> values) : data_(std::move(values)) {}

  decltype(auto) operator[](IdType id) { return data_[id.index()]; }
  decltype(auto) operator[](IdType id) const { return data_[id.index()]; }

  std::size_t size() const { return data_.size(); }
  bool empty() const { return data_.empty(); }
  void resize(std::size_t count) { data_.resize(count); }
  void resize(std::size_t count, const T& value) { data_.resize(count, value); }
  void assign(std::size_t count, const T& value) { data_.assign(count, value); }
  void reserve(std::size_t count) { data_.reserve(count); }
  void clear() { data_.clear(); }

  /// Appends a value and returns its id.
  IdType push_back(T value) {
    data_.push_back(std::move(value));
    return IdType(data_.size() - 1);
  }

  IdRange<IdType> ids() const { return IdRange<IdType>(data_.size()); }
  auto begin() { return data_.begin(); }
  auto end() { return data_.end(); }
  auto begin() const { return data_.begin(); }
  auto end() const { return data_.end(); }

  std::vector<T>& raw() { return data_; }
  const std::vector<T>& raw() const { return data_; }

  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  std::vector<T> data_;
};

/// A non-owning view indexed by one kind of id.
template <class IdType, class T>
class IdSpan {
 public:
  IdSpan() = default;
  explicit IdSpan(std::span<T> data) : data_(data) {}
  template <class U>
  IdSpan(const IdVector<IdType, U>& values) : data_(values.raw()) {}
  template <class U>
  IdSpan(IdVector<IdType, U>& values) : data_(values.raw()) {}

  T& operator[](IdType id) const { return data_[id.index()]; }
  std::size_t size() const { return data_.size(); }
  IdRange<IdType> ids() const { return IdRange<IdType>(data_.size()); }
  auto begin() const { return data_.begin(); }
  auto end() const { return data_.end(); }
  std::span<T> raw() const { return data_; }

 private:
  std::span<T> data_;
};

}  // namespace hexwright

template <class Tag>
struct std::hash<hexwright::Id<Tag>> {
  std::size_t operator()(hexwright::Id<Tag> id) const noexcept {
    return std::hash<std::int32_t>{}(id.value());
  }
};
