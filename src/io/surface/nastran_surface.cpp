// Reads the shells of Nastran files: GRID, CTRIA3 and CQUAD4 and their kin, in fields of 8 or 16
// characters or free ones. A group is a property, by the name that a comment gives it, else
// "property_3".
//
// Based on: Siemens, "NX Nastran Quick Reference Guide", section "Bulk data": formats of entries;
// names as HyperMesh, ANSA, Femap and Patran write them. Differs: grid points in systems of
// coordinates of their own are refused; *INCLUDE files are not followed.
#include <charconv>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "io/surface/polygon_soup.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// An entry with all its lines: its name without '*', and its fields behind it.
struct Entry {
  std::string_view name;
  std::vector<std::string_view> fields;
  std::size_t line = 0;
  std::string_view field(std::size_t k) const {
    return k < fields.size() ? fields[k] : std::string_view();
  }
};

/// Corners of a kind of shell; 0: no shell.
std::size_t num_corners(std::string_view name) {
  for (std::string_view known : {"CTRIA3", "CTRIAR", "CTRIA6"})
    if (name == known) return 3;
  for (std::string_view known : {"CQUAD4", "CQUADR", "CQUAD8", "CQUAD", "CSHEAR"})
    if (name == known) return 4;
  return 0;
}

bool is_solid(std::string_view name) {
  for (std::string_view known : {"CHEXA", "CTETRA", "CPENTA", "CPYRAM", "CPYRA"})
    if (name == known) return true;
  return false;
}

/// The words of a comment that a program names a property by, as "stem NUMBER mark NAME".
struct NameStyle {
  std::string_view before, between;
  bool is_weak = false;  ///< of components, which may differ from properties
};
constexpr NameStyle kNameStyles[] = {{"$HMNAME PROP", "\""},
                                     {"$HMNAME COMP", "\"", true},
                                     {"$ANSA_NAME_COMMENT;", ";PSHELL;"},
                                     {"Property ", ":"}};

class NastranReader {
 public:
  explicit NastranReader(const SurfaceSource& source)
      : source_(source), scanner_(source.bytes, source.name) {}

  PolygonSoup run() {
    while (!scanner_.is_at_end() && !is_over_) {
      line_ = scanner_.line();
      read_line(scanner_.rest_of_line());
    }
    end_entry();
    add_shells();
    if (num_solids_ > 0)
      source_.warnings.push_back(
          fmt::format("{} solid elements are no shells and are left out", num_solids_));
    return std::move(soup_);
  }

