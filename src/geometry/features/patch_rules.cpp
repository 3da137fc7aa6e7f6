// Rules are functions that are negative inside; their zero sets are cut into the triangles.
#include "hexwright/geometry/patch_rules.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "hexwright/base/error.h"
#include "hexwright/base/name_pattern.h"
#include "hexwright/geometry/surface_tree.h"

#include "geometry/features/angle_flood.h"

namespace hexwright {
namespace {

using Kind = PatchCondition::Kind;

constexpr double kToleranceRelDiagonal = 1e-4;
constexpr double kFileRelDiagonal = 1e-3;  // how near a triangle lies to the file's surface
constexpr double kChordRelRadius = 1.0 / 16;
constexpr int kMostBisections = 24;

/// A border to be imprinted: zero of `distance`. Curved ones need edges no longer than `longest`.
struct Border {
  std::function<double(const Vec3&)> distance;
  double longest = std::numeric_limits<double>::infinity();
};

double axis_distance(const PatchCondition& c, const Vec3& p) {
  return norm(cross(p - c.a, c.b)) - c.value;
}

void add_borders(const PatchCondition& c, std::vector<Border>& borders) {
  switch (c.kind) {
    case Kind::HalfSpace:
      borders.push_back({[c](const Vec3& p) { return dot(c.a, p) - c.value; }});
      return;
    case Kind::Box:
      for (int axis = 0; axis < 3; ++axis)
        for (const double at : {c.a[axis], c.b[axis]})
          borders.push_back({[axis, at](const Vec3& p) { return p[axis] - at; }});
      return;
    case Kind::Sphere:
      borders.push_back(
          {[c](const Vec3& p) { return norm(p - c.a) - c.value; }, c.value * kChordRelRadius});
      return;
    case Kind::Cylinder:
      borders.push_back(
          {[c](const Vec3& p) { return axis_distance(c, p); }, c.value * kChordRelRadius});
      return;
    default:
      return;
  }
}

/// Divides edges, and with them their triangles. Where an edge is divided depends on its two places
/// alone, taken in one order, so that copies of an edge are divided alike.
class EdgeSplitter {
 public:
  /// Where to divide an edge from a to b, as a share of it; absent: not.
  using Decide = std::function<std::optional<double>(const Vec3& a, const Vec3& b)>;

  explicit EdgeSplitter(TriMesh& mesh) : mesh_(mesh) {}

  /// False when nothing was divided.
  bool run(const Decide& decide) {
    edge_to_vert_.clear();
    for (TriId t : mesh_.tris.ids())
      for (std::size_t k = 0; k < 3; ++k)
        visit(mesh_.tris[t][k], mesh_.tris[t][(k + 1) % 3], decide);
    const std::size_t count = mesh_.num_tris();
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) any = divide(TriId(i)) || any;
    return any;
  }

 private:
  static std::pair<VertId, VertId> key(VertId a, VertId b) {
    return {std::min(a, b), std::max(a, b)};
  }

  void visit(VertId a, VertId b, const Decide& decide) {
    if (edge_to_vert_.contains(key(a, b))) return;
    Vec3 p = mesh_.positions[a], q = mesh_.positions[b];
    if (std::array{q.x, q.y, q.z} < std::array{p.x, p.y, p.z}) std::swap(p, q);
    const auto share = decide(p, q);
    edge_to_vert_[key(a, b)] = share ? mesh_.positions.push_back(p + (q - p) * *share) : VertId();
  }

  VertId mid(VertId a, VertId b) const {
    const auto found = edge_to_vert_.find(key(a, b));
    return found == edge_to_vert_.end() ? VertId() : found->second;
  }

  void add(VertId a, VertId b, VertId c, TriId like) {
    mesh_.tris.push_back({a, b, c});
    if (!mesh_.group.empty()) mesh_.group.push_back(mesh_.group[like]);
  }

