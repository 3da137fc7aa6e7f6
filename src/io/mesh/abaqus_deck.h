// What an Abaqus input file says, before sets are settled: shared by the reader and what makes sets
// of it.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/content/set_names.h"
#include "io/content/volume_file.h"

namespace hexwright::io {

/// A set as it is spelled, with what it holds, in the order of the file: numbers, and the names of
/// other sets in capitals.
struct AbaqusSet {
  std::string name;
  std::vector<std::int64_t> ids;
  std::vector<std::string> others;
  bool is_of_lines = false;  ///< an *ELEMENT line names it
};

/// By name in capitals, and in the order in which the file first names them.
class AbaqusSets {
 public:
  /// The set of this name, made when there is none.
  AbaqusSet& at(const std::string& name);
  /// By the name in capitals, with the name of an instance before it or without; null when there is
  /// none.
  const AbaqusSet* find(const std::string& key) const;
  /// All that a set holds, itself and through the sets that it names, each of these once: sets that
  /// name each other do not multiply.
  std::vector<std::int64_t> ids_of(const std::string& key) const;
  const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::map<std::string, AbaqusSet> sets_;
  std::vector<std::string> keys_;
};

struct AbaqusSurface {
  std::string name;
  std::vector<std::pair<std::string, std::string>> sides;  ///< element or set, and "S3", "SPOS", ""
};

/// Elements of one kind by their numbers in the file.
using ElementIndex = std::unordered_map<std::int64_t, std::size_t>;

struct AbaqusDeck {
  VolumeFile file;
  std::unordered_map<std::int64_t, VertId> node_to_vert;
  ElementIndex element_to_hex, element_to_shell, element_to_line;
  std::vector<std::array<VertId, 4>> shells;
  std::vector<std::array<VertId, 2>> lines;
  AbaqusSets element_sets, node_sets;
  std::vector<std::string> sections;  ///< names of sets of *SOLID SECTION, in capitals
  std::vector<AbaqusSurface> surfaces;
};

/// Letters in capitals, without blanks.
std::string abaqus_key(std::string_view text);
bool is_abaqus_number(std::string_view word);

/// Makes regions, patches, curves and corners of the deck's sets.
void settle_abaqus_sets(AbaqusDeck& deck, SetNames& names);

}  // namespace hexwright::io
