#include "cad/occt/solids.h"

#include <cmath>
#include <cstdio>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>

#include "hexwright/base/error.h"

#include "cad/occt/occt.h"

namespace hexwright::cad {
namespace {

/// Gaps between loose faces that count as none, a share of the diagonal.
constexpr double kSewing = 1e-5;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::BadGeometry, message);
}

std::size_t count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  std::size_t number = 0;
  for (TopExp_Explorer it(shape, kind); it.More(); it.Next()) ++number;
  return number;
}

/// Edges that one face alone has, seams and poles apart.
std::vector<TopoDS_Edge> open_edges(const TopoDS_Shape& shell) {
  TopTools_IndexedDataMapOfShapeListOfShape edge_to_faces;
  TopExp::MapShapesAndAncestors(shell, TopAbs_EDGE, TopAbs_FACE, edge_to_faces);
  std::vector<TopoDS_Edge> open;
  for (int i = 1; i <= edge_to_faces.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edge_to_faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge) || edge_to_faces(i).Extent() != 1) continue;
    if (!BRep_Tool::IsClosed(edge, TopoDS::Face(edge_to_faces(i).First()))) open.push_back(edge);
  }
  return open;
}

std::string place_of(const TopoDS_Edge& edge) {
  const gp_Pnt p = BRep_Tool::Pnt(TopExp::FirstVertex(edge));
  char text[96];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", p.X(), p.Y(), p.Z());
  return text;
}

double diagonal_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  return box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
}

/// Sewing makes new faces of the old ones.
void carry_info(const TopoDS_Shape& whole, const BRepBuilderAPI_Sewing& sewing,
                Document& document) {
  for (const TopAbs_ShapeEnum kind : {TopAbs_FACE, TopAbs_EDGE})
    for (TopExp_Explorer it(whole, kind); it.More(); it.Next()) {
      const TopoDS_Shape& old = it.Current();
      const TopoDS_Shape now = sewing.IsModifiedSubShape(old) ? sewing.ModifiedSubShape(old) : old;
      const auto found = document.info.find(old.TShape());
      if (found != document.info.end() && now.TShape() != old.TShape()) {
        const PartInfo info = found->second;
        document.info.insert_or_assign(now.TShape(), info);
      }
    }
}

TopoDS_Shape close(const TopoDS_Shape& shell) {
  const std::vector<TopoDS_Edge> open = open_edges(shell);
  if (!open.empty())
    refuse("the file holds no solid, and its faces do not close: " + std::to_string(open.size()) +
           " edges have one face only, the first at " + place_of(open.front()) +
           " (mm); close the shell in the CAD program, or give it a thickness, and export a solid");
  BRepBuilderAPI_MakeSolid maker(TopoDS::Shell(shell));
  TopoDS_Solid solid = maker.Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

std::vector<TopoDS_Shape> sew(Document& document, std::vector<std::string>& notes) {
  BRepBuilderAPI_Sewing sewing(kSewing * diagonal_of(document.shape));
  for (TopExp_Explorer it(document.shape, TopAbs_FACE); it.More(); it.Next())
    sewing.Add(it.Current());
  sewing.Perform();
  carry_info(document.shape, sewing, document);
  const TopoDS_Shape sewn = sewing.SewedShape();
  std::vector<TopoDS_Shape> solids;
  for (TopExp_Explorer it(sewn, TopAbs_SHELL); it.More(); it.Next())
    solids.push_back(close(it.Current()));
  if (solids.empty())
    refuse(
        "the file holds no solid, and its faces do not join to one; export a solid from the CAD "
        "program");
  notes.push_back("the file's loose faces were sewn into " + std::to_string(solids.size()) +
                  (solids.size() == 1 ? " solid" : " solids"));
  return solids;
}

}  // namespace

std::vector<TopoDS_Shape> find_solids(Document& document, std::vector<std::string>& notes) {
  std::vector<TopoDS_Shape> solids;
  for (TopExp_Explorer it(document.shape, TopAbs_SOLID); it.More(); it.Next())
    solids.push_back(it.Current());
  const std::size_t num_faces = count(document.shape, TopAbs_FACE);
  if (num_faces == 0)
    refuse(
        "the file holds no surface, only lines and points or nothing at all; export the solid "
        "itself, not a drawing or a wireframe");
  if (solids.empty()) return sew(document, notes);
  std::size_t num_used = 0;
  for (const TopoDS_Shape& solid : solids) num_used += count(solid, TopAbs_FACE);
  if (num_used < num_faces)
    notes.push_back(std::to_string(num_faces - num_used) + " faces that no solid has are left out");
  return solids;
}

}  // namespace hexwright::cad