  /// Into two, three or four; with two divided edges the new one joins the two new vertices.
  bool divide(TriId t) {
    auto v = mesh_.tris[t];
    std::array<VertId, 3> m;
    for (std::size_t k = 0; k < 3; ++k) m[k] = mid(v[k], v[(k + 1) % 3]);
    const auto count = std::count_if(m.begin(), m.end(), [](VertId x) { return x.is_valid(); });
    if (count == 0) return false;
    // Turned so that the one divided edge is the first, or the one that is not the last.
    while (count == 1 ? !m[0].is_valid() : count == 2 && m[2].is_valid()) {
      std::rotate(v.begin(), v.begin() + 1, v.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    if (count == 1) {
      mesh_.tris[t] = {v[0], m[0], v[2]};
      add(m[0], v[1], v[2], t);
    } else {
      mesh_.tris[t] = {m[0], v[1], m[1]};
      if (count == 2) {
        add(v[0], m[0], m[1], t);
        add(v[0], m[1], v[2], t);
      } else {
        add(v[0], m[0], m[2], t);
        add(m[2], m[1], v[2], t);
        add(m[0], m[1], m[2], t);
      }
    }
    return true;
  }

  TriMesh& mesh_;
  std::map<std::pair<VertId, VertId>, VertId> edge_to_vert_;  // invalid: not divided
};

/// The zero of the distance between two places on its two sides.
double find_zero(const Border& border, const Vec3& a, const Vec3& b) {
  const double da = border.distance(a), db = border.distance(b);
  double t = da / (da - db), lo = 0, hi = 1;  // exact for planes
  constexpr double kZero = 1e-14;
  constexpr int kHalvings = 50;
  if (std::abs(border.distance(a + (b - a) * t)) <= kZero * std::abs(da - db)) return t;
  for (int k = 0; k < kHalvings; ++k) {
    t = (lo + hi) / 2;
    ((border.distance(a + (b - a) * t) < 0) == (da < 0) ? lo : hi) = t;
  }
  return t;
}

/// The longest edge of a triangle that a curved border crosses has its midpoint within its length
/// of the border: halving such edges leaves none that is too long.
void imprint(const Border& border, double tolerance, TriMesh& mesh) {
  EdgeSplitter splitter(mesh);
  const auto halve = [&](const Vec3& a, const Vec3& b) -> std::optional<double> {
    const double length = distance(a, b);
    const bool is_near = std::abs(border.distance((a + b) * 0.5)) <= length;
    return length > border.longest && is_near ? std::optional(0.5) : std::nullopt;
  };
  for (int k = 0; k < kMostBisections && std::isfinite(border.longest); ++k)
    if (!splitter.run(halve)) break;
  splitter.run([&](const Vec3& a, const Vec3& b) -> std::optional<double> {
    const double da = border.distance(a), db = border.distance(b);
    const bool is_cut = std::min(std::abs(da), std::abs(db)) > tolerance && (da < 0) != (db < 0);
    return is_cut ? std::optional(find_zero(border, a, b)) : std::nullopt;
  });
}

/// Whether a triangle meets a condition.
class Judge {
 public:
  Judge(const TriMesh& mesh, const PatchCondition& condition, double diagonal)
      : mesh_(mesh), condition_(condition), diagonal_(diagonal) {
    if (condition.kind == Kind::File) tree_.emplace(condition.surface);
    if (condition.kind == Kind::Angle)
      is_reached_ = flood_by_angle(mesh, condition.a, condition.value);
  }

  bool meets(TriId t) const {
    const auto p = mesh_.corners(t);
    const Vec3 center = (p[0] + p[1] + p[2]) / 3;
    const PatchCondition& c = condition_;
    const double tolerance = kToleranceRelDiagonal * diagonal_;
    switch (c.kind) {
      case Kind::HalfSpace:
        return dot(c.a, center) - c.value <= tolerance;
      case Kind::Plane:
        return std::all_of(p.begin(), p.end(), [&](const Vec3& x) {
          return std::abs(dot(c.a, x) - c.value) <= tolerance;
        });
      case Kind::Box:
        for (int axis = 0; axis < 3; ++axis)
          if (center[axis] < c.a[axis] - tolerance || center[axis] > c.b[axis] + tolerance)
            return false;
        return true;
      case Kind::Sphere:
        return norm(center - c.a) - c.value <= tolerance;
      case Kind::Cylinder:
        return axis_distance(c, center) <= tolerance;
      case Kind::CadFace:
        return !mesh_.group.empty() &&
               std::ranges::find(c.groups, mesh_.group[t]) != c.groups.end();
      case Kind::Angle:
        return is_reached_[t.index()] != 0;
      case Kind::Normal:
        return dot(normalized(cross(p[1] - p[0], p[2] - p[0])), c.a) >= c.value;
      default:
        return tree_->distance(center) <= kFileRelDiagonal * diagonal_;
    }
  }

 private:
  const TriMesh& mesh_;
  const PatchCondition& condition_;
  double diagonal_;
  std::optional<SurfaceTree> tree_;
  std::vector<char> is_reached_;  // of Angle
};

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw Error(ErrorCode::BadArgument,
              "the patch rule '" + text + "' " + why +
                  "; write for example inlet=plane:x<0.001, "
                  "hole=cylinder:0,0,0,0,0,1,2.5 or top=normal:0,0,1;20deg");
}

/// Numbers separated by commas; absent when one is none or their count is another.
std::optional<std::vector<double>> parse_numbers(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  while (true) {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    if (end == at || !std::isfinite(numbers.back())) return std::nullopt;
    if (*end == '\0') break;
    if (*end != ',') return std::nullopt;
    at = end + 1;
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

/// "x<0.1"
PatchCondition parse_plane(const std::string& text, const std::string& rule) {
  PatchCondition c;
  const std::size_t at = text.size() < 3 ? 2 : text[2] == '=' ? 3 : 2;  // "<=" is "<"
  const auto value = parse_numbers(text.substr(std::min(at, text.size())), 1);
  const int axis = text.empty() ? -1 : text[0] - 'x';
  if (axis < 0 || axis > 2 || !value || std::string("<>=").find(text[1]) == std::string::npos)
    refuse(rule, "has no plane such as x<0.1, y>2 or z=0");
  c.kind = text[1] == '=' ? Kind::Plane : Kind::HalfSpace;
  const double sign = text[1] == '>' ? -1 : 1;
  c.a[axis] = sign;
  c.value = sign * (*value)[0];
  return c;
}

/// "X,Y,Z;20deg", three numbers and the cosine of an angle.
PatchCondition parse_with_angle(Kind kind, const std::string& text, const std::string& rule) {
  PatchCondition c;
  c.kind = kind;
  const auto semicolon = text.find(';');
  double angle = kind == Kind::Normal ? 1 : 30;
  if (semicolon != std::string::npos) {
    std::string given = text.substr(semicolon + 1);
    if (given.ends_with("deg")) given.resize(given.size() - 3);
    const auto parsed = parse_numbers(given, 1);
    if (!parsed || (*parsed)[0] < 0 || (*parsed)[0] > 180) refuse(rule, "has no angle in degrees");
    angle = (*parsed)[0];
  }
  const auto n = parse_numbers(text.substr(0, semicolon), 3);
  if (n) c.a = {(*n)[0], (*n)[1], (*n)[2]};
  if (kind == Kind::Normal && (c.a = normalized(c.a)) == Vec3{})
    refuse(rule, "has no direction of three numbers");
  if (!n) refuse(rule, "has no point of three numbers");
  c.value = std::cos(angle * std::numbers::pi / 180);
  return c;
}

PatchCondition parse_round(Kind kind, const std::string& text, const std::string& rule) {
  const bool is_sphere = kind == Kind::Sphere;
  const auto n = parse_numbers(text, is_sphere ? 4 : 7);
  if (!n || !(n->back() > 0))
    refuse(rule, is_sphere ? "needs a centre and a radius above 0"
                           : "needs a point, a direction and a radius above 0");
  PatchCondition c;
  c.kind = kind;
  c.a = {(*n)[0], (*n)[1], (*n)[2]};
  if (!is_sphere && (c.b = normalized({(*n)[3], (*n)[4], (*n)[5]})) == Vec3{})
    refuse(rule, "has an axis without a direction");
  c.value = n->back();
  return c;
}

PatchCondition parse_box(const std::string& text, const std::string& rule) {
  const auto n = parse_numbers(text, 6);
  if (!n) refuse(rule, "needs the six numbers of a box");
  PatchCondition c;
  c.kind = Kind::Box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    c.a[axis] = std::min((*n)[k], (*n)[k + 3]);
    c.b[axis] = std::max((*n)[k], (*n)[k + 3]);
  }
  return c;
}

/// "r=5" of a kind of surface, or "cone" of kind itself; absent when the text is neither.
std::optional<PatchCondition> parse_cad_face(const std::string& kind, const std::string& value,
                                             const std::string& rule) {
  PatchCondition c;
  c.kind = Kind::CadFace;
  c.face_kind = kind;
  if (kind == "face") {
    if (value.empty()) refuse(rule, "names no face");
    check_pattern(value);
    c.face_name = value;
    return c;
  }
  if (kind == "kind") {
    c.face_kind = value;
    for (const char* known : {"plane", "cylinder", "cone", "sphere", "torus", "spline"})
      if (value == known) return c;
    refuse(rule, "asks for no kind of surface: plane, cylinder, cone, sphere, torus or spline");
  }
  const bool is_round = kind == "cylinder" || kind == "sphere" || kind == "torus";
  if (!is_round || !value.starts_with("r=")) return {};
  const auto radius = parse_numbers(value.substr(2), 1);
  if (!radius || !((*radius)[0] > 0)) refuse(rule, "needs a radius above 0");
  c.value = (*radius)[0];
  return c;
}

PatchCondition parse_condition(const std::string& text, const std::string& rule) {
  const auto colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string value = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (auto face = parse_cad_face(kind, value, rule)) return *face;
  if (kind == "plane") return parse_plane(value, rule);
  if (kind == "normal") return parse_with_angle(Kind::Normal, value, rule);
  if (kind == "angle") return parse_with_angle(Kind::Angle, value, rule);
  if (kind == "box") return parse_box(value, rule);
  if (kind == "sphere") return parse_round(Kind::Sphere, value, rule);
  if (kind == "cylinder") return parse_round(Kind::Cylinder, value, rule);
  if (kind != "file" || value.empty())
    refuse(rule,
           "is of no known kind: plane, box, sphere, cylinder, normal, angle, file, face or kind");
  PatchCondition c;
  c.kind = Kind::File;
  c.path = value;
  return c;
}

/// The group of this name, made when there is none yet.
std::int32_t group_of(TriMesh& mesh, const std::string& name) {
  auto& names = mesh.group_names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::int32_t>(found - names.begin());
  names.push_back(name);
  return static_cast<std::int32_t>(names.size() - 1);
}

}  // namespace

PatchRule parse_patch_rule(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) refuse(text, "has no NAME= in front");
  PatchRule rule;
  rule.name = text.substr(0, equals);
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find('&', begin), text.size());
    rule.conditions.push_back(parse_condition(text.substr(begin, end - begin), text));
    begin = end + 1;
  }
  return rule;
}

