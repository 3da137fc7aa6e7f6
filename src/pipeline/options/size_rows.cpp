// One table: what a file may hold, and how its values are read, is what the options take.
#include "pipeline/options/size_rows.h"

#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "hexwright/base/error.h"
#include "hexwright/base/length_unit.h"

#include "io/text/file_bytes.h"
#include "pipeline/options/option_rows.h"

namespace hexwright {
namespace {

using Json = nlohmann::json;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

NamedOption unit_row(double& metres) {
  std::vector<std::string> names;
  for (const LengthUnit& unit : kLengthUnits) names.emplace_back(unit.name);
  NamedOption row = choice_row(
      {"unit", "The surface's unit, for lengths with a unit such as 2mm; of CAD files it is mm"},
      names, "none");
  row.set = [&metres, names](const std::string& text) {
    metres = kLengthUnits[find_choice(text, names)].metres;
  };
  return row;
}

/// A value of a file as the command line would have it.
std::string to_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  throw Error(ErrorCode::BadArgument, "neither a number nor a text");
}

/// Rules one per line, numbers side by side.
std::string to_text(const NamedOption& row, const Json& value) {
  if (row.kind == OptionKind::List && !value.is_array())
    throw Error(ErrorCode::BadArgument, "no list; write [\"box:0,0,0,1,1,1=0.1\", ...]");
  if (!value.is_array()) return to_text(value);
  std::vector<std::string> parts;
  for (const Json& part : value) parts.push_back(to_text(part));
  return fmt::format("{}", fmt::join(parts, row.kind == OptionKind::List ? "\n" : ","));
}

void set_wish(const OptionTable& table, const std::string& key, const Json& value) {
  std::vector<std::string> known;
  for (const NamedOption& row : table) {
    if (row.name == key) {
      const bool is_empty = value.is_array() && value.empty();
      if (!is_empty || row.kind != OptionKind::List) row.set(to_text(row, value));
      return;
    }
    known.push_back(row.name);
  }
  throw Error(ErrorCode::BadArgument,
              fmt::format("unknown; use one of {}", fmt::join(known, ", ")));
}

}  // namespace

OptionTable size_rows(SizeWishes& sizes) {
  return {
      unit_row(sizes.unit),
      length_row({"size",
                  "Edge of the cells, everywhere: no longer, and at most one level finer. "
                  "Around an object that of the cells at its surface"},
                 sizes.size),
      length_row({"max-size", "No cell is larger; finer ones where the surface asks for them"},
                 sizes.max_size),
      length_row({"min-size", "No cell is finer"}, sizes.min_size),
      list_row({"refine",
                "Cells near a place are no larger than SIZE, and within DISTANCE of it; "
                "repeated"},
               "WHERE=SIZE[,DISTANCE] with WHERE box:X0,Y0,Z0,X1,Y1,Z1, ball:X,Y,Z,R, "
               "cylinder:X0,Y0,Z0,X1,Y1,Z1,R, patch:NAME, curve:NAME, region:NAME, near:FILE or "
               "inside:FILE; or field:FILE[=ARRAY] (.vti, .vtu)",
               [&sizes](const std::string& text) { sizes.rules.push_back(parse_size_rule(text)); }),
      number_row({"growth",
                  "Largest growth of cells over distance: 1.2 is gentle; 0 = as balance "
                  "leaves it"},
                 sizes.growth, 0, kNoLimit),
      whole_row({"across",
                 "At least so many cells across the thickness of the solid, or of gaps "
                 "outside; 0 = as the tolerance asks"},
                sizes.across, 0, kMostAcross),
      whole_row({"cells", "Find the size that gives about so many hexes; 0 = not"}, sizes.cells, 0,
                kMostCells),
      text_row({"box", "The domain, which the object lies in or reaches through: it is cut there"},
               "X0,Y0,Z0,X1,Y1,Z1",
               [&sizes](const std::string& text) { sizes.box = parse_box(text); }),
      text_row({"margin",
                "Room around the object instead, on all sides, per axis or per side: "
                "lengths, or 5L for five times its longest side"},
               "M, MX,MY,MZ or six",
               [&sizes](const std::string& text) { sizes.margin = parse_margin(text); }),
  };
}

NamedOption size_file_row(SizeWishes& sizes) {
  return file_row({"sizes", "A file of sizes: the options from 'unit' to 'margin', by name"},
                  "FILE.json",
                  [&sizes](const std::string& path) { read_size_wishes(path, sizes); });
}

void read_size_wishes(const std::string& path, SizeWishes& wishes) {
  const io::FileBytes file = io::read_file(path);
  Json json;
  try {
    json = Json::parse(file.bytes);
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::BadFile, fmt::format("is no JSON: {}", error.what()), path);
  }
  if (!json.is_object())
    throw Error(ErrorCode::BadFile, "holds no object; write {\"size\": 2, ...}", path);
  const OptionTable table = size_rows(wishes);
  for (const auto& [key, value] : json.items()) try {
      set_wish(table, key, value);
    } catch (const Error& error) {
      throw Error(ErrorCode::BadFile, fmt::format("\"{}\": {}", key, error.what()), path);
    }
}

}  // namespace hexwright
