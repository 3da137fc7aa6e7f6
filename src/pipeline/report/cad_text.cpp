// A CAD model in words and as JSON.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/pipeline/report.h"

#include "base/words.h"

namespace hexwright {

using Json = nlohmann::ordered_json;

std::string cad_to_json(const CadSummary& cad) {
  Json faces = Json::array();
  for (const CadFaceSummary& face : cad.faces)
    faces.push_back(
        {{"name", face.name}, {"patch", face.patch}, {"shape", face.shape}, {"area", face.area}});
  const Json json = {{"format", cad.format},
                     {"file_unit", cad.unit},
                     {"unit", "mm"},
                     {"solids", cad.solids},
                     {"named_faces", cad.num_named_faces},
                     {"sharp_edges", cad.num_sharp},
                     {"tangent_edges", cad.num_tangent},
                     {"seam_edges", cad.num_seam},
                     {"open_edges", cad.num_open},
                     {"sharp_length", cad.sharp_length},
                     {"notes", cad.notes},
                     {"faces", faces}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string cad_to_text(const CadSummary& cad) {
  const auto line = [](const std::string& label, const std::string& text) {
    return fmt::format("  {:<12} {}\n", label, text);
  };
  std::string text = line("CAD", fmt::format("{}, {}, {}, lengths in mm", cad.format,
                                             counted(cad.solids.size(), "solid", "solids"),
                                             counted(cad.faces.size(), "face", "faces")));
  text += line("edges", fmt::format("{} sharp, {} tangent, {} seams, {} open", cad.num_sharp,
                                    cad.num_tangent, cad.num_seam, cad.num_open));
  for (const std::string& note : cad.notes) text += line("", note);
  for (const CadFaceSummary& face : cad.faces) {
    const bool is_joined = !face.patch.empty() && face.patch != face.name;
    text += line("", fmt::format("{}: {}, area {:.5g}{}", face.name, face.shape, face.area,
                                 is_joined ? ", in " + face.patch : ""));
  }
  return text;
}

}  // namespace hexwright
