// The table of sets, and how names are fitted to what formats allow.
#include "hexwright/io/set_table.h"

#include <gtest/gtest.h>

#include "io/sample_meshes.h"

namespace hexwright {
namespace {

using Names = std::vector<std::string>;

Names names_of(const std::vector<NamedSet>& sets) {
  Names names;
  for (const NamedSet& set : sets) names.push_back(set.name);
  return names;
}

TEST(SetTable, HoldsEveryElementOnceUnderItsName) {
  const HexMesh mesh = test::named_box();
  const SetTable table = make_set_table(mesh);
  EXPECT_EQ(names_of(table.regions), (Names{"steel", "REGION_1", "cuivre \xc3\xa9tam\xc3\xa9"}));
  EXPECT_EQ(names_of(table.patches),
            (Names{"inlet", "Inlet", "outer wall", "wall.1", "wall.2", "PATCH_5"}));
  EXPECT_EQ(names_of(table.patch_groups), Names{"wall"});
  EXPECT_EQ(names_of(table.curves), (Names{"CURVE_NONE", "rim", "1st edge", "CURVE_2"}));
  EXPECT_EQ(names_of(table.corners), Names{"CORNERS"});
  std::size_t num_hexes = 0, num_quads = 0;
  for (const NamedSet& set : table.regions) num_hexes += set.members.size();
  for (const NamedSet& set : table.patches) num_quads += set.members.size();
  EXPECT_EQ(num_hexes, mesh.num_hexes());
  EXPECT_EQ(num_quads, mesh.labels.quads.size());
  const NamedSet &first = SetTable::at(table.patches, 3), &second = SetTable::at(table.patches, 4);
  EXPECT_EQ(table.patch_groups[0].members.size(), first.members.size() + second.members.size());
}

TEST(SetTable, NumbersNameWhatHasNoName) {
  HexMesh mesh = test::labelled_box();
  mesh.region[HexId(0)] = -2;
  const SetTable table = make_set_table(mesh);
  EXPECT_EQ(table.regions[0].name, "REGION_MINUS_2");
  EXPECT_EQ(table.patches[0].name, "PATCH_NONE");
  EXPECT_EQ(table.patches[1].name, "PATCH_0");
}

TEST(SetTable, OnePatchIsNoGroupAndANameThatIsThereIsNone) {
  HexMesh mesh = test::named_box();
  mesh.labels.patch_names = {"a.1", "b.1", "b.2", "b", "c.x", "d.10"};
  EXPECT_TRUE(make_set_table(mesh).patch_groups.empty());
}

TEST(SetTable, SidesAreFacesOfTheHexes) {
  const HexMesh mesh = test::named_box();
  const auto sides = find_quad_sides(mesh);
  for (std::size_t q = 0; q < sides.size(); ++q)
    EXPECT_EQ(face_verts(mesh, sides[q]), mesh.labels.quads[q].verts);
}

TEST(SetTable, NodesAreThoseOfTheElements) {
  const HexMesh mesh = test::named_box();
  const SetTable table = make_set_table(mesh);
  EXPECT_EQ(set_nodes(mesh, table.patches[0]).size(), 12u);  // 3 x 2 quads
  EXPECT_EQ(set_nodes(mesh, table.corners[0]), mesh.labels.corners);
  EXPECT_EQ(set_nodes(mesh, table.curves[1]).size(), 2u);
}

SetTable table_of(const Names& patch_names) {
  SetTable table;
  for (const std::string& name : patch_names)
    table.patches.push_back({SetKind::Patch, name, std::int32_t(table.patches.size()), {0}, true});
  return table;
}

TEST(NameRules, ForbiddenLettersAreReplacedAndTold) {
  NameRules rules;
  rules.is_allowed = is_word_letter;
  rules.starts_with_letter = true;
  SetTable table = table_of({"outer wall", "wall.1", "2nd", "fine", "\xc3\xa9t\xc3\xa9"});
  const auto changed = apply_name_rules(rules, table);
  EXPECT_EQ(names_of(table.patches), (Names{"outer_wall", "wall_1", "s_2nd", "fine", "s___t__"}));
  ASSERT_EQ(changed.size(), 4u);
  EXPECT_EQ(changed[0], (ChangedName{"outer wall", "outer_wall"}));
}

TEST(NameRules, NamesThatAreTakenGetANumber) {
  NameRules rules;
  rules.is_allowed = is_word_letter;
  rules.ignores_case = true;
  SetTable table = table_of({"Inlet", "inlet", "in let", "in_let", "INLET_2"});
  apply_name_rules(rules, table);
  EXPECT_EQ(names_of(table.patches),
            (Names{"Inlet", "inlet_2", "in_let", "in_let_2", "INLET_2_2"}));
}

TEST(NameRules, NamesOfUsersComeBeforeNumbers) {
  SetTable table = table_of({"PATCH_0", "PATCH_0"});
  table.patches[0].is_given = false;
  EXPECT_EQ(apply_name_rules({}, table), (std::vector<ChangedName>{{"PATCH_0", "PATCH_0_2"}}));
  EXPECT_EQ(names_of(table.patches), (Names{"PATCH_0_2", "PATCH_0"}));
}

TEST(NameRules, LengthsAreCutAtWholeLettersAndStayUnique) {
  NameRules rules;
  rules.max_length = 8;
  SetTable table = table_of({"abcdefghij", "abcdefghXX", "abcdefg\xc3\xa9"});
  apply_name_rules(rules, table);
  EXPECT_EQ(names_of(table.patches), (Names{"abcdefgh", "abcdef_2", "abcdefg"}));
}

TEST(NameRules, DerivedAndReservedNamesAreKeptFree) {
  NameRules rules;
  rules.suffix = "_NODES";
  rules.reserved = {"EALL"};
  SetTable table = table_of({"a", "a_NODES", "EALL"});
  apply_name_rules(rules, table);
  EXPECT_EQ(names_of(table.patches), (Names{"a", "a_NODES_2", "EALL_2"}));
}

TEST(NameRules, KindsMayShareNamesWhereTheFormatLetsThem) {
  NameRules rules;
  SetTable table = table_of({"steel"});
  table.regions.push_back({SetKind::Region, "steel", 0, {0}, true});
  rules.is_unique_per_kind = true;
  EXPECT_TRUE(apply_name_rules(rules, table).empty());
  rules.is_unique_per_kind = false;
  EXPECT_EQ(apply_name_rules(rules, table).size(), 1u);
}

}  // namespace
}  // namespace hexwright
