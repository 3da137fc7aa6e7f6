// What sets of an Abaqus input file are to a mesh.
//
// Regions are the sets that *ELEMENT lines name, else those of *SOLID SECTION, else all sets of
// hexes. Patches are surfaces of element faces, and sets of shells; curves are sets of trusses and
// beams; sets of nodes are what LabelCollector says. Gmsh names the elements of its entities
// Volume1, Surface2, Line3 and lists physical groups as further sets: these count there.
#include <algorithm>

#include "io/content/label_collector.h"
#include "io/mesh/abaqus_deck.h"
#include "io/sets/face_table.h"

namespace hexwright::io {
namespace {

/// Local faces S1 to S6 in our numbering (see the writer).
constexpr std::array<int, 6> kFaceOfSide = {4, 5, 2, 1, 3, 0};

/// As Gmsh calls what is in no group.
bool is_entity_of_gmsh(std::string_view key) {
  for (const std::string_view stem : {"VOLUME", "SURFACE", "LINE"})
    if (key.starts_with(stem)) return is_abaqus_number(key.substr(stem.size()));
  return false;
}

class SetSettler {
 public:
  SetSettler(AbaqusDeck& deck, SetNames& names)
      : deck_(deck), file_(deck.file), names_(names), labels_(deck.file) {
    for (const AbaqusSurface& surface : deck.surfaces)
      for (const auto& [elements, side] : surface.sides) of_surfaces_.insert(elements);
  }

  void run() {
    set_regions();
    for (const AbaqusSurface& surface : deck_.surfaces)
      for (const auto& [elements, side] : surface.sides) add_sides(surface.name, elements, side);
    add_elements(deck_.element_to_shell, [&](const std::string& set, std::size_t shell) {
      labels_.add_quad(set, deck_.shells[shell]);
    });
    add_elements(deck_.element_to_line, [&](const std::string& set, std::size_t line) {
      labels_.add_edge(set, deck_.lines[line]);
    });
    for (const std::string& key : deck_.node_sets.keys())
      labels_.add_node_set(deck_.node_sets.find(key)->name, verts_of(key));
    labels_.settle(names_);
  }

 private:
  /// Sets in the order in which they name elements of a kind: of *ELEMENT lines, except where these
  /// are Gmsh's, then those of `next`, then all others but those that surfaces are made of.
  std::vector<std::string> naming_sets(const ElementIndex& kind,
                                       const std::vector<std::string>& next) const {
    std::vector<std::string> of_lines, others, of_gmsh;
    for (const std::string& key : deck_.element_sets.keys()) {
      if (!holds(key, kind)) continue;
      if (is_entity_of_gmsh(key))
        of_gmsh.push_back(key);
      else if (deck_.element_sets.find(key)->is_of_lines)
        of_lines.push_back(key);
      else if (!of_surfaces_.contains(key))
        others.push_back(key);
    }
    if (!of_lines.empty()) return of_lines;
    if (!next.empty()) return next;
    others.insert(others.end(), of_gmsh.begin(), of_gmsh.end());
    return others;
  }

  bool holds(const std::string& key, const ElementIndex& kind) const {
    const auto ids = deck_.element_sets.ids_of(key);
    return std::any_of(ids.begin(), ids.end(), [&](std::int64_t id) { return kind.contains(id); });
  }

  void set_regions() {
    std::map<std::int64_t, std::string> tags;
    std::vector<std::int64_t> hex_to_tag(file_.hexes.size(), 0);
    for (const std::string& key : naming_sets(deck_.element_to_hex, deck_.sections)) {
      const AbaqusSet* set = deck_.element_sets.find(key);
      if (!set) continue;
      const auto tag = static_cast<std::int64_t>(tags.size()) + 1;
      bool is_used = false;
      for (const std::int64_t id : deck_.element_sets.ids_of(key))
        if (const auto hex = deck_.element_to_hex.find(id); hex != deck_.element_to_hex.end())
          if (hex_to_tag[hex->second] == 0) hex_to_tag[hex->second] = tag, is_used = true;
      if (is_used) tags[tag] = set->name;
    }
    if (tags.empty()) return;
    const auto numbers = number_tags(SetKind::Region, tags, names_);
    std::int32_t without = 0;  // a number that no set has
    for (const auto& [tag, number] : numbers) without = std::max(without, number + 1);
    for (const std::int64_t tag : hex_to_tag)
      file_.region.push_back(tag == 0 ? without : numbers.at(tag));
  }

