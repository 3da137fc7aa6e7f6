// Reads 3MF files: the objects that are to be built, each a group by its name.
//
// An object without a name has that of the object it is a component of, else "object_7".
//
// Based on: 3MF Consortium, "3D Manufacturing Format. Core Specification", version 1.3, and
// "Production Extension" for objects in models of their own. Differs: positions stay in the file's
// unit; colours, materials and supports are passed over.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "hexwright/base/cancel.h"

#include "io/surface/polygon_soup.h"
#include "io/text/zip_archive.h"

namespace hexwright::io {
namespace {

/// Rows x, y, z and the shift: a point is a row before it.
struct Transform {
  std::array<Vec3, 4> rows = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{}};

  Vec3 direction(const Vec3& v) const { return v.x * rows[0] + v.y * rows[1] + v.z * rows[2]; }
  Vec3 point(const Vec3& p) const { return direction(p) + rows[3]; }
  /// First this one, then `outer`.
  Transform then(const Transform& outer) const {
    Transform both;
    for (std::size_t r = 0; r < 3; ++r) both.rows[r] = outer.direction(rows[r]);
    both.rows[3] = outer.point(rows[3]);
    return both;
  }
  bool is_mirror() const { return dot(rows[0], cross(rows[1], rows[2])) < 0; }
};

/// A file of the archive and its objects by id.
struct Model {
  std::string path;
  pugi::xml_document document;
  std::map<std::string, pugi::xml_node> objects;
};

/// Objects may hold each other many times over: no more of them are followed.
constexpr std::size_t kMostInstances = 100'000;
constexpr int kDeepest = 64;
/// Nor may copies make more vertices and corners of triangles than this, and so many more for each
/// byte of the models: about two hundred copies of a large object, thousands of a small one.
constexpr std::size_t kMostEntries = 4'000'000, kMostEntriesPerByte = 16;

class Reader3mf {
 public:
  explicit Reader3mf(const SurfaceSource& source)
      : name_(source.name), archive_(source.bytes, source.name) {}

  PolygonSoup run() {
    const Model& root = model(root_path());
    for (const auto item : root.document.child("model").child("build").children("item")) {
      const Transform transform = transform_of(item, root);
      add_object(find(root, item), transform, "", 0);
    }
    if (soup_.ends.empty())
      throw bad_file(name_, "nothing in the file is to be built; export the model as a mesh");
    return std::move(soup_);
  }

 private:
  struct Object {
    const Model* model;
    pugi::xml_node node;
  };

  [[noreturn]] void fail(const Model& model, const std::string& where,
                         const std::string& message) const {
    throw bad_element(name_, model.path + ": " + where,
                      message + "; the file is damaged, export it again");
  }

  /// By the relation of the package, else the first model that there is.
  std::string root_path() const {
    if (archive_.has("_rels/.rels")) {
      pugi::xml_document relations;
      relations.load_string(archive_.read("_rels/.rels").c_str());
      for (const auto relation : relations.child("Relationships").children("Relationship"))
        if (std::string_view(relation.attribute("Type").value()).ends_with("/3dmodel"))
          return without_slash(relation.attribute("Target").value());
    }
    for (const std::string& name : archive_.names())
      if (name.ends_with(".model")) return name;
    throw bad_file(name_,
                   "the content is a ZIP archive without a 3MF model, whatever the name says; "
                   "unpack it and give the surface file in it");
  }

  static std::string without_slash(std::string path) {
    if (path.starts_with('/')) path.erase(0, 1);
    return path;
  }

  const Model& model(const std::string& path) {
    std::unique_ptr<Model>& model = models_[path];
    if (model) return *model;
    model = std::make_unique<Model>();
    model->path = path;
    const std::string text = archive_.read(path);
    num_bytes_ += text.size();
    const auto parsed = model->document.load_buffer(text.data(), text.size());
    if (!parsed)
      throw bad_element(
          name_, path,
          fmt::format("the XML is damaged ({}); export the file again", parsed.description()));
    for (const auto object : model->document.child("model").child("resources").children("object"))
      model->objects[object.attribute("id").value()] = object;
    return *model;
  }

  /// What an item or a component stands for, in this model or another one.
  Object find(const Model& from, const pugi::xml_node& reference) {
    const char* path = "";
    for (const auto attribute : reference.attributes())
      if (std::string_view(attribute.name()).ends_with(":path")) path = attribute.value();
    const Model& in = *path ? model(without_slash(path)) : from;
    const std::string id = reference.attribute("objectid").value();
    const auto found = in.objects.find(id);
    if (found == in.objects.end())
      fail(from, reference.name(), "it names object '" + id + "', which is not there");
    return {&in, found->second};
  }

