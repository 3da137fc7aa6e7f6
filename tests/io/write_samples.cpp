// Writes one file of every output format into a folder, for other programs' readers to judge.
//
// Usage: write_samples FOLDER. samples.json says what the files hold.
#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include "hexwright/base/error.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/quality/hex_quality.h"

#include "io/sample_meshes.h"

namespace {

using namespace hexwright;

nlohmann::json points_of(const HexMesh& mesh, const std::vector<VertId>& verts) {
  nlohmann::json points;
  for (VertId v : verts) {
    const Vec3& p = mesh.positions[v];
    points.push_back({p.x, p.y, p.z});
  }
  return points;
}

/// Every set with its number of elements and the places of its nodes.
nlohmann::json describe_sets(const HexMesh& mesh) {
  const SetTable table = make_set_table(mesh);
  nlohmann::json described;
  const auto add = [&](const char* kind, const std::vector<NamedSet>& sets) {
    for (const NamedSet& set : sets)
      described[kind][set.name] = {{"elements", set.members.size()},
                                   {"points", points_of(mesh, set_nodes(mesh, set))}};
  };
  add("regions", table.regions);
  add("patches", table.patches);
  add("groups", table.patch_groups);
  add("curves", table.curves);
  add("corners", table.corners);
  return described;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  try {
    std::filesystem::create_directories(folder);
    const HexMesh mesh = test::labelled_box();
    WriteHexOptions options;
    options.fields.push_back({"quality", std::vector<double>(mesh.num_hexes(), 0.25)});
    for (const std::string& extension : hex_mesh_extensions())
      write_hex_mesh(folder / ("box" + extension), mesh, options);
    options.write_sets = true;
    write_hex_mesh(folder / "sets.vtu", mesh, options);
    write_hex_mesh(folder / "sets.vtk", mesh, options);
    const HexMesh named = test::named_box();
    options.fields.clear();
    nlohmann::json written_names;
    for (const std::string& format : hex_mesh_formats()) {
      options.format = format;
      const auto path = folder / ("named." + format);
      for (const ChangedName& name : write_hex_mesh(path, named, options).changed_names)
        written_names[format][name.given] = name.written;
    }

    const HexMesh curved = test::curved_box();
    for (const std::string& format : hex_mesh_formats())
      for (int nodes_per_hex : {20, 27}) {
        options.format = format;
        options.nodes_per_hex = nodes_per_hex;
        try {
          write_hex_mesh(folder / ("curved" + std::to_string(nodes_per_hex) + "." + format), curved,
                         options);
        } catch (const Error&) {  // a format without such hexes
        }
      }

    const Grid grid = test::random_grid({{1, 2, 3}, 0.5}, test::kRingRoots, 3, 7);
    write_grid(folder / "grid.htg", grid);
    write_grid(folder / "grid.vtu", grid);

    nlohmann::json samples;
    samples["written_names"] = written_names;
    samples["named"] = describe_sets(named);
    samples["curved"]["volume"] = summarize_second_order(curved).total_volume;
    samples["hexes"] = mesh.num_hexes();
    samples["verts"] = mesh.num_verts();
    samples["quads"] = mesh.labels.quads.size();
    samples["edges"] = mesh.labels.edges.size();
    samples["corners"] = mesh.labels.corners.size();
    samples["extensions"] = hex_mesh_extensions();
    for (CellId c : grid.cells.ids()) {
      const Vec3 p = cell_box(grid, c).center();
      samples["leaves"].push_back({p.x, p.y, p.z, int(grid.cells[c].level)});
    }
    std::ofstream(folder / "samples.json") << samples;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