  /// Shells and lines are of the first set that names them, or else of none.
  template <class Add>
  void add_elements(const ElementIndex& kind, Add&& add) {
    if (kind.empty()) return;
    for (const std::string& key : naming_sets(kind, {})) {
      if (holds(key, deck_.element_to_hex)) continue;  // as a set of all elements
      for (const std::int64_t id : deck_.element_sets.ids_of(key))
        if (const auto element = kind.find(id); element != kind.end())
          add(deck_.element_sets.find(key)->name, element->second);
    }
  }

  std::vector<std::int64_t> elements_of(const std::string& element_or_set) const {
    if (is_abaqus_number(element_or_set) && element_or_set.size() < 18)
      return {std::stoll(element_or_set)};
    return deck_.element_sets.ids_of(element_or_set);
  }

  /// "S3" of solids; "SPOS", "SNEG" or nothing of shells.
  void add_sides(const std::string& surface, const std::string& elements, const std::string& side) {
    const bool is_solid = side.size() == 2 && side[0] == 'S' && side[1] >= '1' && side[1] <= '6';
    const bool is_shell = side.empty() || side == "SPOS" || side == "SNEG";
    for (const std::int64_t id : elements_of(elements)) {
      const auto hex = deck_.element_to_hex.find(id);
      const auto shell = deck_.element_to_shell.find(id);
      if (is_solid && hex != deck_.element_to_hex.end()) {
        const int lf = kFaceOfSide[static_cast<std::size_t>(side[1] - '1')];
        labels_.add_quad(surface, face_verts(file_.hexes, {HexId(hex->second), lf}));
      } else if (is_shell && shell != deck_.element_to_shell.end()) {
        labels_.add_quad(surface, deck_.shells[shell->second]);
      }
    }
  }

  std::vector<VertId> verts_of(const std::string& node_set) const {
    std::vector<VertId> verts;
    for (const std::int64_t id : deck_.node_sets.ids_of(node_set))
      if (const auto vert = deck_.node_to_vert.find(id); vert != deck_.node_to_vert.end())
        verts.push_back(vert->second);
    return verts;
  }

  AbaqusDeck& deck_;
  VolumeFile& file_;
  SetNames& names_;
  LabelCollector labels_;
  std::set<std::string> of_surfaces_;
};

}  // namespace

std::string abaqus_key(std::string_view text) {
  std::string result;
  for (char c : text)
    if (c != ' ' && c != '\t' && c != '\r')
      result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}

bool is_abaqus_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

AbaqusSet& AbaqusSets::at(const std::string& name) {
  const auto [set, is_new] = sets_.try_emplace(abaqus_key(name));
  if (is_new) {
    set->second.name = name;
    keys_.push_back(set->first);
  }
  return set->second;
}

const AbaqusSet* AbaqusSets::find(const std::string& key) const {
  auto set = sets_.find(key);
  if (set == sets_.end())
    if (const auto dot = key.find('.'); dot != std::string::npos)
      set = sets_.find(key.substr(dot + 1));
  return set == sets_.end() ? nullptr : &set->second;
}

std::vector<std::int64_t> AbaqusSets::ids_of(const std::string& key) const {
  std::vector<std::int64_t> ids;
  std::vector<std::string> keys = {key};
  std::set<std::string> seen = {key};
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const AbaqusSet* set = find(keys[k]);
    if (!set) continue;
    ids.insert(ids.end(), set->ids.begin(), set->ids.end());
    for (const std::string& other : set->others)
      if (seen.insert(other).second) keys.push_back(other);
  }
  return ids;
}

void settle_abaqus_sets(AbaqusDeck& deck, SetNames& names) { SetSettler(deck, names).run(); }

}  // namespace hexwright::io
