// The .cells format: one leaf per line, `level i j k`; the header stands in comments.
//
// Indices count cells of their own level from the low corner of root (0, 0, 0). Plain text, so that
// grids can be compared and made by hand.
#include <algorithm>

#include "io/grid/grid_file.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

class CellsReader {
 public:
  explicit CellsReader(const VolumeSource& source)
      : source_(source), scanner_(source.bytes, source.name) {}

  GridFile run() {
    while (!scanner_.is_at_end()) {
      if (scanner_.peek_char_in_line() == '#') {
        const std::size_t line = scanner_.line();
        read_comment(scanner_.rest_of_line(), line);
        continue;
      }
      if (const auto token = scanner_.line_token(); !token.empty()) read_cell(token);
      scanner_.next_line();
    }
    if (file_.cells.empty())
      throw bad_file(source_.name, "the file holds no cell; give one leaf per line: level i j k");
    add_origin_root();
    return std::move(file_);
  }

 private:
  std::int32_t to_int32(std::string_view token, const char* what) {
    if (token.empty()) scanner_.fail("a cell needs four integers: level i j k");
    const std::int64_t value = scanner_.to_integer(token, what);
    if (value < -0x7fffffff || value > 0x7fffffff)
      scanner_.fail(std::string(what) + " is out of range; correct the line");
    return static_cast<std::int32_t>(value);
  }

  void read_cell(std::string_view level) {
    CellSpec cell;
    cell.level = to_int32(level, "a cell's level");
    if (cell.level < 0 || cell.level > kMaxGridLevel)
      scanner_.fail("the level " + std::to_string(cell.level) + " is not within 0.." +
                    std::to_string(kMaxGridLevel) + "; correct the line");
    for (std::int32_t& i : cell.index) i = to_int32(scanner_.line_token(), "a cell's index");
    if (!scanner_.line_token().empty())
      scanner_.fail("more than four integers; a cell is one line: level i j k");
    file_.cells.push_back(cell);
  }

  /// "# roots i j k ..." and "# origin x y z size h", perhaps with "stretch a b c"; any other
  /// comment is passed over.
  void read_comment(std::string_view text, std::size_t line) {
    text.remove_prefix(text.find('#') + 1);
    TextScanner words(text, source_.name);
    words.set_line(line);
    const auto keyword = words.line_token();
    if (keyword == "roots") {
      while (words.skip_blank()) {
        LatticeCoord root;
        for (std::int32_t& i : root) {
          const std::int64_t value = words.integer("a root cube");
          if (value < -(1 << 10) || value >= 1 << 10)
            words.fail("the root cube's index " + std::to_string(value) +
                       " is not within -1024..1023; correct the line");
          i = static_cast<std::int32_t>(value);
        }
        file_.roots.push_back(root);
      }
    } else if (keyword == "origin") {
      file_.frame.origin = words.line_point("the origin");
      if (words.line_token() != "size")
        words.fail("expected: # origin x y z size h; correct the line");
      file_.frame.root_size = words.real("the size of a root cube");
      if (!(file_.frame.root_size > 0))
        words.fail("the size of a root cube must be positive; correct the line");
      if (words.line_token() == "stretch") file_.frame.stretch = words.line_point("the stretch");
    }
  }

  // The header may list all root cubes or only those beside the first: (0,0,0) belongs to the
  // domain when a cell lies in it, or when nothing is listed.
  void add_origin_root() {
    auto& roots = file_.roots;
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    const LatticeCoord origin = {0, 0, 0};
    const bool is_used =
        std::any_of(file_.cells.begin(), file_.cells.end(), [](const CellSpec& cell) {
          return ((cell.index[0] >> cell.level) | (cell.index[1] >> cell.level) |
                  (cell.index[2] >> cell.level)) == 0;
        });
    if (roots.empty() || (is_used && !std::binary_search(roots.begin(), roots.end(), origin)))
      roots.push_back(origin);
  }

  const VolumeSource& source_;
  TextScanner scanner_;
  GridFile file_;
};

}  // namespace

GridFile read_cells_file(const VolumeSource& source) { return CellsReader(source).run(); }

std::string cells_text(const Grid& grid) {
  constexpr std::size_t kRootsPerLine = 16;
  TextWriter out;
  out.text("# origin ").point(grid.frame.origin);
  out.text(" size ").real(grid.frame.root_size);
  if (!(grid.frame.stretch == Vec3{1, 1, 1})) out.text(" stretch ").point(grid.frame.stretch);
  out.text("\n");
  const bool is_single = grid.roots.size() == 1 && grid.roots[0] == LatticeCoord{0, 0, 0};
  for (std::size_t r = 0; !is_single && r < grid.roots.size(); ++r) {
    out.text(r % kRootsPerLine == 0 ? "# roots" : "");
    for (std::int32_t i : grid.roots[r]) out.text(" ").integer(i);
    const bool is_line_end = r % kRootsPerLine + 1 == kRootsPerLine || r + 1 == grid.roots.size();
    out.text(is_line_end ? "\n" : "");
  }
  for (const GridCell& cell : grid.cells) {
    out.integer(int{cell.level});
    for (std::int32_t x : cell.corner) out.text(" ").integer(x >> (grid.finest_level - cell.level));
    out.text("\n");
  }
  return out.take();
}

}  // namespace hexwright::io
