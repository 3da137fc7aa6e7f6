// Triangulates the polygons of surface files.
#include "io/surface/polygon_soup.h"

#include <array>

#include "hexwright/base/cancel.h"

#include "io/surface/ear_clipping.h"

namespace hexwright::io {
namespace {

using Tri = std::array<VertId, 3>;

Vec3 tri_normal(const IdVector<VertId, Vec3>& positions, const Tri& t) {
  return cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
}

/// The fold of a quad split into two triangles: cosine between their normals, -1 when one is flat.
double fold_cosine(const IdVector<VertId, Vec3>& positions, const Tri& a, const Tri& b) {
  const Vec3 na = normalized(tri_normal(positions, a)), nb = normalized(tri_normal(positions, b));
  return norm_sq(na) > 0 && norm_sq(nb) > 0 ? dot(na, nb) : -1;
}

void split_quad(const IdVector<VertId, Vec3>& positions, std::span<const VertId> q,
                std::vector<Tri>& out) {
  const Tri a0 = {q[0], q[1], q[2]}, a1 = {q[0], q[2], q[3]};
  const Tri b0 = {q[1], q[2], q[3]}, b1 = {q[1], q[3], q[0]};
  const double fold_a = fold_cosine(positions, a0, a1);
  const double fold_b = fold_cosine(positions, b0, b1);
  constexpr double kTie = 1e-9;  // planar quads differ by rounding only: they keep diagonal 0-2
  const bool use_b = fold_b > fold_a + kTie;
  out.push_back(use_b ? b0 : a0);
  out.push_back(use_b ? b1 : a1);
}

void split_polygon(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon,
                   std::vector<Tri>& out) {
  if (polygon.size() == 3)
    out.push_back({polygon[0], polygon[1], polygon[2]});
  else if (polygon.size() == 4)
    split_quad(positions, polygon, out);
  else
    clip_ears(positions, polygon, out);
}

/// Bytes of the printable character at the start of a text; 0 when there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // The second byte tells forms that are longer than need be, surrogates and what is beyond
  // U+10FFFF.
  const int least = byte(0) == 0xe0 ? 0xa0 : byte(0) == 0xf0 ? 0x90 : 0x80;
  const int most = byte(0) == 0xed ? 0x9f : byte(0) == 0xf4 ? 0x8f : 0xbf;
  return byte(1) >= least && byte(1) <= most ? length : 0;
}

}  // namespace

std::int32_t PolygonSoup::add_group(std::string_view name) {
  const auto next = static_cast<std::int32_t>(group_names.size());
  const auto [at, is_new] = name_to_group.try_emplace(clean_name(name), next);
  if (is_new) group_names.push_back(at->first);
  return at->second;
}

/// What came before the first name has none.
void PolygonSoup::begin_group(std::string_view name) {
  if (group.empty() && !ends.empty()) group.assign(ends.size(), add_group(""));
  current_group = add_group(name);
}

std::string clean_name(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!name.empty() && is_blank(name.front())) name.remove_prefix(1);
  while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
  std::string clean;
  while (!name.empty()) {
    const std::size_t length = utf8_length(name);
    const std::string_view next = length == 0 ? "_" : name.substr(0, length);
    if (clean.size() + next.size() > kLongest) break;
    clean += next;
    name.remove_prefix(next.size());
  }
  return clean;
}

TriMesh triangulate(PolygonSoup&& soup) {
  TriMesh mesh;
  mesh.positions = std::move(soup.positions);
  auto& tris = mesh.tris.raw();
  tris.reserve(soup.ends.size());
  const bool is_named =
      !soup.group_names.empty() && soup.group_names != std::vector<std::string>{""};
  std::size_t begin = 0;
  CancelCheck check_cancelled;
  for (std::size_t p = 0; p < soup.ends.size(); ++p) {
    check_cancelled();
    const std::size_t end = soup.ends[p];
    split_polygon(mesh.positions, std::span(soup.verts).subspan(begin, end - begin), tris);
    if (is_named) mesh.group.resize(tris.size(), soup.group[p]);
    begin = end;
  }
  if (is_named) mesh.group_names = std::move(soup.group_names);
  return mesh;
}

}  // namespace hexwright::io
