// Order matters: interface faces are collected, then all vertices on them split (changes are listed
// first and applied last, as stars are read through old ids), then the layer's hexes made and
// linked. A layer hex finds its side neighbours by turning about the interface face's edges through
// inner hexes, so that no global search is needed.
#include "dual/pillows/pillow.h"

#include "hexwright/base/assert.h"
#include "hexwright/base/cancel.h"

namespace hexwright::dual {

namespace {

// The side face of a layer hex that stands on edge k of its bottom.
constexpr std::array<int, 4> kSideFace = {2, 1, 3, 0};

int find_local_vert(const std::array<VertId, 8>& hex, int lf, VertId v) {
  for (int lv : kHexFaces[lf])
    if (hex[lv] == v) return lv;
  HEXWRIGHT_ASSERT(false);
  return 0;
}

}  // namespace

HexId PillowInserter::insert(std::span<const HexId> inside) {
  first_layer_hex_ = HexId(complex_.num_hexes());
  is_inside_.resize(complex_.num_hexes(), 0);
  slot_.resize(complex_.num_hexes(), 0);
  is_vert_done_.resize(static_cast<std::size_t>(complex_.num_verts), 0);

  for (HexId h : inside) is_inside_[h.index()] = 1;
  collect_interface(inside);
  split_verts();
  link_layer();

  for (HexId h : inside) is_inside_[h.index()] = 0;
  for (VertId v : done_verts_) is_vert_done_[v.index()] = 0;
  done_verts_.clear();
  return first_layer_hex_;
}

void PillowInserter::collect_interface(std::span<const HexId> inside) {
  interface_.clear();
  CancelCheck check_cancelled;
  for (HexId h : inside) {
    check_cancelled();
    for (int lf = 0; lf < 6; ++lf) {
      const FaceLink link = complex_.links[h][lf];
      if (link.is_plane() || is_inside(link.hex())) continue;
      InterfaceFace face{
          h, link.hex(), static_cast<std::int8_t>(lf), static_cast<std::int8_t>(link.lf()), {}};
      for (int k = 0; k < 4; ++k)
        face.outer_vert[k] = static_cast<std::int8_t>(find_local_vert(
            complex_.verts[face.outer], face.outer_lf, complex_.verts[h][kHexFaces[lf][k]]));
      interface_.push_back(face);
    }
  }
}

// Old vertex ids must stay readable until every star is split, hence the list of changes.
void PillowInserter::split_verts() {
  changes_.clear();
  CancelCheck check_cancelled;
  for (const InterfaceFace& face : interface_) {
    check_cancelled();
    for (int lv : kHexFaces[face.inner_lf]) {
      const VertId v = complex_.verts[face.inner][lv];
      if (is_vert_done_[v.index()]) continue;
      is_vert_done_[v.index()] = 1;
      done_verts_.push_back(v);
      split_vert(v, face.inner);
    }
  }
  for (const CornerChange& c : changes_) complex_.verts[c.hex][c.lv] = c.vert;
}

// Gives each class of corners around v its own copy: inner corners are joined through faces, outer
// ones through edges. The outer class of the smallest star index keeps v itself.
void PillowInserter::split_vert(VertId v, HexId start) {
  gather_star(v, start);
  join_outer_across_edges();
  const int count = static_cast<int>(star_.size());
  int keeper = -1;
  for (int i = 0; i < count && keeper < 0; ++i)
    if (!is_inside(star_[i].hex)) keeper = parts_.find(i);
  HEXWRIGHT_ASSERT(keeper >= 0);
  for (int r = 0; r < count; ++r) {
    if (parts_.find(r) != r || r == keeper) continue;
    const VertId copy = complex_.add_vert();
    for (int i = r; i < count; ++i)
      if (parts_.find(i) == r) changes_.push_back({star_[i].hex, star_[i].lv, copy});
  }
}

// All corners at v, found by crossing faces; corners of the same side that share a face are joined.
void PillowInserter::gather_star(VertId v, HexId start) {
  star_.clear();
  parts_.clear();
  const auto visit = [&](HexId h, int lv) {
    const int slot = slot_[h.index()];
    if (slot < static_cast<int>(star_.size()) && star_[slot].hex == h) return slot;
    slot_[h.index()] = static_cast<std::int32_t>(star_.size());
    star_.push_back({h, lv});
    return parts_.add();
  };
  int start_lv = 0;
  while (complex_.verts[start][start_lv] != v) ++start_lv;
  visit(start, start_lv);
  for (int i = 0; i < static_cast<int>(star_.size()); ++i)
    for (int lf : kFacesOfVertex[star_[i].lv]) {
      const FaceLink link = complex_.links[star_[i].hex][lf];
      if (link.is_plane()) continue;
      const int lv = find_local_vert(complex_.verts[link.hex()], link.lf(), v);
      const int j = visit(link.hex(), lv);
      if (is_inside(star_[i].hex) == is_inside(link.hex())) parts_.unite(i, j);
    }
}

// Needed only where the outer corners fall apart into several face-connected parts.
void PillowInserter::join_outer_across_edges() {
  const int count = static_cast<int>(star_.size());
  int num_outer_parts = 0;
  for (int i = 0; i < count; ++i)
    num_outer_parts += !is_inside(star_[i].hex) && parts_.find(i) == i;
  if (num_outer_parts < 2) return;
  const auto edge_end = [&](int i, int k) {
    return complex_.verts[star_[i].hex][kHexCornerNeighbors[star_[i].lv][k]];
  };
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      if (is_inside(star_[i].hex) || is_inside(star_[j].hex)) continue;
      for (int k = 0; k < 9; ++k)
        if (edge_end(i, k / 3) == edge_end(j, k % 3)) parts_.unite(i, j);
    }
}

