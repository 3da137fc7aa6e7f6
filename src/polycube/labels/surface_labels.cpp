#include "hexwright/polycube/surface_labels.h"

#include <algorithm>
#include <map>

#include "hexwright/base/error.h"

#include "base/words.h"
#include "geometry/topology/surface_edges.h"

namespace hexwright {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::BadGeometry, "the labelling cannot be mapped to a polycube: " + what);
}

class ChartFinder {
 public:
  ChartFinder(const TriMesh& surface, std::span<const std::uint8_t> labels)
      : surface_(surface), labels_(labels), edges_(compute_surface_edges(surface)) {}

  LabelCharts run() {
    grow();
    check_edges();
    check_corners();
    check_borders();
    check_directions();
    return std::move(result_);
  }

 private:
  std::uint8_t label(TriId t) const { return labels_[t.index()]; }
  Vec3 middle_of(std::size_t e) const {
    return (surface_.positions[edges_.lo(e)] + surface_.positions[edges_.hi(e)]) * 0.5;
  }
  bool is_border(std::size_t e) const {
    const auto sides = edges_.sides_of(e);
    return result_.chart[sides[0].tri] != result_.chart[sides[1].tri];
  }

  void grow() {
    UnionFind sets(static_cast<int>(surface_.num_tris()));
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto sides = edges_.sides_of(e);
      if (sides.size() != 2)
        throw Error(ErrorCode::BadGeometry,
                    "the surface is not closed and manifold at " + place(middle_of(e)) +
                        "; a polycube map needs every edge between two triangles");
      if (label(sides[0].tri) == label(sides[1].tri))
        sets.unite(sides[0].tri.value(), sides[1].tri.value());
    }
    result_.chart = IdVector<TriId, int>(number_sets(sets, surface_.num_tris()));
    for (TriId t : surface_.tris.ids()) {
      const auto chart = static_cast<std::size_t>(result_.chart[t]);
      if (chart >= result_.chart_label.size()) result_.chart_label.resize(chart + 1);
      result_.chart_label[chart] = label(t);
    }
  }

  void check_directions() const {
    for (std::uint8_t wanted = 0; wanted < 6; ++wanted)
      if (std::ranges::find(result_.chart_label, wanted) == result_.chart_label.end())
        refuse("no triangle is labelled " + label_name(wanted) +
               "; a polycube has faces of all six directions");
  }

  void check_edges() const {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!is_border(e)) continue;
      const auto sides = edges_.sides_of(e);
      const std::uint8_t a = label(sides[0].tri), b = label(sides[1].tri);
      if (label_axis(a) == label_axis(b))
        refuse("faces " + label_name(a) + " and " + label_name(b) + " share an edge at " +
               place(middle_of(e)) + "; put a face of another axis between them");
    }
  }

  // Charts meet in corners; each border edge ends a sector of its vertex.
  void check_corners() {
    std::map<VertId, std::vector<TriId>> around;  // the triangles beside the border edges
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (is_border(e))
        for (VertId v : {edges_.lo(e), edges_.hi(e)})
          for (const auto& side : edges_.sides_of(e)) around[v].push_back(side.tri);
    for (const auto& [v, tris] : around) {
      const std::size_t num_borders = tris.size() / 2;
      if (num_borders == 2) continue;
      unsigned axes = 0;
      for (TriId t : tris) axes |= 1u << label_axis(label(t));
      if (num_borders != 3 || axes != 7)
        refuse(
            std::to_string(num_borders) + " borders of faces meet at " +
            place(surface_.positions[v]) +
            "; only corners of three faces, of the three axes, are mapped: move the borders apart "
            "there");
      result_.corners.push_back(v);
    }
  }

  // The borders of each chart, as connected sets of vertices, and how many corners each has.
  void check_borders() const {
    std::map<std::pair<int, VertId>, int> number;  // (chart, border vertex)
    const auto number_of = [&](int chart, VertId v) {
      return number.try_emplace({chart, v}, static_cast<int>(number.size())).first->second;
    };
    std::vector<std::array<int, 2>> links;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (is_border(e))
        for (const auto& side : edges_.sides_of(e)) {
          const int chart = result_.chart[side.tri];
          links.push_back({number_of(chart, edges_.lo(e)), number_of(chart, edges_.hi(e))});
        }
    UnionFind sets(static_cast<int>(number.size()));
    for (const auto& link : links) sets.unite(link[0], link[1]);
    std::map<int, int> num_corners;
    for (const auto& [key, i] : number)
      num_corners[sets.find(i)] +=
          std::binary_search(result_.corners.begin(), result_.corners.end(), key.second);
    for (const auto& [key, i] : number)
      if (num_corners[sets.find(i)] < 4)
        refuse("a border of a face " + name_of(key.first) + " at " +
               place(surface_.positions[key.second]) + " has " +
               std::to_string(num_corners[sets.find(i)]) +
               " corners; it needs four or more: let faces of two other axes meet it");
  }

  std::string name_of(int chart) const {
    return label_name(result_.chart_label[static_cast<std::size_t>(chart)]);
  }

  const TriMesh& surface_;
  std::span<const std::uint8_t> labels_;
  SurfaceEdges edges_;
  LabelCharts result_;
};

}  // namespace

std::string label_name(std::uint8_t label) {
  return std::string(label_sign(label) > 0 ? "+" : "-") +
         static_cast<char>('x' + label_axis(label));
}

LabelCharts find_label_charts(const TriMesh& surface, std::span<const std::uint8_t> labels) {
  if (labels.size() != surface.num_tris())
    throw Error(ErrorCode::BadArgument, std::to_string(labels.size()) + " labels for " +
                                            std::to_string(surface.num_tris()) +
                                            " triangles; give one per triangle");
  for (std::size_t t = 0; t < labels.size(); ++t)
    if (labels[t] > 5)
      throw Error(ErrorCode::BadArgument,
                  "the label of triangle " + std::to_string(t) + " is " +
                      std::to_string(labels[t]) +
                      "; give one of 0 to 5, which stand for +x, -x, +y, -y, +z, -z");
  return ChartFinder(surface, labels).run();
}

}  // namespace hexwright
