// Hexes with their face neighbours, and where each hex sits: the structure that pillows grow in.
#pragma once

#include <cstdint>
#include <vector>

#include "hexwright/grid/grid.h"
#include "hexwright/mesh/element_ids.h"
#include "hexwright/mesh/hex_numbering.h"

namespace hexwright::dual {

/// What lies behind a face of a hex: a face of another hex, or a plane of the domain's boundary.
class FaceLink {
 public:
  FaceLink() = default;
  static FaceLink to_face(HexId hex, int lf) { return FaceLink(hex.value() * 8 + lf); }
  static FaceLink to_plane(int plane) { return FaceLink(-1 - plane); }

  bool is_plane() const { return code_ < 0; }
  int plane() const { return -1 - code_; }
  HexId hex() const { return HexId(code_ >> 3); }
  int lf() const { return code_ & 7; }
  friend bool operator==(FaceLink, FaceLink) = default;

 private:
  explicit FaceLink(std::int32_t code) : code_(code) {}
  std::int32_t code_ = -1;
};

/// A plane of the domain's boundary: coordinate `coord` (finest lattice) along `axis`.
struct DomainPlane {
  int axis = 0;
  std::int32_t coord = 0;
  friend bool operator==(const DomainPlane&, const DomainPlane&) = default;
};

/// Where a hex comes from. The dual of a lattice vertex has that vertex's place; a cap closes a
/// pillow and sits between an inner hex and an outer one, both older than itself.
class HexPlace {
 public:
  HexPlace() = default;
  static HexPlace lattice(const LatticeCoord& p) { return HexPlace(p, kLattice); }
  /// Between `inner` and the point that has its coordinates from `outer` on the axes of
  /// `outer_axes` (bits) and from `inner` on the others.
  static HexPlace cap(HexId inner, HexId outer, int outer_axes = 7) {
    return HexPlace({inner.value(), outer.value(), 0}, static_cast<std::int8_t>(outer_axes));
  }

  bool is_lattice() const { return kind_ == kLattice; }
  const LatticeCoord& point() const { return data_; }
  HexId inner() const { return HexId(data_[0]); }
  HexId outer() const { return HexId(data_[1]); }
  int outer_axes() const { return kind_; }

 private:
  static constexpr std::int8_t kLattice = -1;
  HexPlace(const LatticeCoord& data, std::int8_t kind) : data_(data), kind_(kind) {}
  LatticeCoord data_ = {0, 0, 0};
  std::int8_t kind_ = kLattice;
};

struct HexComplex {
  IdVector<HexId, std::array<VertId, 8>> verts;
  IdVector<HexId, std::array<FaceLink, 6>> links;
  IdVector<HexId, HexPlace> places;
  std::vector<DomainPlane> planes;  ///< FaceLink::plane() indexes these
  std::int32_t num_verts = 0;

  std::size_t num_hexes() const { return verts.size(); }
  void reserve(std::size_t count);
  HexId add_hex();
  VertId add_vert() { return VertId(num_verts++); }
  /// Index of the plane, appended when new.
  int find_or_add_plane(const DomainPlane& plane);
  /// Makes the two faces each other's neighbours.
  void connect(HexId a, int lf_a, HexId b, int lf_b);

  /// First broken link: neighbours must name each other and share the face's four vertices,
  /// running opposite ways.
  std::optional<Issue> find_problem() const;
};

/// The edge of another face that each edge of a face lies on: edge k of face lf runs from its k-th
/// vertex to the next.
struct FaceEdge {
  int lf = 0, k = 0;
};
inline constexpr auto kFaceAcrossEdge = [] {
  std::array<std::array<FaceEdge, 4>, 6> table{};
  for (int lf = 0; lf < 6; ++lf)
    for (int k = 0; k < 4; ++k)
      for (int other = 0; other < 6; ++other)
        for (int j = 0; j < 4; ++j)
          if (kHexFaces[lf][k] == kHexFaces[other][(j + 1) % 4] &&
              kHexFaces[lf][(k + 1) % 4] == kHexFaces[other][j])
            table[lf][k] = {other, j};
  return table;
}();

/// The three faces that meet at each local vertex.
inline constexpr auto kFacesOfVertex = [] {
  std::array<std::array<int, 3>, 8> table{};
  for (int lv = 0; lv < 8; ++lv) {
    int count = 0;
    for (int lf = 0; lf < 6; ++lf)
      for (int k = 0; k < 4; ++k)
        if (kHexFaces[lf][k] == lv) table[lv][count++] = lf;
  }
  return table;
}();

}  // namespace hexwright::dual
