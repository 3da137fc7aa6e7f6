// Base mesh of any union of root cubes: hexes are written down vertex by vertex in terms of pieces
// of cells; pieces that the boundary's shape identifies become one mesh vertex.
//
// Based on: docs/algorithms/dual.md, "The base mesh".
#include <algorithm>

#include "hexwright/base/error.h"

#include "base/disjoint_sets.h"
#include "dual/complex/base_mesh.h"
#include "dual/domain/crease_modes.h"

namespace hexwright::dual {

namespace {

// A cell has 27 pieces: its centre, 6 faces, 12 edges and 8 corners. Piece (cell, mask) at a star
// lies from the cell's centre towards the star's vertex on the axes of `mask`.
using Piece = std::size_t;

class GeneralBase {
 public:
  GeneralBase(const Domain& domain, HexComplex& complex)
      : domain_(domain),
        complex_(complex),
        stars_(collect_octant_stars(domain)),
        num_pieces_(27 * domain.num_cell_indices()),
        pieces_(num_pieces_),
        is_pinned_(num_pieces_, 0) {}

  BaseStatus run() {
    const auto wrapped = find_wrapped_creases(stars_);
    for (std::size_t s = 0; s < stars_.size(); ++s) emit_star(stars_[s], wrapped[s]);
    if (!collect_planes()) return BaseStatus::TooThin;
    number_verts();
    return link_faces() ? BaseStatus::Ok : BaseStatus::TooThin;
  }

 private:
  using Planes = std::array<std::int32_t, 3>;  // coordinate of the plane across each axis, or kNone
  static constexpr std::int32_t kNone = INT32_MIN;
  struct BaseHex {
    LatticeCoord vert;
    std::array<Piece, 8> pieces;  // by bits
  };

  LatticeCoord cell_of(const OctantStar& star, int octant) const {
    LatticeCoord cell = star.vert;
    for (int a = 0; a < 3; ++a) cell[a] -= !(octant >> a & 1);
    return cell;
  }

  Piece piece(const OctantStar& star, int octant, int mask) const {
    constexpr int kStride[3] = {1, 3, 9};
    int code = 13;
    for (int a = 0; a < 3; ++a)
      if (mask >> a & 1) code += (octant >> a & 1) ? -kStride[a] : kStride[a];
    return 27 * domain_.cell_index(cell_of(star, octant)) + static_cast<std::size_t>(code);
  }

  template <class PieceOfBits>
  void emit(const OctantStar& star, PieceOfBits&& piece_of_bits) {
    BaseHex hex{star.vert, {}};
    for (int bits = 0; bits < 8; ++bits) hex.pieces[bits] = piece_of_bits(bits);
    hexes_.push_back(hex);
  }

  void emit_star(const OctantStar& star, int wrapped) {
    bool has_clipped = false;
    for (int e = 0; e < 6; ++e)
      has_clipped |= star.num_around_edge(e / 2, e % 2) == 1 && !(wrapped >> e & 1);
    if (star.mask == 0xFF)
      emit(star, [&](int bits) { return piece(star, bits, 0); });
    else if (!has_clipped)
      emit_unclipped(star);
    else if (star.num_octants() == 1)
      emit_corner(star, wrapped);
    else if (star.num_octants() == 2)
      emit_crease(star);
    else
      emit_concave_end(star);
  }

  // One octant. Three clipped creases: an eighth of a cell. One wrapped: no hex, the faces beside
  // the wrapped crease are one, and the other two creases run into each other.
  void emit_corner(const OctantStar& star, int wrapped) {
    const int q = std::countr_zero(static_cast<unsigned>(star.mask));
    if (wrapped == 0) {
      is_pinned_[piece(star, q, 7)] = 1;
      emit(star, [&](int bits) { return piece(star, q, bits ^ q); });
      return;
    }
    const int w = std::countr_zero(static_cast<unsigned>(wrapped)) / 2;
    const int b = 1 << (w + 1) % 3, d = 1 << (w + 2) % 3;
    pieces_.unite(piece(star, q, b), piece(star, q, d));
    pieces_.unite(piece(star, q, 7 ^ b), piece(star, q, 7 ^ d));
  }