 private:
  struct Shell {
    std::array<std::int64_t, 4> nodes;
    std::size_t size;
    std::int64_t property;
    std::size_t line;
  };

  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    TextScanner::fail_at(source_.name, line, message);
  }

  void read_line(std::string_view line) {
    if (line.starts_with('$')) return read_comment(line);
    line = line.substr(0, line.find('$'));
    if (trimmed(line).empty()) return;
    const char first = line.front();
    const bool is_continued = first == '+' || first == '*' || first == ' ' || first == ',';
    if (!is_continued) end_entry();
    std::vector<std::string_view> fields = split(line);
    if (is_continued) {
      if (entry_.name.empty()) return;
    } else {
      entry_.name = fields[0].substr(0, fields[0].find('*'));
      entry_.line = line_;
      is_over_ = entry_.name == "ENDDATA";
    }
    entry_.fields.insert(entry_.fields.end(), fields.begin() + 1, fields.end());
  }

  /// The name or mark of a line and its fields, as many as its format has.
  std::vector<std::string_view> split(std::string_view line) const {
    const std::string_view first = line.substr(0, std::min(line.find(','), std::size_t{8}));
    const bool is_wide = first.find('*') != std::string_view::npos;
    const std::size_t most = is_wide ? 5 : 9;
    std::vector<std::string_view> fields;
    if (line.find(',') != std::string_view::npos) {
      for (std::size_t at = 0; at <= line.size() && fields.size() < most;) {
        const std::size_t end = std::min(line.find(',', at), line.size());
        fields.push_back(trimmed(line.substr(at, end - at)));
        at = end + 1;
      }
    } else {
      fields.push_back(trimmed(line.substr(0, 8)));
      const std::size_t width = is_wide ? 16 : 8;
      for (std::size_t at = 8; fields.size() < most; at += width)
        fields.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view());
    }
    fields.resize(most);
    return fields;
  }

  void end_entry() {
    const Entry entry = std::move(entry_);
    entry_ = {};
    if (entry.name == "GRID") return read_node(entry);
    if (entry.name == "PSHELL" || entry.name == "PCOMP") {
      if (!region_.empty()) names_[integer(entry, 0, "a property")] = region_;
      region_.clear();
    }
    num_solids_ += is_solid(entry.name);
    if (const std::size_t size = num_corners(entry.name)) read_shell(entry, size);
  }

  void read_node(const Entry& entry) {
    if (const auto system = entry.field(1); !system.empty() && system != "0")
      fail(entry.line,
           "the grid point lies in a system of coordinates of its own; export global positions");
    const Vec3 p = {real(entry, 2), real(entry, 3), real(entry, 4)};
    const std::int64_t id = integer(entry, 0, "a grid point");
    if (!node_to_vert_.try_emplace(id, VertId(soup_.positions.size())).second)
      fail(entry.line, fmt::format("grid point {} comes twice; export the file again", id));
    soup_.positions.push_back(p);
  }

  void read_shell(const Entry& entry, std::size_t size) {
    Shell shell{{}, size, 0, entry.line};
    shell.property = integer(entry, entry.field(1).empty() ? 0 : 1, "a property");
    for (std::size_t k = 0; k < size; ++k) shell.nodes[k] = integer(entry, 2 + k, "a grid point");
    shells_.push_back(shell);
  }

  std::int64_t integer(const Entry& entry, std::size_t field, const char* what) const {
    const std::string_view text = entry.field(field);
    std::int64_t value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || value < 1)
      fail(entry.line, fmt::format("expected the number of {}, found {}; correct this line or "
                                   "export the file again",
                                   what, in_quotes(text)));
    return value;
  }

  /// "1.5-3" and "1.5D-3" are 1.5e-3; an empty field is zero.
  double real(const Entry& entry, std::size_t field) {
    std::string text;
    for (char c : entry.field(field)) {
      if (c == 'd' || c == 'D' || c == 'e' || c == 'E') c = 'e';
      const bool is_sign = c == '+' || c == '-';
      if (is_sign && !text.empty() && text.back() != 'e') text += 'e';
      text += c;
    }
    if (text.empty()) return 0;
    scanner_.set_line(entry.line);
    const double value = scanner_.to_real(text, "a coordinate");
    scanner_.set_line(line_ + 1);
    return value;
  }

  void read_comment(std::string_view line) {
    constexpr std::string_view kRegion = "Element Properties for region :";
    if (const auto at = line.find(kRegion); at != std::string_view::npos)
      region_ = clean_name(line.substr(at + kRegion.size()));
    for (const NameStyle& style : kNameStyles) {
      const auto before = line.find(style.before);
      if (before == std::string_view::npos) continue;
      const auto number_at = before + style.before.size();
      const auto between = line.find(style.between, number_at);
      if (between == std::string_view::npos) continue;
      const std::string_view number = trimmed(line.substr(number_at, between - number_at));
      std::string_view name = line.substr(between + style.between.size());
      name = name.substr(0, name.find_first_of("\";"));
      std::int64_t id = 0;
      const auto parsed = std::from_chars(number.data(), number.data() + number.size(), id);
      if (parsed.ec != std::errc() || parsed.ptr != number.data() + number.size()) continue;
      (style.is_weak ? weak_names_ : names_)[id] = clean_name(name);
      return;
    }
  }

  std::string name_of(std::int64_t property) const {
    for (const auto* names : {&names_, &weak_names_})
      if (const auto found = names->find(property); found != names->end()) return found->second;
    return {};
  }

  /// At the end, for shells may come before their grid points. One property without a name tells
  /// nothing.
  void add_shells() {
    bool is_one = true;
    for (const Shell& shell : shells_) is_one = is_one && shell.property == shells_[0].property;
    for (const Shell& shell : shells_) {
      std::string name = name_of(shell.property);
      if (name.empty() && !is_one) name = fmt::format("property_{}", shell.property);
      if (!name.empty()) soup_.begin_group(name);
      for (std::size_t k = 0; k < shell.size; ++k) {
        const auto found = node_to_vert_.find(shell.nodes[k]);
        if (found == node_to_vert_.end())
          fail(shell.line,
               fmt::format("the shell uses grid point {}, which the file does not have; "
                           "export it again",
                           shell.nodes[k]));
        soup_.verts.push_back(found->second);
      }
      soup_.end_polygon();
    }
  }

  const SurfaceSource& source_;
  TextScanner scanner_;
  PolygonSoup soup_;
  Entry entry_;
  std::size_t line_ = 0, num_solids_ = 0;
  bool is_over_ = false;
  std::string region_;  // of Patran, for the next property
  std::map<std::int64_t, std::string> names_, weak_names_;
  std::unordered_map<std::int64_t, VertId> node_to_vert_;
  std::vector<Shell> shells_;
};

}  // namespace

PolygonSoup read_nastran_surface(const SurfaceSource& source) {
  return NastranReader(source).run();
}

}  // namespace hexwright::io
