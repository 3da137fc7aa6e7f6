// Sets of other programs' files on their way to the patches, curves and corners of a mesh.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/content/set_names.h"
#include "io/content/volume_file.h"

namespace hexwright::io {

/// Files name sets of faces, of edges and of nodes, which may overlap. Here an element is of the
/// first set that names it, and sets of nodes mean what their nodes form.
class LabelCollector {
 public:
  /// The file must outlive the collector. Its labels are those that are added here.
  explicit LabelCollector(VolumeFile& file) : file_(file) {}

  /// Sets of one kind and name are one.
  void add_quad(const std::string& set, const std::array<VertId, 4>& verts);
  void add_edge(const std::string& set, const std::array<VertId, 2>& verts);
  void add_corner(VertId v) { corners_.insert(v); }

  /// Of vertices of hexes; others are left out. The set means
  /// - corners, where it is called CORNERS, in any case, or no two of its nodes are ends of one
  ///   edge;
  /// - nothing new, where it is called as a set of quads or edges is, in any case, with "_NODES"
  ///   behind or without, or has all vertices of a hex;
  /// - a patch of the faces between its nodes that no set has, where these are on the boundary and
  ///   have all its nodes;
  /// - a curve of the edges between its nodes, where these have all nodes and faces at most half of
  ///   them;
  /// and is counted among the file's other elements else.
  void add_node_set(const std::string& name, std::vector<VertId> verts);

  /// Fills the file's labels. Call once, when all hexes, quads and edges are there.
  void settle(SetNames& names);

 private:
  template <class Verts>
  struct Elements {
    std::map<std::string, std::int64_t> set_to_tag;
    std::vector<std::pair<Verts, std::int64_t>> list;
    std::set<Verts> seen;  // by increasing vertices
    void add(const std::string& set, const Verts& verts);
    /// The number of each element's set.
    std::vector<std::int32_t> numbers(SetKind kind, SetNames& names) const;
  };

  void read_node_sets();
  std::set<std::string> names_of_elements() const;

  VolumeFile& file_;
  Elements<std::array<VertId, 4>> quads_;
  Elements<std::array<VertId, 2>> edges_;
  std::set<VertId> corners_;
  std::vector<std::pair<std::string, std::vector<VertId>>> node_sets_;
};

}  // namespace hexwright::io
