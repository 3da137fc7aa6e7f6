// Topology of random voxel sets against two independent oracles: naive counting, and the theory of
// well-composed sets.
//
// Based on: Latecki, "3D well-composed pictures", Graphical Models and Image Processing 59(3),
// 1997: the boundary of a voxel set is a 2-manifold exactly when no two voxels touch in an edge or
// a vertex alone, in the set or in its complement.
#include <map>
#include <random>
#include <set>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/quality/hex_topology.h"

#include "helpers.h"

namespace hexwright {
namespace {

constexpr int kSize = 3;

/// A random set of voxels of a cube, with the hex mesh of it.
struct Voxels {
  std::array<bool, kSize * kSize * kSize> is_set{};

  bool at(int x, int y, int z) const {
    const bool is_in = x >= 0 && y >= 0 && z >= 0 && x < kSize && y < kSize && z < kSize;
    return is_in && is_set[static_cast<std::size_t>((z * kSize + y) * kSize + x)];
  }
  HexMesh mesh() const {
    HexMesh mesh = test::box_hex_mesh(kSize, kSize, kSize);
    IdVector<HexId, std::array<VertId, 8>> kept;
    for (HexId h : mesh.hexes.ids())
      if (is_set[h.index()]) kept.push_back(mesh.hexes[h]);
    mesh.hexes = kept;
    remove_unused_verts(mesh);
    return mesh;
  }
};

Voxels random_voxels(unsigned seed) {
  std::mt19937 random(seed);
  Voxels voxels;
  const unsigned share = 1 + seed % 6;  // from sparse to nearly full
  for (bool& v : voxels.is_set) v = random() % 7 < share;
  return voxels;
}

/// Two of four voxels around an edge, diagonally.
bool is_critical_edge(bool a, bool b, bool c, bool d) { return a == d && b == c && a != b; }

/// Two voxels at opposite corners of 2 x 2 x 2, and no other like them.
bool is_critical_vertex(const std::array<bool, 8>& v) {
  for (bool value : {true, false}) {
    if (std::count(v.begin(), v.end(), value) != 2) continue;
    for (std::size_t b = 0; b < 4; ++b)
      if (v[b] == value && v[7 - b] == value) return true;
  }
  return false;
}

bool is_well_composed(const Voxels& s) {
  for (int x = -1; x < kSize; ++x)
    for (int y = -1; y < kSize; ++y)
      for (int z = -1; z < kSize; ++z) {
        std::array<bool, 8> v{};
        for (int b = 0; b < 8; ++b)
          v[static_cast<std::size_t>(b)] = s.at(x + (b & 1), y + (b >> 1 & 1), z + (b >> 2 & 1));
        if (is_critical_vertex(v)) return false;
        for (std::size_t k : {1u, 2u, 4u}) {  // the edge along bit k, at the low corner's side
          const std::size_t i = k == 1 ? 2 : 1, j = k == 4 ? 2 : 4;
          for (std::size_t base : {std::size_t{0}, k})
            if (is_critical_edge(v[base], v[base + i], v[base + j], v[base + i + j])) return false;
        }
      }
  return true;
}

std::size_t count_components(const Voxels& s) {
  std::set<std::array<int, 3>> todo;
  for (int x = 0; x < kSize; ++x)
    for (int y = 0; y < kSize; ++y)
      for (int z = 0; z < kSize; ++z)
        if (s.at(x, y, z)) todo.insert({x, y, z});
  std::size_t count = 0;
  while (!todo.empty()) {
    ++count;
    std::vector<std::array<int, 3>> queue{*todo.begin()};
    todo.erase(todo.begin());
    while (!queue.empty()) {
      const auto at = queue.back();
      queue.pop_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (int step : {-1, 1}) {
          auto next = at;
          next[axis] += step;
          if (todo.erase(next) > 0) queue.push_back(next);
        }
    }
  }
  return count;
}

struct NaiveBoundary {
  std::size_t num_quads = 0, num_nonmanifold_edges = 0;
  long euler_characteristic = 0;
};

NaiveBoundary count_boundary(const HexMesh& mesh) {
  std::map<std::set<VertId>, int> faces;
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf) {
      const auto v = face_verts(mesh, {h, lf});
      ++faces[{v.begin(), v.end()}];
    }
  std::map<std::set<VertId>, int> edges;
  std::set<VertId> verts;
  NaiveBoundary found;
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf) {
      const auto v = face_verts(mesh, {h, lf});
      if (faces[{v.begin(), v.end()}] != 1) continue;
      ++found.num_quads;
      verts.insert(v.begin(), v.end());
      for (std::size_t k = 0; k < 4; ++k) ++edges[{v[k], v[(k + 1) % 4]}];
    }
  for (const auto& [edge, count] : edges) found.num_nonmanifold_edges += count != 2;
  found.euler_characteristic = static_cast<long>(verts.size()) - static_cast<long>(edges.size()) +
                               static_cast<long>(found.num_quads);
  return found;
}

TEST(HexTopology, RandomVoxelsAreJudgedAsByTheory) {
  int num_valid = 0, num_checked = 0;
  for (unsigned seed = 1; seed <= 600; ++seed) {
    const Voxels voxels = random_voxels(seed);
    const HexMesh mesh = voxels.mesh();
    if (mesh.num_hexes() == 0) continue;
    const TopologyReport report = check_topology(mesh);
    const NaiveBoundary naive = count_boundary(mesh);
    ++num_checked;
    EXPECT_EQ(report.is_valid(), is_well_composed(voxels)) << "seed " << seed;
    EXPECT_EQ(report.num_components, count_components(voxels)) << "seed " << seed;
    EXPECT_EQ(report.num_boundary_quads, naive.num_quads) << "seed " << seed;
    EXPECT_EQ(report.num_nonmanifold_edges, naive.num_nonmanifold_edges) << "seed " << seed;
    EXPECT_EQ(report.num_nonconforming_faces, 0u);
    if (!report.is_valid()) continue;
    ++num_valid;
    EXPECT_EQ(report.boundary_euler_characteristic, naive.euler_characteristic) << "seed " << seed;
    EXPECT_GE(report.genus(), 0) << "seed " << seed;
  }
  EXPECT_GT(num_valid, 30);  // else the comparison says little
  EXPECT_GT(num_checked, 500);
}

// Any single damage to a valid mesh must be noticed.
TEST(HexTopology, RandomDamageIsAlwaysFound) {
  const HexMesh box = test::box_hex_mesh(4, 3, 3);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    HexMesh mesh = box;
    auto& hex = mesh.hexes[HexId(random() % mesh.num_hexes())];
    const std::size_t lv = random() % 8;
    switch (seed % 4) {
      case 0:  // two corners swapped
        std::swap(hex[lv], hex[(lv + 1 + random() % 7) % 8]);
        break;
      case 1:  // a corner moved to another vertex
        hex[lv] = hex[(lv + 1 + random() % 7) % 8];
        break;
      case 2:  // the hex listed twice
        mesh.hexes.push_back(hex);
        break;
      default:  // turned inside out
        for (std::size_t k = 0; k < 4; ++k) std::swap(hex[k], hex[4 + k]);
    }
    EXPECT_FALSE(check_topology(mesh).is_valid()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hexwright
