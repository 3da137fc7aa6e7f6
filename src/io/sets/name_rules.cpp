// Fits names to what a format allows.
#include <set>

#include <fmt/format.h>

#include "hexwright/io/set_table.h"

namespace hexwright {
namespace {

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// At most this many bytes, without half a character of UTF-8 at the end.
void cut(std::string& name, std::size_t length) {
  if (name.size() <= length) return;
  while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xc0) == 0x80) --length;
  name.resize(length);
}

class NameFitter {
 public:
  explicit NameFitter(const NameRules& rules) : rules_(rules) {
    for (std::string_view name : rules.reserved)
      for (int scope = 0; scope < kNumScopes; ++scope)
        taken_.insert({scope, key(std::string(name))});
  }

  void fit(NamedSet& set) {
    const std::string allowed = to_allowed(set);
    std::string name = allowed;
    for (int copy = 2; !take(set.kind, name); ++copy) {
      const std::string number = fmt::format("_{}", copy);
      name = allowed;
      cut(name, room_for(set.kind) - number.size());
      name += number;
    }
    set.name = std::move(name);
  }

 private:
  static constexpr int kNumScopes = 4;  // regions, patches and their groups, curves, corners

  static bool is_of_quads(SetKind kind) {
    return kind == SetKind::Patch || kind == SetKind::PatchGroup;
  }
  int scope_of(SetKind kind) const {
    if (!rules_.is_unique_per_kind) return 0;
    return is_of_quads(kind) ? 1 : kind == SetKind::Curve ? 2 : kind == SetKind::Corners ? 3 : 0;
  }
  std::size_t room_for(SetKind kind) const {
    return rules_.max_length - (is_of_quads(kind) ? rules_.suffix.size() : 0);
  }

  std::string to_allowed(const NamedSet& set) const {
    std::string name = set.name;
    for (char& c : name) {
      const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
      if (is_control || (rules_.is_allowed && !rules_.is_allowed(c))) c = '_';
      if (rules_.is_upper_case) c = to_upper(c);
    }
    if (rules_.starts_with_letter && (name.empty() || !is_letter(name[0])))
      name = (rules_.is_upper_case ? "S_" : "s_") + name;
    cut(name, room_for(set.kind));
    return name;
  }

  std::string key(std::string name) const {
    if (rules_.ignores_case)
      for (char& c : name) c = to_upper(c);
    return name;
  }

  /// False when the name, or a name derived from it, is another set's.
  bool take(SetKind kind, const std::string& name) {
    const int scope = scope_of(kind);
    const std::string plain = key(name), derived = key(name + std::string(rules_.suffix));
    const bool has_derived = is_of_quads(kind) && !rules_.suffix.empty();
    if (name.empty() || taken_.contains({scope, plain}) ||
        (has_derived && taken_.contains({scope, derived})))
      return false;
    taken_.insert({scope, plain});
    if (has_derived) taken_.insert({scope, derived});
    return true;
  }

  const NameRules& rules_;
  std::set<std::pair<int, std::string>> taken_;
};

}  // namespace

bool is_word_letter(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; }
bool is_word_letter_or_mark(char c) { return is_word_letter(c) || c == '.' || c == '-'; }

std::vector<ChangedName> apply_name_rules(const NameRules& rules, SetTable& table) {
  std::vector<NamedSet*> sets;
  for (auto* kind :
       {&table.regions, &table.patches, &table.patch_groups, &table.curves, &table.corners})
    for (NamedSet& set : *kind) sets.push_back(&set);
  std::vector<std::string> given;
  for (const NamedSet* set : sets) given.push_back(set->name);
  NameFitter fitter(rules);
  std::vector<NamedSet*> unnamed;
  for (NamedSet* set : sets)
    if (set->is_given)
      fitter.fit(*set);
    else
      unnamed.push_back(set);
  for (NamedSet* set : unnamed) fitter.fit(*set);
  std::vector<ChangedName> changed;
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (sets[i]->name != given[i]) changed.push_back({given[i], sets[i]->name});
  return changed;
}

}  // namespace hexwright