  // Two octants: a quarter hex along the crease.
  void emit_crease(const OctantStar& star) {
    const int q0 = std::countr_zero(static_cast<unsigned>(star.mask));
    const int q1 = std::countr_zero(static_cast<unsigned>(star.mask & (star.mask - 1)));
    const int along = q0 ^ q1;
    emit(star, [&](int bits) {
      const int q = (q0 & ~along) | (bits & along);
      return piece(star, q, (bits ^ q) & ~along);
    });
  }

  // Three octants: a concave crease ends between two convex ones; a hex on either side of the
  // middle cell's corner.
  void emit_concave_end(const OctantStar& star) {
    int along = 0, up = 0;
    for (int e = 0; e < 6; ++e)
      if (star.num_around_edge(e / 2, e % 2) == 3) {
        along = 1 << e / 2;
        up = e % 2 ? along : 0;
      }
    int middle = 0;
    for (int q = 0; q < 8; ++q)
      if (star.has(q) && star.is_middle(q, std::countr_zero(static_cast<unsigned>(along))))
        middle = q;
    is_pinned_[piece(star, middle, 7)] = 1;
    for (int q = 0; q < 8; ++q) {
      if (!star.has(q) || q == middle) continue;
      const int across = middle ^ q, beside = 7 ^ along ^ across;
      emit(star, [&](int bits) {
        const bool is_outer = (bits & across) == (q & across);
        int mask = (bits ^ middle) & beside;
        if (mask && !is_outer) mask |= across;
        if ((bits & along) != up) mask |= along;
        return piece(star, is_outer ? q : middle, mask);
      });
    }
  }

  // No clipped crease: at the vertex all boundary pieces of a cell are one; a hex around each
  // interior half-edge.
  void emit_unclipped(const OctantStar& star) {
    for (int q = 0; q < 8; ++q) {
      if (!star.has(q)) continue;
      const Piece corner = piece(star, q, 7);
      for (int a = 0; a < 3; ++a) {
        if (!star.has(q ^ 1 << a)) pieces_.unite(corner, piece(star, q, 1 << a));
        if (star.num_around_edge(a, q >> a & 1) == 3 && star.is_middle(q, a))
          pieces_.unite(corner, piece(star, q, 7 ^ 1 << a));
      }
    }
    for (int e = 0; e < 6; ++e) {
      if (star.num_around_edge(e / 2, e % 2) != 4) continue;
      const int along = 1 << e / 2, up = e % 2 ? along : 0;
      emit(star, [&](int bits) {
        return (bits & along) == up ? piece(star, bits, 0) : piece(star, bits ^ along, 7);
      });
    }
  }

  // The boundary planes of every class of pieces. False when a class lies on two parallel planes.
  // A cell's corner brings its planes only where it is pinned or alone.
  bool collect_planes() {
    planes_.assign(num_pieces_, {kNone, kNone, kNone});
    bool is_thick = true;
    for (const bool is_lone_pass : {false, true})
      for (const LatticeCoord& cell : domain_.roots())
        for (std::size_t code = 0; code < 27; ++code) {
          const Piece p = 27 * domain_.cell_index(cell) + code;
          const bool is_corner = code % 3 != 1 && code / 3 % 3 != 1 && code / 9 != 1;
          Planes& planes = planes_[pieces_.find(p)];
          const bool is_lone = is_corner && !is_pinned_[p];
          if (is_lone != is_lone_pass) continue;
          if (is_lone && planes != Planes{kNone, kNone, kNone}) continue;
          is_thick &= add_planes(cell, code, planes);
        }
    return is_thick;
  }

