// VTK's XML formats field by field: what a hand-written file must hold, and what is refused with
// which words.
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

std::string array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">\n" + values +
         "\n</DataArray>\n";
}

/// The fields of a HyperTreeGrid file as text; the default is a root cube split once beside one
/// that is not.
struct HtgText {
  std::string version = "2.0", branch_factor = "2", transposed = "0";
  std::string x = "0 2 4", y = "1 3", z = "5 7";
  std::string ids = "0 1", depths = "2 1", counts = "1 8 1", bits = "1 0", mask;

  std::string text() const {
    std::string out = "<VTKFile type=\"HyperTreeGrid\" version=\"" + version +
                      "\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n"
                      "<HyperTreeGrid BranchFactor=\"" +
                      branch_factor + "\" TransposedRootIndexing=\"" + transposed +
                      "\" Dimensions=\"3 2 2\">\n<Grid>\n";
    out += array("Float64", "XCoordinates", x) + array("Float64", "YCoordinates", y) +
           array("Float64", "ZCoordinates", z) + "</Grid>\n<Trees>\n";
    if (!bits.empty()) out += array("Bit", "Descriptors", bits);
    out += array("Int64", "NumberOfVerticesPerDepth", counts) + array("Int64", "TreeIds", ids) +
           array("UInt32", "DepthPerTree", depths);
    if (!mask.empty()) out += array("Bit", "Mask", mask);
    return out + "</Trees>\n</HyperTreeGrid>\n</VTKFile>\n";
  }
};

double volume_of(const Grid& grid) {
  double volume = 0;
  for (CellId c : grid.cells.ids()) {
    const Vec3 e = cell_box(grid, c).extent();
    volume += e.x * e.y * e.z;
  }
  return volume;
}

TEST(HtgFields, AHandWrittenFileIsWhatItSays) {
  const TempFolder folder;
  const Grid grid = read_grid(folder.write("a.htg", HtgText().text()));
  EXPECT_EQ(grid.num_cells(), 9u);
  EXPECT_EQ(grid.roots.size(), 2u);
  EXPECT_DOUBLE_EQ(volume_of(grid), 16);
  EXPECT_EQ(cell_box(grid, CellId(0)).lo, (Vec3{0, 1, 5}));
  EXPECT_EQ(count_cells_per_level(grid), (std::vector<std::size_t>{1, 8}));
}

// Transposed, tree 1 lies beside tree 0 along the last axis; a masked root is no part of the
// domain.
TEST(HtgFields, TransposedIndicesAndMasksAreFollowed) {
  const TempFolder folder;
  HtgText file;
  file.transposed = "1";
  file.x = "0 2";
  file.z = "5 7 9";
  const Grid transposed = read_grid(folder.write("a.htg", file.text()));
  EXPECT_EQ(transposed.roots, (std::vector<LatticeCoord>{{0, 0, 0}, {0, 0, 1}}));

  HtgText masked;
  masked.mask = "0 0 0 0 0 0 0 0 0 1";  // nodes: a root, its eight children, the other root
  const Grid rest = read_grid(folder.write("b.htg", masked.text()));
  EXPECT_EQ(rest.num_cells(), 8u);
  EXPECT_DOUBLE_EQ(volume_of(rest), 8);
}

