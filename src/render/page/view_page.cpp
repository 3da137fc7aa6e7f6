// The page is viewer/dist/viewer.html, which the build of viewer/ makes, with three marks: title,
// summary and arrays.
#include "hexwright/render/view_page.h"

#include <array>
#include <string_view>
#include <utility>

#include "hexwright/base/error.h"

#include "render/page/view_arrays.h"
#include "render/page/view_summary.h"
#include "render/page/viewer_asset.h"

namespace hexwright {
namespace {

void check_arguments(const HexMesh& mesh, const ViewOptions& options) {
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw Error(ErrorCode::BadArgument, message);
  };
  require(mesh.num_hexes() > 0, "the mesh has no hexes: there is nothing to view");
  if (const auto issue = mesh.find_problem()) require(false, issue->message);
  for (const HexField& field : options.fields)
    require(field.values.size() == mesh.num_hexes(),
            "the field '" + field.name + "' of a page needs one value per hex");
}

std::string for_html(std::string_view text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      default:
        safe += c;
    }
  return safe;
}

// Data blocks: browsers do not run scripts of this type, whatever the page's policy.
std::string to_blocks(const ViewArrays& arrays) {
  std::string blocks;
  for (const auto& [name, text] : arrays)
    blocks += "<script type=\"text/plain\" id=\"array-" + name + "\">" + text + "</script>\n";
  return blocks;
}

// Puts each text in place of its mark, in one pass, so that marks inside the texts are not looked
// at.
std::string fill(std::string_view page,
                 const std::array<std::pair<std::string_view, std::string>, 3>& parts) {
  std::string filled;
  for (const auto& [mark, text] : parts) {
    const std::size_t at = page.find(mark);
    filled.append(page.substr(0, at)).append(text);
    page.remove_prefix(at + mark.size());
  }
  return filled.append(page);
}

}  // namespace

std::string make_view_page(const HexMesh& mesh, const ViewOptions& options) {
  check_arguments(mesh, options);
  const ViewScene scene = make_view_scene(mesh, options);
  const auto regions = region_tags(mesh);
  return fill(kViewerPage,
              {{{"<!--TITLE-->", for_html(options.title)},
                {"<!--SUMMARY-->", view_summary(mesh, scene, options, regions)},
                {"<!--ARRAYS-->", to_blocks(make_view_arrays(mesh, scene, options, regions))}}});
}

}  // namespace hexwright
