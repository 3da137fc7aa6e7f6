// Meshes of other programs whose quality is published.
#include "hexwright/io/mesh_io.h"
#include "hexwright/quality/judge.h"

#include "helpers.h"

namespace hexwright {
namespace {

struct Published {
  const char* file;
  std::size_t num_hexes, num_boundary_quads;
  double min_scaled_jacobian, avg_scaled_jacobian;
  long genus;
};

// HybridOctree_Hex (Tong et al. 2024), results/*.vtk; minima as published, averages and boundary
// quads recomputed by an independent script.
constexpr Published kMeshes[] = {
    {"hybridoctree_bone.vtk", 8619, 3200, 0.61, 0.7931, 0},
    {"hybridoctree_dtorus.vtk", 15872, 6790, 0.58, 0.8215, 2},
    {"hybridoctree_retinal.vtk", 15950, 5800, 0.58, 0.7461, 0},
};

TEST(PublishedMeshes, HaveTheirPublishedQuality) {
  HEXWRIGHT_SKIP_WITHOUT_SHARED();
  for (const Published& published : kMeshes) {
    SCOPED_TRACE(published.file);
    const HexMesh mesh = read_hex_mesh(test::shared_dir() / "data" / "hex" / published.file);
    const Verdict verdict = judge(mesh, {}, {});
    EXPECT_TRUE(verdict.is_valid());
    EXPECT_EQ(verdict.topology.num_hexes, published.num_hexes);
    EXPECT_EQ(verdict.topology.num_boundary_quads, published.num_boundary_quads);
    EXPECT_EQ(verdict.topology.genus(), published.genus);
    EXPECT_NEAR(verdict.quality.min_scaled_jacobian, published.min_scaled_jacobian, 5e-5);
    EXPECT_NEAR(verdict.quality.avg_scaled_jacobian, published.avg_scaled_jacobian, 5e-5);
    EXPECT_EQ(verdict.quality.num_not_positive + verdict.quality.num_undecided, 0u);
  }
}

}  // namespace
}  // namespace hexwright
