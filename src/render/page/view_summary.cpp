#include "render/page/view_summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "hexwright/base/cancel.h"
#include "hexwright/io/set_table.h"
#include "hexwright/quality/verdict_json.h"
#include "hexwright/version.h"

#include "mesh/quad.h"
#include "render/page/view_arrays.h"

namespace hexwright {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kNumWorstListed = 100;

Json to_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

Json list_patches(const HexMesh& mesh) {
  struct Patch {
    std::size_t num_quads = 0;
    double area = 0;
  };
  std::vector<Patch> patches;
  for (const LabeledQuad& quad : mesh.labels.quads) {
    if (!quad.patch.is_valid()) continue;
    patches.resize(std::max(patches.size(), quad.patch.index() + 1));
    ++patches[quad.patch.index()].num_quads;
    patches[quad.patch.index()].area += patch_area(mesh.positions, quad.verts);
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < patches.size(); ++i)
    list.push_back({{"name", set_name(mesh, SetKind::Patch, PatchId(i).value())},
                    {"quads", patches[i].num_quads},
                    {"area", patches[i].area}});
  return list;
}

Json list_curves(const HexMesh& mesh) {
  struct Curve {
    std::size_t num_edges = 0;
    double length = 0;
  };
  std::vector<Curve> curves;
  for (const LabeledEdge& edge : mesh.labels.edges) {
    if (!edge.curve.is_valid()) continue;
    curves.resize(std::max(curves.size(), edge.curve.index() + 1));
    ++curves[edge.curve.index()].num_edges;
    curves[edge.curve.index()].length +=
        distance(mesh.positions[edge.verts[0]], mesh.positions[edge.verts[1]]);
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < curves.size(); ++i)
    list.push_back({{"name", set_name(mesh, SetKind::Curve, CurveId(i).value())},
                    {"edges", curves[i].num_edges},
                    {"length", curves[i].length}});
  return list;
}

Json list_regions(const HexMesh& mesh, const std::vector<std::int32_t>& tags) {
  std::vector<std::size_t> counts(tags.size(), 0);
  std::vector<double> volumes(tags.size(), 0);
  CancelCheck check_cancelled;
  for (HexId h : mesh.hexes.ids()) {
    check_cancelled();
    const std::int32_t tag = mesh.region.empty() ? 0 : mesh.region[h];
    const auto i =
        static_cast<std::size_t>(std::lower_bound(tags.begin(), tags.end(), tag) - tags.begin());
    ++counts[i];
    volumes[i] += hex_volume(mesh.corners(h));
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < tags.size(); ++i)
    list.push_back({{"name", set_name(mesh, SetKind::Region, tags[i])},
                    {"tag", tags[i]},
                    {"hexes", counts[i]},
                    {"volume", volumes[i]}});
  return list;
}

// With exact corners: the page's own positions are quantised.
Json list_worst(const HexMesh& mesh, const IdVector<HexId, double>& values) {
  std::vector<HexId> order;
  for (HexId h : values.ids()) order.push_back(h);
  const std::size_t count = std::min(kNumWorstListed, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
      [&](HexId a, HexId b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    Json verts = Json::array(), corners = Json::array();
    for (VertId v : mesh.hexes[order[i]]) {
      verts.push_back(v.value());
      corners.push_back(to_json(mesh.positions[v]));
    }
    list.push_back({{"hex", order[i].value()},
                    {"scaled_jacobian", values[order[i]]},
                    {"verts", verts},
                    {"corners", corners}});
  }
  return list;
}

Json describe_quality(const IdVector<HexId, double>& values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const auto num_inverted =
      std::count_if(values.begin(), values.end(), [](double value) { return !(value > 0); });
  return {{"min", *std::min_element(values.begin(), values.end())},
          {"avg", sum / static_cast<double>(values.size())},
          {"inverted", num_inverted}};
}

Json describe_sample(const ViewSample& sample) {
  if (sample.is_whole) return nullptr;
  return {{"skin", sample.num_skin}, {"worst", sample.num_worst}, {"slices", sample.slices}};
}

Json describe_verdict(const Verdict* verdict) {
  if (!verdict) return nullptr;
  return {{"valid", verdict->is_valid()},
          {"failures", verdict->failures},
          {"warnings", verdict->warnings},
          {"figures", figures_to_text(*verdict)}};
}

Json list_fields(const ViewOptions& options) {
  Json list = Json::array();
  for (const HexField& field : options.fields) {
    const auto [low, high] = field_range(field);
    const bool is_whole =
        high - low <= 255 && std::all_of(field.values.begin(), field.values.end(),
                                         [](double v) { return v == std::floor(v); });
    list.push_back({{"name", field.name}, {"low", low}, {"high", high}, {"whole", is_whole}});
  }
  return list;
}

// A '<' could close the script element.
std::string for_script(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

}  // namespace

std::vector<std::int32_t> region_tags(const HexMesh& mesh) {
  std::vector<std::int32_t> tags = mesh.region.raw();
  if (tags.empty()) tags.push_back(0);
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

std::string view_summary(const HexMesh& mesh, const ViewScene& scene, const ViewOptions& options,
                         const std::vector<std::int32_t>& regions) {
  const Box3 box = view_box(mesh, options);
  Json summary = {{"version", HEXWRIGHT_VERSION},
                  {"title", options.title},
                  {"box", {{"low", to_json(box.lo)}, {"high", to_json(box.hi)}}},
                  {"hexes", mesh.num_hexes()},
                  {"verts", mesh.num_verts()},
                  {"shown_hexes", scene.sample.hexes.size()},
                  {"shown_verts", sampled_verts(mesh, scene.sample).size()},
                  {"sample", describe_sample(scene.sample)},
                  {"quality", describe_quality(scene.scaled_jacobian)},
                  {"verdict", describe_verdict(options.verdict)},
                  {"regions", list_regions(mesh, regions)},
                  {"patches", list_patches(mesh)},
                  {"curves", list_curves(mesh)},
                  {"corners", mesh.labels.corners.size()},
                  {"worst", list_worst(mesh, scene.scaled_jacobian)},
                  {"fields", list_fields(options)},
                  {"distance", nullptr},
                  {"surface", nullptr}};
  if (options.surface) {
    summary["distance"] = {{"max", largest_distance(scene)},
                           {"diagonal", options.surface->diagonal()}};
    summary["surface"] = {{"verts", options.surface->surface().num_verts()},
                          {"tris", options.surface->surface().num_tris()}};
  }
  return for_script(summary);
}

}  // namespace hexwright