TEST(HtgFields, EveryFieldMadeWrongIsRefusedWithItsReason) {
  const TempFolder folder;
  const struct {
    const char* what;
    void (*change)(HtgText&);
    const char* message;
  } cases[] = {
      {"version", [](HtgText& f) { f.version = "1.0"; }, "version 1.0"},
      {"branch factor", [](HtgText& f) { f.branch_factor = "3"; }, "branch factor"},
      {"no branch factor", [](HtgText& f) { f.branch_factor = ""; }, "branch factor"},
      {"flat grid", [](HtgText& f) { f.z = "5"; }, "not three-dimensional"},
      {"decreasing", [](HtgText& f) { f.x = "4 2 0"; }, "do not increase"},
      {"equal", [](HtgText& f) { f.x = "0 0 0"; }, "do not increase"},
      {"not a number", [](HtgText& f) { f.x = "0 nan 4"; }, "coordinates"},
      {"uneven", [](HtgText& f) { f.x = "0 2 5"; }, "XCoordinates: root cells are not of one size"},
      {"tree id", [](HtgText& f) { f.ids = "0 2"; }, "tree id"},
      {"negative tree id", [](HtgText& f) { f.ids = "-1 1"; }, "tree id"},
      {"depths", [](HtgText& f) { f.depths = "2"; }, "trees and of depths differ"},
      {"depth 0", [](HtgText& f) { f.depths = "2 0"; }, "depth"},
      {"depth 22", [](HtgText& f) { f.depths = "22 1"; }, "depth"},
      {"too shallow", [](HtgText& f) { f.depths = "1 1"; }, "differ"},
      {"too deep", [](HtgText& f) { f.depths = "3 1"; }, ""},
      {"counts", [](HtgText& f) { f.counts = "1 7 1"; }, "numbers of cells per depth"},
      {"counts missing", [](HtgText& f) { f.counts = "1 8"; }, "numbers of cells per depth"},
      {"bits", [](HtgText& f) { f.bits.clear(); }, "descriptors end too early"},
      {"mask inside", [](HtgText& f) { f.mask = "0 0 0 1"; }, "masked cell inside"},
      {"all masked", [](HtgText& f) { f.mask = "1 1 1 1 1 1 1 1 1 1"; }, ""},
      {"same tree twice", [](HtgText& f) { f.ids = "1 1"; }, "overlaps"},
      {"a word", [](HtgText& f) { f.ids = "0 one"; }, "'one'"}};
  for (const auto& c : cases) {
    HtgText file;
    c.change(file);
    try {
      read_grid(folder.write("a.htg", file.text()));
      ADD_FAILURE() << c.what << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << c.what;
      EXPECT_NE(std::string(error.what()).find(c.message), std::string::npos)
          << c.what << ": " << error.what();
      EXPECT_NE(error.where().find("a.htg"), std::string::npos) << c.what;
    }
  }
}

/// The fields of a .vtu file as text; the default is one hex with a region.
struct VtuText {
  std::string points = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
  std::string connectivity = "0 1 2 3 4 5 6 7", offsets = "8", types = "12", region = "5";
  std::string field;  ///< arrays of the field data
  std::string type = "UnstructuredGrid";

  std::string text() const {
    std::string out = "<VTKFile type=\"" + type +
                      "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" + type +
                      ">\n<FieldData>\n" + field +
                      "</FieldData>\n<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\">\n<Points>\n";
    out += array("Float64", "Points", points) + "</Points>\n<Cells>\n";
    if (!connectivity.empty()) out += array("Int32", "connectivity", connectivity);
    if (!offsets.empty()) out += array("Int32", "offsets", offsets);
    if (!types.empty()) out += array("UInt8", "types", types);
    out += "</Cells>\n<CellData>\n" + array("Int32", "region", region) + "</CellData>\n";
    return out + "</Piece>\n</" + type + ">\n</VTKFile>\n";
  }
};

TEST(VtuFields, AHandWrittenFileIsWhatItSays) {
  const TempFolder folder;
  VtuText file;
  file.field = array("Int32", "boundary_quads", "0 3 2 1 4 5 6 7") +
               array("Int32", "boundary_quad_patch", "4 -1") + array("Int32", "corners", "6");
  const HexMesh mesh = read_hex_mesh(folder.write("a.vtu", file.text()));
  EXPECT_EQ(mesh.region[HexId(0)], 5);
  ASSERT_EQ(mesh.labels.quads.size(), 2u);
  EXPECT_EQ(mesh.labels.quads[0].patch, PatchId(4));
  EXPECT_FALSE(mesh.labels.quads[1].patch.is_valid());
  EXPECT_EQ(mesh.labels.corners, std::vector<VertId>{VertId(6)});
}

// Labels are no reason to refuse a mesh of another program: numbers that are none count as "none".
TEST(VtuFields, RegionsThatAreNoIntegersAreNoRegions) {
  const TempFolder folder;
  for (const char* region : {"nan", "1e300", "-1e300", "4294967296"}) {
    VtuText file;
    file.region = region;
    EXPECT_EQ(read_hex_mesh(folder.write("a.vtu", file.text())).region[HexId(0)], -1) << region;
  }
}