  bool add_planes(const LatticeCoord& cell, std::size_t code, Planes& planes) const {
    const int offset[3] = {static_cast<int>(code % 3), static_cast<int>(code / 3 % 3),
                           static_cast<int>(code / 9)};
    bool is_consistent = true;
    for (int a = 0; a < 3; ++a) {
      if (offset[a] == 1) continue;
      const std::int32_t coord = (cell[a] + offset[a] / 2) * domain_.root_edge();
      is_consistent &= planes[a] == kNone || planes[a] == coord;
      planes[a] = coord;
    }
    return is_consistent;
  }

  void number_verts() {
    std::vector<std::int32_t> vert_of(num_pieces_, -1);
    for (const BaseHex& base : hexes_) {
      const HexId h = complex_.add_hex();
      LatticeCoord place = base.vert;
      for (int a = 0; a < 3; ++a) place[a] *= domain_.root_edge();
      complex_.places[h] = HexPlace::lattice(place);
      for (int bits = 0; bits < 8; ++bits) {
        std::int32_t& v = vert_of[pieces_.find(base.pieces[bits])];
        if (v < 0) v = complex_.add_vert().value();
        complex_.verts[h][kHexVertexOfBits[bits]] = VertId(v);
      }
    }
  }

  struct KeyedFace {
    std::array<VertId, 4> key;
    HexId hex;
    int lf;
  };

  // Faces with equal vertices are neighbours. False when a hex repeats a vertex, a face has three
  // hexes, two hexes share two faces, or a boundary face lies on no plane.
  bool link_faces() {
    std::vector<KeyedFace> faces;
    for (HexId h : complex_.verts.ids())
      for (int lf = 0; lf < 6; ++lf) {
        KeyedFace face{{}, h, lf};
        for (int k = 0; k < 4; ++k) face.key[k] = complex_.verts[h][kHexFaces[lf][k]];
        std::sort(face.key.begin(), face.key.end());
        if (std::adjacent_find(face.key.begin(), face.key.end()) != face.key.end()) return false;
        faces.push_back(face);
      }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
    for (std::size_t i = 0, n = 0; i < faces.size(); i += n) {
      n = 1;
      while (i + n < faces.size() && faces[i + n].key == faces[i].key) ++n;
      if (n > 2) return false;
      if (n == 2)
        complex_.connect(faces[i].hex, faces[i].lf, faces[i + 1].hex, faces[i + 1].lf);
      else if (!link_to_plane(faces[i].hex, faces[i].lf))
        return false;
    }
    return !has_doublet();
  }

  // The plane through the hex's lattice vertex that all four classes of the face lie on.
  bool link_to_plane(HexId h, int lf) {
    const LatticeCoord& place = complex_.places[h].point();
    for (int a = 0; a < 3; ++a) {
      bool is_common = true;
      for (int lv : kHexFaces[lf]) {
        const Piece p = hexes_[h.index()].pieces[kHexBitsOfVertex[lv]];
        is_common &= planes_[pieces_.find(p)][a] == place[a];
      }
      if (!is_common) continue;
      complex_.links[h][lf] = FaceLink::to_plane(complex_.find_or_add_plane({a, place[a]}));
      return true;
    }
    return false;
  }

  bool has_doublet() const {
    for (HexId h : complex_.verts.ids())
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < i; ++j) {
          const FaceLink a = complex_.links[h][i], b = complex_.links[h][j];
          if (!a.is_plane() && !b.is_plane() && a.hex() == b.hex()) return true;
        }
    return false;
  }

  const Domain& domain_;
  HexComplex& complex_;
  std::vector<OctantStar> stars_;
  std::size_t num_pieces_;
  DisjointSets pieces_;
  std::vector<char> is_pinned_;  // corners that lie on their three planes
  std::vector<Planes> planes_;   // per class
  std::vector<BaseHex> hexes_;
};

}  // namespace

BaseStatus build_general_base(const Domain& domain, HexComplex& complex) {
  complex = {};
  return GeneralBase(domain, complex).run();
}

}  // namespace hexwright::dual
