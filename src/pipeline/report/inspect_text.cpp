// An inspection in words and as JSON.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/pipeline/inspect.h"
#include "hexwright/pipeline/report.h"

#include "base/words.h"

namespace hexwright {
namespace {

using Json = nlohmann::ordered_json;

std::string line(const char* label, const std::string& text) {
  return fmt::format("  {:<12} {}\n", label, text);
}

std::string places(const std::vector<InspectedPlace>& list) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, list.size()); ++i)
    text += (i > 0 ? ", " : "") + place(list[i].position);
  return text + (list.size() > 3 ? " ..." : "");
}

Json to_json(const Vec3& p) { return {p.x, p.y, p.z}; }

Json to_json(const std::vector<InspectedPlace>& list, const char* length) {
  Json json = Json::array();
  for (const InspectedPlace& p : list) {
    json.push_back({{"position", to_json(p.position)}});
    if (length) json.back()[length] = p.length;
  }
  return json;
}

std::string pieces_lines(const SurfaceInspection& s) {
  std::string text = counted(s.num_solids, "solid", "solids");
  if (s.num_cavities > 0) text += ", " + counted(s.num_cavities, "cavity", "cavities");
  if (s.num_open_tris > 0)
    text +=
        fmt::format(", {} of no closed piece", counted(s.num_open_tris, "triangle", "triangles"));
  text = line("pieces", text);
  text += line("edges", fmt::format("{} open, {} of more than two triangles", s.num_open_edges,
                                    s.num_nonmanifold_edges));
  return text + line("crossings", s.num_crossings == 0
                                      ? "none"
                                      : counted(s.num_crossings, "pair", "pairs") +
                                            " of triangles, at " + places(s.crossings));
}

std::string object_lines(const SurfaceInspection& s) {
  std::string text = line("volume", fmt::format("{:.6g} as it would be meshed", s.volume));
  if (s.num_wall_samples > 0)
    text += line("walls", fmt::format("the thinnest is {:.4g}", s.least_thickness));
  if (s.num_thin_samples > 0) text += line("", "thinner than the tolerance at " + places(s.thin));
  return text +
         line("sharp edges", fmt::format("{} long, {}, {}", fmt::format("{:.6g}", s.sharp_length),
                                         counted(s.num_sharp_curves, "curve", "curves"),
                                         counted(s.num_corners, "corner", "corners")));
}

}  // namespace

std::string inspection_to_text(const SurfaceInspection& s) {
  std::string text = line("surface", counted(s.num_tris, "triangle", "triangles") + ", " +
                                         counted(s.num_verts, "vertex", "vertices")) +
                     line("box", place(s.box.lo) + " to " + place(s.box.hi) +
                                     fmt::format(", diagonal {:.6g}", s.box.diagonal()));
  if (!s.units_guess.empty()) text += line("", s.units_guess);
  if (s.cad) text += cad_to_text(*s.cad);
  if (!s.cad && !s.names.empty()) text += line("names", counted(s.names.size(), "name", "names"));
  for (const NamedShare& n : s.cad ? std::vector<NamedShare>{} : s.names)
    text += line("", fmt::format("{}: {}", n.name.empty() ? "(none)" : n.name,
                                 counted(n.num_tris, "triangle", "triangles")));
  // What is refused at once was not looked at.
  if (s.num_solids + s.num_cavities + s.num_open_tris > 0) text += pieces_lines(s);
  if (!s.refusal.empty()) return text + line("mesh", "would refuse it: " + s.refusal);
  text += object_lines(s);
  for (const std::string& note : s.notes) text += line("mesh", "would say: " + note);
  for (const std::string& warning : s.warnings) text += line("mesh", "would warn: " + warning);
  if (s.notes.empty() && s.warnings.empty()) text += line("mesh", "would take it as it is");
  return text;
}

std::string inspection_to_json(const SurfaceInspection& s) {
  Json names = Json::array();
  for (const NamedShare& n : s.names)
    names.push_back({{"name", n.name}, {"triangles", n.num_tris}});
  Json json = {{"triangles", s.num_tris},
               {"vertices", s.num_verts},
               {"box", {to_json(s.box.lo), to_json(s.box.hi)}},
               {"diagonal", s.box.diagonal()},
               {"units_guess", s.units_guess},
               {"area", s.area},
               {"volume", s.volume},
               {"names", names},
               {"solids", s.num_solids},
               {"cavities", s.num_cavities},
               {"triangles_of_no_closed_piece", s.num_open_tris},
               {"open_edges", s.num_open_edges},
               {"nonmanifold_edges", s.num_nonmanifold_edges},
               {"crossings", s.num_crossings},
               {"crossing_places", to_json(s.crossings, nullptr)},
               {"least_thickness", s.least_thickness},
               {"thin_places", to_json(s.thin, "thickness")},
               {"sharp_length", s.sharp_length},
               {"sharp_curves", s.num_sharp_curves},
               {"corners", s.num_corners},
               {"notes", s.notes},
               {"warnings", s.warnings},
               {"refusal", s.refusal}};
  if (s.cad) json["cad"] = Json::parse(cad_to_json(*s.cad));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hexwright