TEST(VtuFields, EveryFieldMadeWrongIsRefusedWithItsReason) {
  const TempFolder folder;
  const struct {
    const char* what;
    void (*change)(VtuText&);
    const char* message;
  } cases[] = {
      {"type", [](VtuText& f) { f.type = "ImageData"; }, "ImageData"},
      {"points cut", [](VtuText& f) { f.points += " 1"; }, "no multiple of 3"},
      {"point nan", [](VtuText& f) { f.points.replace(0, 1, "nan"); }, "point 0"},
      {"point inf", [](VtuText& f) { f.points.replace(0, 1, "inf"); }, "not finite"},
      {"no connectivity", [](VtuText& f) { f.connectivity.clear(); }, "'connectivity'"},
      {"no offsets", [](VtuText& f) { f.offsets.clear(); }, "'offsets'"},
      {"no types", [](VtuText& f) { f.types.clear(); }, "'types'"},
      {"index", [](VtuText& f) { f.connectivity = "0 1 2 3 4 5 6 8"; }, "vertex 8 of 8"},
      {"negative index", [](VtuText& f) { f.connectivity = "0 1 2 3 4 5 6 -1"; }, "out of range"},
      {"index nan", [](VtuText& f) { f.connectivity = "0 1 2 3 4 5 6 nan"; }, "out of range"},
      {"short cell", [](VtuText& f) { f.offsets = "7"; }, "7 vertices instead of 8"},
      {"long cell", [](VtuText& f) { f.offsets = "9"; }, "outside the connectivity"},
      {"cells differ", [](VtuText& f) { f.types = "12 12"; }, "1 cells but 2 cell types"},
      {"decreasing", [](VtuText& f) { f.offsets = "8 4", f.types = "12 12"; }, "cell 1"},
      {"other kind", [](VtuText& f) { f.types = "13"; }, "no hexahedron"},
      {"quads cut", [](VtuText& f) { f.field = array("Int32", "boundary_quads", "0 1 2"); },
       "multiple of 4"},
      {"quad vertex", [](VtuText& f) { f.field = array("Int32", "boundary_quads", "0 1 2 8"); },
       "row 0"},
      {"corner nan", [](VtuText& f) { f.field = array("Float32", "corners", "nan"); }, "row 0"},
      {"edge vertex", [](VtuText& f) { f.field = array("Int32", "feature_edges", "0 1 2 -1"); },
       "row 1"}};
  for (const auto& c : cases) {
    VtuText file;
    c.change(file);
    try {
      read_hex_mesh(folder.write("a.vtu", file.text()));
      ADD_FAILURE() << c.what << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << c.what;
      EXPECT_NE(std::string(error.what()).find(c.message), std::string::npos)
          << c.what << ": " << error.what();
      EXPECT_NE(error.where().find("a.vtu"), std::string::npos) << c.what;
    }
  }
}

// Appended data lies at offsets that the arrays name: none may lead out of the file.
TEST(VtuFields, OffsetsBehindTheEndAreRefused) {
  const TempFolder folder;
  write_hex_mesh(folder / "a.vtu", test::labelled_box());
  const std::string text = test::slurp(folder / "a.vtu");
  std::size_t num_offsets = 0;
  for (std::size_t at = text.find("offset=\""); at != std::string::npos;
       at = text.find("offset=\"", at + 1)) {
    const std::size_t begin = at + 8, end = text.find('"', begin);
    for (const char* wrong : {"99999999", "18446744073709551615", "x", "-1"}) {
      std::string changed = text;
      changed.replace(begin, end - begin, wrong);
      const auto path = folder.write("b.vtu", changed);
      try {
        EXPECT_FALSE(read_hex_mesh(path).find_problem());  // "x" is 0 to the parser: another array
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::BadFile) << error.what();
      }
    }
    ++num_offsets;
  }
  EXPECT_GT(num_offsets, 5u);
}

}  // namespace
}  // namespace hexwright