void PillowInserter::link_layer() {
  CancelCheck check_cancelled;
  for (const InterfaceFace& face : interface_) {
    check_cancelled();
    const HexId h = complex_.add_hex();
    for (int k = 0; k < 4; ++k) {
      complex_.verts[h][k] = complex_.verts[face.inner][kHexFaces[face.inner_lf][k]];
      complex_.verts[h][4 + k] = complex_.verts[face.outer][face.outer_vert[k]];
    }
    complex_.connect(h, 4, face.inner, face.inner_lf);
    complex_.connect(h, 5, face.outer, face.outer_lf);
  }
  HexId h = first_layer_hex_;
  for (const InterfaceFace& face : interface_) {
    check_cancelled();
    for (int k = 0; k < 4; ++k) link_side(h, face, k);
    ++h;
  }
}

// Turns about edge k of the interface face through inner hexes until the next interface face (its
// layer hex is the neighbour) or the domain's boundary (the layer ends there).
void PillowInserter::link_side(HexId layer_hex, const InterfaceFace& face, int k) {
  HexId h = face.inner;
  FaceEdge at = {face.inner_lf, k};
  for (;;) {
    at = kFaceAcrossEdge[at.lf][at.k];
    const FaceLink link = complex_.links[h][at.lf];
    if (link.is_plane()) {
      complex_.links[layer_hex][kSideFace[k]] = link;
      return;
    }
    // The layer of an interface face has that face's vertices as its bottom, in the same order.
    if (link.hex() >= first_layer_hex_) {
      complex_.links[layer_hex][kSideFace[k]] = FaceLink::to_face(link.hex(), kSideFace[at.k]);
      return;
    }
    const VertId edge_end = complex_.verts[h][kHexFaces[at.lf][(at.k + 1) % 4]];
    h = link.hex();
    at = {link.lf(), 0};
    while (complex_.verts[h][kHexFaces[at.lf][at.k]] != edge_end) ++at.k;
  }
}

}  // namespace hexwright::dual
