// The polycube pipeline as a list of passes: check the pair, find the lattice, sample the map,
// complete, dualise, map back, optimise on the object's surface.
#include "hexwright/polycube/polycube.h"

#include "hexwright/quality/hex_quality.h"

#include "polycube/lattice.h"
#include "polycube/map_back.h"
#include "polycube/relax.h"
#include "polycube/sample_map.h"
#include "polycube/tet_locator.h"

namespace hexwright {
namespace {

void check_pair(const TetMesh& object, const TetMesh& polycube) {
  if (object.num_verts() != polycube.num_verts() || object.num_tets() != polycube.num_tets())
    throw Error(ErrorCode::BadGeometry,
                "the two meshes differ: object " + std::to_string(object.num_verts()) +
                    " vertices, " + std::to_string(object.num_tets()) + " tets; polycube " +
                    std::to_string(polycube.num_verts()) + " vertices, " +
                    std::to_string(polycube.num_tets()) +
                    " tets; both must come from one tet mesh, with other positions only");
  if (object.num_tets() == 0)
    throw Error(ErrorCode::BadGeometry,
                "the meshes hold no tetrahedra; write them with volume cells");
  for (TetId t : object.tets.ids())
    if (object.tets[t] != polycube.tets[t])
      throw Error(ErrorCode::BadGeometry,
                  "tetrahedron " + std::to_string(t.value() + 1) +
                      " has other vertices in the polycube than in the object; both meshes must "
                      "list the same tets in the same order");
}

std::size_t count_nonpositive(const TetMesh& mesh) {
  std::size_t count = 0;
  for (TetId t : mesh.tets.ids()) count += polycube::tet_det(polycube::tet_corners(mesh, t)) <= 0;
  return count;
}

// Tets may be listed with negative volumes throughout; both meshes are then turned.
void orient(TetMesh& object, TetMesh& polycube) {
  if (2 * count_nonpositive(polycube) <= polycube.num_tets()) return;
  for (TetId t : polycube.tets.ids()) {
    std::swap(polycube.tets[t][2], polycube.tets[t][3]);
    std::swap(object.tets[t][2], object.tets[t][3]);
  }
}

void report_lattice(const polycube::Lattice& lattice, PolycubeReport& report) {
  report.num_charts = lattice.charts.size();
  report.num_unaligned_facets = lattice.num_unaligned;
  report.max_plane_deviation = lattice.max_deviation;
  report.spacing = lattice.spacing;
  report.num_roots = lattice.roots.size();
  if (lattice.num_unaligned > 0)
    report.warnings.push_back(
        std::to_string(lattice.num_unaligned) +
        " small facets of the polycube face no axis and follow their neighbours");
}

}  // namespace

PolycubeResult mesh_polycube(const TetMesh& object_in, const TetMesh& polycube_in,
                             const PolycubeOptions& options, const Context& context) {
  check_pair(object_in, polycube_in);
  TetMesh object = object_in, polycube = polycube_in;
  orient(object, polycube);

  PolycubeResult result;
  PolycubeReport& report = result.report;
  const polycube::Lattice lattice = polycube::fit_lattice(polycube, options.spacing);
  report.num_tets = object.num_tets();
  report.num_nonpositive_object = count_nonpositive(object);
  report.num_nonpositive_polycube = count_nonpositive(lattice.tets);
  report_lattice(lattice, report);

  const polycube::TetLocator locator(lattice.tets);
  const Grid sampled = polycube::sample_map(object, lattice, locator, options, context);
  report.num_sampled_cells = sampled.num_cells();

  result.grid = complete(sampled, options.complete, context).grid;
  report.num_cells = result.grid.num_cells();

  DualOptions dual_options;
  dual_options.mode =
      options.complete.pairing == Pairing::Blocks || options.complete.pairing == Pairing::Octree
          ? DualMode::Blocks
          : DualMode::Sheets;
  const DualResult dual = build_dual(result.grid, dual_options, context);

  auto mapped = polycube::map_back(dual.mesh, object, lattice, locator);
  report.num_bridged = mapped.num_bridged;
  report.num_inverted_mapped = summarize_quality(mapped.mesh).num_inverted;

  const auto features = polycube::object_features(object, lattice);
  polycube::relax(mapped, features, lattice, context);
  result.mesh = std::move(mapped.mesh);
  result.surface = features.surface;
  return result;
}

}  // namespace hexwright
