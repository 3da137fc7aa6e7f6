// A convex piece of a triangle, cut by planes.
#pragma once

#include <array>
#include <span>

#include "hexwright/base/assert.h"
#include "hexwright/base/vec3.h"

namespace hexwright {

class ConvexPiece {
 public:
  /// A part has two vertices for each time that its border leaves it: half as many again at most,
  /// whatever signs rounding gives to vertices that are nearly in a row.
  static constexpr std::size_t kMostCut = 11, kMaxVerts = kMostCut + kMostCut / 2;

  ConvexPiece() = default;
  explicit ConvexPiece(const std::array<Vec3, 3>& tri) {
    for (const Vec3& p : tri) add(p);
  }

  std::span<const Vec3> verts() const { return {verts_.data(), size_}; }
  bool is_empty() const { return size_ == 0; }
  bool is_full() const { return size_ > kMostCut; }

  Vec3 center() const {
    Vec3 sum;
    for (const Vec3& p : verts()) sum += p;
    return sum / static_cast<double>(size_);
  }

  /// Parts where a value that is linear over the piece, given at its vertices, is positive and
  /// where it is not; requires !is_full(). A part without three vertices is empty.
  std::array<ConvexPiece, 2> split(std::span<const double> value) const {
    std::array<ConvexPiece, 2> parts;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t j = (i + 1) % size_;
      parts[value[i] > 0 ? 0 : 1].add(verts_[i]);
      if ((value[i] > 0) == (value[j] > 0)) continue;
      const double t = value[i] / (value[i] - value[j]);
      const Vec3 cut = verts_[i] + t * (verts_[j] - verts_[i]);
      for (ConvexPiece& part : parts) part.add(cut);
    }
    for (ConvexPiece& part : parts)
      if (part.size_ < 3) part.size_ = 0;
    return parts;
  }

 private:
  void add(const Vec3& p) {
    HEXWRIGHT_ASSERT(size_ < kMaxVerts);
    verts_[size_++] = p;
  }

  std::array<Vec3, kMaxVerts> verts_;
  std::size_t size_ = 0;
};

}  // namespace hexwright
