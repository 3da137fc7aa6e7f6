// Every field of a small file made wrong, one at a time, and every file cut at every byte: what
// comes out is the whole, or a refusal that names the file and line, and what to do.
#include <cctype>
#include <optional>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/surface_io.h"

#include "io/sample_meshes.h"
#include "io/temp_folder.h"
#include "io/text/byte_reader.h"

namespace hexwright {
namespace {

using test::TempFolder;

enum class Kind { Surface, Hexes, Tets, Cells };

/// Reads a file of a kind; returns the number of its elements.
std::size_t read_any(Kind kind, const std::filesystem::path& path) {
  switch (kind) {
    case Kind::Surface:
      return read_surface(path).mesh.num_tris();
    case Kind::Hexes:
      return read_hex_mesh(path).num_hexes();
    case Kind::Tets:
      return read_tet_mesh(path).num_tets();
    default:
      return read_grid(path).num_cells();
  }
}

struct SmallFile {
  const char* name;
  Kind kind;
  std::string text;
  std::size_t num_elements;
  /// A file without a count of its elements may be cut to a shorter valid one.
  bool is_counted = true;
};

const std::string kVtkPoints =
    "DATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n"
    "0 1 1\n";

const std::vector<SmallFile>& small_files() {
  static const std::vector<SmallFile> kFiles = {
      {"a.off", Kind::Surface,
       "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n"
       "3 0 3 2\n",
       4},
      {"a.obj", Kind::Surface,
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
       "f 1 4 3\n",
       4, false},
      {"a.stl", Kind::Surface,
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\nvertex 1 0 2\n"
       "vertex 0 1 2\nendloop\nendfacet\nendsolid a\n",
       2},
      {"a.ply", Kind::Surface,
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
       "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n",
       2},
      {"a.mesh", Kind::Hexes,
       "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n"
       "0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\nHexahedra\n1\n1 2 3 4 5 6 7 8 3\nEnd\n",
       1},
      {"t.mesh", Kind::Tets,
       "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 1 0\n"
       "Tetrahedra\n1\n1 2 3 4 0\nEnd\n",
       1},
      {"a.vtk", Kind::Hexes,
       "# vtk DataFile Version 3.0\nt\nASCII\n" + kVtkPoints +
           "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n",
       1},
      {"b.vtk", Kind::Hexes,
       "# vtk DataFile Version 5.1\nt\nASCII\n" + kVtkPoints +
           "CELLS 2 8\nOFFSETS vtktypeint64\n0 8\nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7\n"
           "CELL_TYPES 1\n12\n",
       1},
      {"a.vtu", Kind::Hexes,
       "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
       "<UnstructuredGrid>\n<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\">\n<Points>\n"
       "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
       "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n</DataArray>\n</Points>\n<Cells>\n"
       "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n0 1 2 3 4 5 6 7\n"
       "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n8\n"
       "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n12\n"
       "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
       1},
      {"a.cells", Kind::Cells,
       "# origin 0 0 0 size 2\n# roots 0 0 0 1 0 0\n0 1 0 0\n1 0 0 0\n1 1 0 0\n1 0 1 0\n1 1 1 0\n"
       "1 0 0 1\n1 1 0 1\n1 0 1 1\n1 1 1 1\n",
       9}};
  return kFiles;
}

/// The error that reading must throw, or null when the file is accepted.
std::optional<Error> refusal(const SmallFile& file, const std::filesystem::path& path) {
  try {
    read_any(file.kind, path);
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

/// A message tells what to do when it has one of these verbs.
bool has_remedy(const std::string& message) {
  for (const char* verb : {"export", "correct", "give", "repair", "remove", "write", "use ",
                           "simplify", "check", "download", "expected", "need"})
    if (message.find(verb) != std::string::npos) return true;
  return false;
}

void expect_good_refusal(const Error& error, const SmallFile& file, const std::string& what) {
  EXPECT_EQ(error.code(), ErrorCode::BadFile) << file.name << " " << what;
  EXPECT_NE(error.where().find(file.name), std::string::npos) << what << ": " << error.what();
  EXPECT_TRUE(has_remedy(error.what())) << file.name << " " << what << ": " << error.what();
}

TEST(SmallFiles, AreReadWhole) {
  const TempFolder folder;
  for (const SmallFile& file : small_files())
    EXPECT_EQ(read_any(file.kind, folder.write(file.name, file.text)), file.num_elements)
        << file.name;
}

TEST(SmallFiles, CutAtEveryByteAreWholeOrRefusedWithARemedy) {
  const TempFolder folder;
  for (const SmallFile& file : small_files())
    for (std::size_t size = 0; size < file.text.size(); ++size) {
      const auto path = folder.write(file.name, file.text.substr(0, size));
      const std::string what = "cut at " + std::to_string(size);
      if (const auto error = refusal(file, path)) {
        expect_good_refusal(*error, file, what);
        continue;
      }
      const std::size_t count = read_any(file.kind, path);
      EXPECT_TRUE(!file.is_counted || count == file.num_elements) << file.name << " " << what;
      EXPECT_LE(count, file.num_elements) << file.name << " " << what;
    }
}

/// The words of a text with their places.
struct Word {
  std::size_t begin, size, line;
};
std::vector<Word> words_of(const std::string& text) {
  std::vector<Word> words;
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    if (std::isspace(static_cast<unsigned char>(text[i]))) {
      line += text[i++] == '\n';
      continue;
    }
    const std::size_t begin = i;
    while (i < text.size() && !std::isspace(static_cast<unsigned char>(text[i]))) ++i;
    words.push_back({begin, i - begin, line});
  }
  return words;
}

bool is_number(const std::string& word) {
  return word.find_first_not_of("0123456789.+-") == std::string::npos;
}

/// Numbers that a reader passes over: normals, counts nobody needs, and comments.
bool is_unused(const SmallFile& file, const Word& word) {
  const std::string line_text = [&] {
    const auto begin = file.text.rfind('\n', word.begin) + 1;
    return file.text.substr(begin, file.text.find('\n', word.begin) - begin);
  }();
  if (line_text.starts_with("facet normal")) return true;    // recomputed
  if (line_text.starts_with("# vtk DataFile")) return true;  // told elsewhere
  if (line_text == "4 4 0" && word.begin + 1 == file.text.find('\n', word.begin)) return true;
  return false;
}

// A coordinate, count, index or level that is no number is refused at its own line.
TEST(SmallFiles, EveryNumberThatIsNoneIsRefusedAtItsLine) {
  const TempFolder folder;
  for (const SmallFile& file : small_files()) {
    if (std::string(file.name) == "a.vtu") continue;  // its errors name arrays, not lines
    int num_tried = 0;
    for (const Word& word : words_of(file.text)) {
      if (!is_number(file.text.substr(word.begin, word.size)) || is_unused(file, word)) continue;
      for (const char* wrong : {"x", "1e999", "--1", "nan", "1.5.2", "0x1"}) {
        std::string text = file.text;
        text.replace(word.begin, word.size, wrong);
        const std::string what = "line " + std::to_string(word.line) + " with " + wrong;
        const auto error = refusal(file, folder.write(file.name, text));
        ASSERT_TRUE(error) << file.name << " " << what << " was accepted";
        expect_good_refusal(*error, file, what);
        EXPECT_TRUE(error->where().ends_with(":" + std::to_string(word.line)) ||
                    error->where().find(": point ") != std::string::npos)
            << what << ": " << error->what();
        ++num_tried;
      }
    }
    EXPECT_GT(num_tried, 30) << file.name;
  }
}

// Numbers that are numbers but too large: never a crash, never more elements than the file has.
TEST(SmallFiles, EveryNumberMadeHugeOrNegativeIsSoundOrRefusedWithARemedy) {
  const TempFolder folder;
  for (const SmallFile& file : small_files())
    for (const Word& word : words_of(file.text)) {
      if (!is_number(file.text.substr(word.begin, word.size))) continue;
      for (const char* wrong : {"-1", "2147483647", "4294967296", "9223372036854775807",
                                "18446744073709551616", "1e300", "-1e300"}) {
        std::string text = file.text;
        text.replace(word.begin, word.size, wrong);
        const std::string what = "line " + std::to_string(word.line) + " with " + wrong;
        const auto path = folder.write(file.name, text);
        if (const auto error = refusal(file, path))
          expect_good_refusal(*error, file, what);
        else
          EXPECT_LE(read_any(file.kind, path), file.num_elements) << file.name << " " << what;
      }
    }
}

// A line lost or doubled changes the meaning of every counted format.
TEST(SmallFiles, LinesLostAreNoticedOrHarmless) {
  const TempFolder folder;
  for (const SmallFile& file : small_files()) {
    std::size_t begin = 0;
    while (begin < file.text.size()) {
      const std::size_t end = file.text.find('\n', begin) + 1;
      const std::string line = file.text.substr(begin, end - begin);
      const auto path = folder.write(file.name, file.text.substr(0, begin) + file.text.substr(end));
      if (const auto error = refusal(file, path))
        expect_good_refusal(*error, file, "without " + line);
      else
        EXPECT_TRUE(!file.is_counted || read_any(file.kind, path) == file.num_elements ||
                    line.starts_with("End"))
            << file.name << " without " << line;
      begin = end;
    }
  }
}

/// A .vtu file of one hex per piece; the last one's region is an array as described.
std::string pieces_vtu(int num_pieces, const std::string& last_array) {
  const std::string& single = small_files()[8].text;
  const std::size_t begin = single.find("<Piece"), end = single.find("</Piece>") + 9;
  const std::string piece = single.substr(begin, end - begin);
  std::string text = single.substr(0, begin);
  for (int i = 0; i < num_pieces; ++i) {
    std::string own = piece;
    if (i + 1 == num_pieces)
      own.insert(own.find("</Piece>"), "<CellData>\n" + last_array + "</CellData>\n");
    text += own;
  }
  return text + single.substr(end);
}

TEST(VtuPieces, AreJoinedWithTheLabelsOfThoseThatHaveSome) {
  const TempFolder folder;
  const std::string region =
      "<DataArray type=\"Int32\" Name=\"region\" format=\"ascii\">7</DataArray>\n";
  for (int num_pieces : {1, 2, 3}) {
    const HexMesh mesh = read_hex_mesh(folder.write("a.vtu", pieces_vtu(num_pieces, region)));
    ASSERT_EQ(mesh.num_hexes(), std::size_t(num_pieces));
    EXPECT_EQ(mesh.num_verts(), std::size_t(8 * num_pieces));
    EXPECT_EQ(mesh.region[HexId(num_pieces - 1)], 7);
    for (HexId h : mesh.hexes.ids()) {
      EXPECT_EQ(mesh.hexes[h][0].value(), 8 * h.value());  // indices count within the piece
      EXPECT_TRUE(h.value() + 1 == num_pieces || mesh.region[h] == 0);
    }
  }
}

// The number of components is the file's word only: it must not decide how much memory is taken.
TEST(VtuPieces, ClaimedComponentsOfLaterPiecesTakeNoMemory) {
  const TempFolder folder;
  for (const char* components : {"0", "2", "4294967295", "18446744073709551615", "-1"}) {
    const auto path = folder.write(
        "a.vtu", pieces_vtu(3, std::string("<DataArray type=\"Int32\" Name=\"region\" "
                                           "NumberOfComponents=\"") +
                                   components + "\" format=\"ascii\">7</DataArray>\n"));
    try {
      EXPECT_EQ(read_hex_mesh(path).num_hexes(), 3u) << components;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << components;
    }
  }
}

/// A hex as binary legacy VTK.
std::string binary_vtk() {
  std::string out =
      "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 8 float\n";
  for (const Vec3& p : test::box_hex_mesh(1, 1, 1).positions)
    for (int axis = 0; axis < 3; ++axis) io::store(out, float(p[axis]), io::ByteOrder::Big);
  out += "\nCELLS 1 9\n";
  for (int i : {8, 0, 1, 3, 2, 4, 5, 7, 6}) io::store(out, i, io::ByteOrder::Big);
  out += "\nCELL_TYPES 1\n";
  io::store(out, 12, io::ByteOrder::Big);
  return out;
}

// Binary files: every byte takes every of a few values, every cut is tried.
TEST(SmallFiles, BinaryFilesSurviveEveryCutAndEveryByte) {
  const TempFolder folder;
  std::vector<SmallFile> files = {{"b.vtk", Kind::Hexes, binary_vtk(), 1}};
  for (const char* name : {"b.ply", "b.stl"}) {
    TriMesh two = test::unit_cube_surface();
    two.tris.resize(2);
    write_surface(folder / name, two);
    files.push_back({name, Kind::Surface, test::slurp(folder / name), 2});
  }
  write_hex_mesh(folder / "b.vtu", test::box_hex_mesh(1, 1, 1));
  files.push_back({"b.vtu", Kind::Hexes, test::slurp(folder / "b.vtu"), 1});
  write_grid(folder / "b.htg", make_root_grid({{0, 0, 0}, 1}));
  files.push_back({"b.htg", Kind::Cells, test::slurp(folder / "b.htg"), 1});
  for (const SmallFile& file : files) {
    ASSERT_EQ(read_any(file.kind, folder.write(file.name, file.text)), file.num_elements);
    for (std::size_t size = 0; size < file.text.size(); ++size) {
      const auto path = folder.write(file.name, file.text.substr(0, size));
      const std::string what = "cut at " + std::to_string(size);
      if (const auto error = refusal(file, path))
        expect_good_refusal(*error, file, what);
      else  // STL without its last facet is a whole file with a warning
        EXPECT_TRUE(read_any(file.kind, path) == file.num_elements ||
                    (std::string(file.name) == "b.stl" && size == 134))
            << file.name << " " << what;
    }
    for (std::size_t at = 0; at < file.text.size(); ++at)
      for (int value : {0, 1, 127, 128, 255}) {
        std::string bytes = file.text;
        bytes[at] = static_cast<char>(value);
        const auto error = refusal(file, folder.write(file.name, bytes));
        EXPECT_TRUE(!error || error->code() == ErrorCode::BadFile) << file.name << " byte " << at;
      }
  }
}

}  // namespace
}  // namespace hexwright