  Transform transform_of(const pugi::xml_node& node, const Model& model) const {
    Transform transform;
    std::string_view text = node.attribute("transform").value();
    if (text.empty()) return transform;
    for (int k = 0; k < 12; ++k) {
      while (text.starts_with(' ')) text.remove_prefix(1);
      double& value = transform.rows[static_cast<std::size_t>(k / 3)][k % 3];
      const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
      if (parsed.ec != std::errc())
        fail(model, node.name(), "its transform has fewer than twelve numbers");
      text.remove_prefix(static_cast<std::size_t>(parsed.ptr - text.data()));
    }
    return transform;
  }

  void add_object(const Object& object, const Transform& transform, const std::string& parent,
                  int depth) {
    if (++num_instances_ > kMostInstances || depth > kDeepest)
      fail(*object.model, "object", "objects hold each other too many times");
    const std::string_view type = object.node.attribute("type").value();
    if (type == "support" || type == "solidsupport" || type == "other") return;
    std::string name = object.node.attribute("name").value();
    if (name.empty()) name = parent;
    for (const auto part : object.node.child("components").children("component"))
      add_object(find(*object.model, part), transform_of(part, *object.model).then(transform), name,
                 depth + 1);
    if (name.empty()) name = fmt::format("object_{}", object.node.attribute("id").value());
    if (!object.node.child("mesh")) return;
    add_vertices(object, transform);
    soup_.begin_group(name);
    add_triangles(object, transform.is_mirror());
  }

  /// Called for every vertex and triangle.
  void check_size(const Object& object) {
    check_cancelled_();
    const std::size_t num_entries = soup_.positions.size() + soup_.verts.size();
    const std::size_t most = kMostEntries + kMostEntriesPerByte * num_bytes_;
    if (num_entries > std::min(most, kMaxElements))
      throw bad_element(
          name_,
          fmt::format("{}: object {}", object.model->path, object.node.attribute("id").value()),
          fmt::format("with its copies the file has more than {} vertices and corners of "
                      "triangles, far more than what is written in it; give each object once",
                      num_entries - 1));
  }

  void add_vertices(const Object& object, const Transform& transform) {
    first_vert_ = soup_.positions.size();
    const auto mesh = object.node.child("mesh");
    for (const auto vertex : mesh.child("vertices").children("vertex")) {
      check_size(object);
      const auto where = [&] {
        return fmt::format("vertex {}", soup_.positions.size() - first_vert_);
      };
      const Vec3 p = {number<double>(*object.model, vertex, "x", where),
                      number<double>(*object.model, vertex, "y", where),
                      number<double>(*object.model, vertex, "z", where)};
      if (!is_finite(transform.point(p)))
        fail(*object.model, where(), "a coordinate is not finite");
      soup_.positions.push_back(transform.point(p));
    }
  }

  void add_triangles(const Object& object, bool is_mirror) {
    const std::size_t num_verts = soup_.positions.size() - first_vert_;
    std::size_t t = 0;
    const auto mesh = object.node.child("mesh");
    for (const auto triangle : mesh.child("triangles").children("triangle")) {
      check_size(object);
      const auto where = [&] { return fmt::format("triangle {}", t); };
      for (const char* corner :
           is_mirror ? std::array{"v1", "v3", "v2"} : std::array{"v1", "v2", "v3"}) {
        const auto index = number<std::size_t>(*object.model, triangle, corner, where);
        if (index >= num_verts)
          fail(*object.model, where(), fmt::format("it uses vertex {} of {}", index, num_verts));
        soup_.verts.push_back(VertId(first_vert_ + index));
      }
      soup_.end_polygon();
      ++t;
    }
  }

  template <class Number>
  Number number(const Model& model, const pugi::xml_node& node, const char* attribute,
                const auto& where) const {
    const std::string_view text = node.attribute(attribute).value();
    Number value{};
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size())
      fail(model, where(), fmt::format("its '{}' is no number", attribute));
    return value;
  }

  const std::string& name_;
  ZipArchive archive_;
  std::map<std::string, std::unique_ptr<Model>> models_;
  PolygonSoup soup_;
  CancelCheck check_cancelled_;
  std::size_t num_instances_ = 0, num_bytes_ = 0;  // of the models read so far
  std::size_t first_vert_ = 0;                     // of the object being added
};

}  // namespace

PolygonSoup read_3mf(const SurfaceSource& source) { return Reader3mf(source).run(); }

}  // namespace hexwright::io