RuledSurface apply_patch_rules(const TriMesh& surface, std::span<const PatchRule> rules) {
  RuledSurface result{surface, std::vector<std::size_t>(rules.size(), 0)};
  if (rules.empty()) return result;
  TriMesh& mesh = result.surface;
  const double diagonal = bounding_box(surface).diagonal();
  std::vector<Border> borders;
  for (const PatchRule& rule : rules)
    for (const PatchCondition& condition : rule.conditions) add_borders(condition, borders);
  for (const Border& border : borders) imprint(border, kToleranceRelDiagonal * diagonal, mesh);

  if (mesh.group.empty()) mesh.group.assign(mesh.num_tris(), group_of(mesh, ""));
  IdVector<TriId, char> is_named(mesh.num_tris(), 0);
  for (std::size_t r = 0; r < rules.size(); ++r) {
    std::vector<Judge> judges;
    for (const PatchCondition& c : rules[r].conditions) judges.emplace_back(mesh, c, diagonal);
    const std::int32_t group = group_of(mesh, rules[r].name);
    for (TriId t : mesh.tris.ids()) {
      if (is_named[t] || !std::all_of(judges.begin(), judges.end(),
                                      [&](const Judge& judge) { return judge.meets(t); }))
        continue;
      mesh.group[t] = group;
      is_named[t] = 1;
      ++result.num_matched[r];
    }
  }
  return result;
}

}  // namespace hexwright
