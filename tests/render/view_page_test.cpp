// What a page holds: packed numbers that read back, which hexes of a large mesh, names that are
// safe in markup, the same bytes for any number of threads. What a browser makes of it:
// tests/viewer.
#include "hexwright/render/view_page.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/io/base64.h"

#include "helpers.h"
#include "render/page/packing.h"
#include "render/page/view_arrays.h"
#include "render/page/view_sample.h"
#include "render/page/view_summary.h"

namespace hexwright {
namespace {

using test::box_hex_mesh;

using Numbers = std::vector<std::uint32_t>;

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int num_bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    num_bits += 6;
    if (num_bits < 8) continue;
    num_bits -= 8;
    bytes += static_cast<char>(bits >> num_bits & 0xff);
  }
  return bytes;
}

std::string inflate(const std::string& packed, std::size_t size) {
  std::string bytes(size, '\0');
  uLongf length = static_cast<uLongf>(size);
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                 reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  EXPECT_EQ(status, Z_OK);
  EXPECT_EQ(length, size);
  return bytes;
}

TEST(Base64, GivesTheTextsOfItsStandard) {  // RFC 4648, section 10
  const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : cases) EXPECT_EQ(to_base64(bytes), text);
}

TEST(Packing, PlanesAndDeltasReadBack) {
  std::mt19937 random(5);
  for (int num_bytes : {1, 2, 4}) {
    const std::uint32_t mask = num_bytes == 4 ? 0xffffffffU : (1U << (8 * num_bytes)) - 1;
    Numbers values = {0, mask, 1, mask - 1, mask / 2, mask / 2 + 1};
    for (int i = 0; i < 300; ++i) values.push_back(static_cast<std::uint32_t>(random()) & mask);
    const std::string bytes =
        inflate(from_base64(to_packed_text(to_planes(to_deltas(values, num_bytes), num_bytes))),
                values.size() * static_cast<std::size_t>(num_bytes));
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint32_t code = 0;
      for (int byte = 0; byte < num_bytes; ++byte)
        code |= static_cast<std::uint32_t>(static_cast<unsigned char>(
                    bytes[i + static_cast<std::size_t>(byte) * values.size()]))
                << (8 * byte);
      last = (last + (code >> 1 ^ (0U - (code & 1)))) & mask;
      ASSERT_EQ(last, values[i]) << i << " of " << num_bytes << " bytes";
    }
  }
}

TEST(Packing, SmallDifferencesOfEitherSignAreSmallNumbers) {
  EXPECT_EQ(to_deltas(Numbers{5, 4, 6, 6, 3}, 4), (Numbers{10, 1, 4, 0, 5}));
}

// Its steps are those of the page's slider, so that a filter cuts between codes.
TEST(QualityCode, StepsAtMultiplesOfOne250th) {
  for (double inverted : {0.0, -0.3, -1.0, std::nan("")}) EXPECT_EQ(quality_code(inverted), 0);
  EXPECT_EQ(quality_code(1e-9), 1);
  EXPECT_EQ(quality_code(1), 250);
  for (int k = 1; k < 250; ++k) {
    EXPECT_EQ(quality_code((k + 0.01) / 250), k + 1);
    EXPECT_EQ(quality_code((k - 0.01) / 250), k);
  }
}

TEST(ViewSample, OfALargeMeshHasSkinSlicesAndWorst) {
  const HexMesh mesh = box_hex_mesh(30, 30, 30);
  IdVector<HexId, double> values(mesh.num_hexes(), 1.0);
  for (std::size_t i = 0; i < 5; ++i) values[HexId(13515 + i)] = 0.1 * static_cast<double>(i);
  const HexNeighbors adjacency = compute_hex_neighbors(mesh);
  const ViewSample whole = choose_view_sample(mesh, adjacency, values, 27000);
  EXPECT_TRUE(whole.is_whole);
  EXPECT_EQ(whole.hexes.size(), 27000U);
  const ViewSample part = choose_view_sample(mesh, adjacency, values, 26999);
  EXPECT_FALSE(part.is_whole);
  EXPECT_EQ(part.num_skin, 27000U - 28 * 28 * 28);
  EXPECT_TRUE(std::is_sorted(part.hexes.begin(), part.hexes.end()));
  EXPECT_LT(part.hexes.size(), 27000U);
  for (HexId h : mesh.hexes.ids()) {
    const bool is_taken = std::binary_search(part.hexes.begin(), part.hexes.end(), h);
    const auto& beyond = adjacency.neighbor[h];
    const bool is_skin =
        std::any_of(beyond.begin(), beyond.end(), [](HexId other) { return !other.is_valid(); });
    EXPECT_TRUE(is_taken || (!is_skin && values[h] == 1)) << h.value();
  }
  // Behind the worst by number (all values but five are equal), inside are the slices alone: the
  // hexes on both sides of the planes a little beyond 7.5, 15 and 22.5.
  for (int i = 1; i < 29; ++i) {
    const HexId h((25 * 30 + 20) * 30 + i);
    const bool is_sliced = i == 7 || i == 8 || i == 14 || i == 15 || i == 22 || i == 23;
    EXPECT_EQ(std::binary_search(part.hexes.begin(), part.hexes.end(), h), is_sliced) << i;
  }
}

// Other programs number their sets as they like.
TEST(ViewPage, HoldsAnyNumberOfPatchesAndRegions) {
  HexMesh mesh = box_hex_mesh(2, 1, 1);
  mesh.labels.quads.push_back({face_verts(mesh, {HexId(0), 0}), PatchId(70000)});
  const ViewScene scene = make_view_scene(mesh, {});
  const ViewArrays arrays = make_view_arrays(mesh, scene, {}, region_tags(mesh));
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [](const auto& array) { return array.first == "patches"; });
  ASSERT_NE(found, arrays.end());
  const std::string bytes = inflate(from_base64(found->second), 4 * 10);
  std::uint32_t first = 0;
  for (std::size_t k = 0; k < 4; ++k)
    first |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[10 * k])) << (8 * k);
  EXPECT_EQ(first, 70001U);
}

TEST(ViewPage, IsTheSameForAnyNumberOfThreads) {
  const HexMesh mesh = box_hex_mesh(12, 9, 11);
  ViewOptions options;
  options.max_whole_hexes = 500;
  const std::string page = make_view_page(mesh, options);
  const ThreadLimit one(1);
  EXPECT_EQ(make_view_page(mesh, options), page);
}

/// The value of an array, or empty.
std::string find_array(const std::string& page, const std::string& name) {
  const std::string mark = "id=\"array-" + name + "\"";
  const auto at = page.find(mark);
  if (at == std::string::npos) return "";
  const auto begin = page.find('>', at) + 1;
  return page.substr(begin, page.find('<', begin) - begin);
}

TEST(ViewPage, HoldsTheNodesOfCurvedEdgesOnly) {
  HexMesh mesh = box_hex_mesh(2, 1, 1);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  EXPECT_EQ(find_array(make_view_page(mesh, {}), "hex_mids"), "");
  // An edge that both hexes have.
  const EdgeId edge = mesh.mid_nodes->hex_to_edge[HexId(0)][1];
  ASSERT_EQ(mesh.mid_nodes->hex_to_edge[HexId(1)][3], edge);
  mesh.mid_nodes->edges[edge].z -= 0.2;
  const std::string page = make_view_page(mesh, {});
  const std::string planes = inflate(from_base64(find_array(page, "hex_mids")), 4 * 24);
  Numbers expected(24, 0);
  expected[1] = expected[12 + 3] = 1;
  EXPECT_EQ(planes, to_planes(to_deltas(expected, 4), 4));
  EXPECT_NE(find_array(page, "mid_positions"), "");
}

TEST(ViewPage, NamesDoNotBecomeMarkup) {
  ViewOptions options;
  options.title = "</title></script><script>alert(1)</script>";
  options.fields.push_back({"</script><b>", std::vector<double>(1, 2.5)});
  const std::string page = make_view_page(box_hex_mesh(1, 1, 1), options);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_NE(page.find("&lt;/title>"), std::string::npos);
}

TEST(ViewPage, RefusesWhatCannotBeShown) {
  EXPECT_THROW(make_view_page(HexMesh{}, {}), Error);
  ViewOptions options;
  options.fields.push_back({"level", {1, 2}});
  EXPECT_THROW(make_view_page(box_hex_mesh(1, 1, 1), options), Error);
}

// A mesh that is damaged is the one to be looked at.
TEST(ViewPage, ShowsInvertedAndNonConformingMeshes) {
  HexMesh mesh = box_hex_mesh(2, 2, 2);
  mesh.positions[VertId(13)] = {5, 5, 5};
  mesh.hexes.push_back(mesh.hexes[HexId(0)]);
  EXPECT_NE(make_view_page(mesh, {}).find("\"inverted\":"), std::string::npos);
}

}  // namespace
}  // namespace hexwright
