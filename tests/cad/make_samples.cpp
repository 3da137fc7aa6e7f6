// Makes the CAD files of data/cad: make_samples FOLDER.
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax2.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>

namespace {

struct Named {
  TopoDS_Shape shape;
  std::string name;
};

/// Parts of a file, and the names and red faces in them.
struct Sample {
  std::vector<Named> parts, faces;
  std::vector<TopoDS_Shape> red;
  std::string unit = "MM";
};

void write(const std::filesystem::path& path, const Sample& sample) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const auto set_name = [](const TDF_Label& label, const std::string& name) {
    TDataStd_Name::Set(label, TCollection_ExtendedString(name.c_str()));
  };
  for (const Named& part : sample.parts) {
    const TDF_Label label = shapes->AddShape(part.shape, false);
    set_name(label, part.name);
    TopTools_IndexedMapOfShape own;
    TopExp::MapShapes(part.shape, own);
    for (const Named& face : sample.faces)
      if (own.Contains(face.shape)) set_name(shapes->AddSubShape(label, face.shape), face.name);
    for (const TopoDS_Shape& face : sample.red)
      if (own.Contains(face))
        colors->SetColor(shapes->AddSubShape(label, face), Quantity_Color(Quantity_NOC_RED),
                         XCAFDoc_ColorSurf);
  }
  Interface_Static::SetCVal("write.step.unit", sample.unit.c_str());
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  STEPCAFControl_Writer writer;
  writer.SetNameMode(true);
  writer.SetColorMode(true);
  writer.Transfer(document);
  writer.Write(path.c_str());
  XCAFApp_Application::GetApplication()->Close(document);
}

std::vector<TopoDS_Face> faces_of(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Face> faces;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
    faces.push_back(TopoDS::Face(it.Current()));
  return faces;
}

TopoDS_Shape cylinder_face(const TopoDS_Shape& shape, double radius) {
  for (const TopoDS_Face& face : faces_of(shape)) {
    const BRepAdaptor_Surface surface(face);
    if (surface.GetType() == GeomAbs_Cylinder &&
        std::abs(surface.Cylinder().Radius() - radius) < 1e-9)
      return face;
  }
  return {};
}

/// The plane face at a height along an axis (0, 1, 2).
TopoDS_Shape plane_face(const TopoDS_Shape& shape, int axis, double at) {
  for (const TopoDS_Face& face : faces_of(shape)) {
    const BRepAdaptor_Surface surface(face);
    if (surface.GetType() != GeomAbs_Plane) continue;
    const gp_Pln plane = surface.Plane();
    if (std::abs(plane.Axis().Direction().Coord(axis + 1)) > 0.999 &&
        std::abs(plane.Location().Coord(axis + 1) - at) < 1e-9)
      return face;
  }
  return {};
}

TopoDS_Shape hole(double x, double y, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, -1), gp_Dir(0, 0, 1)), radius, height + 2);
}

Sample plate_hole() {
  const TopoDS_Shape plate =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 20, 5), hole(20, 10, 5, 5)).Shape();
  return {{{plate, "plate"}},
          {{plane_face(plate, 0, 0), "fixed"},
           {plane_face(plate, 0, 40), "pulled"},
           {cylinder_face(plate, 5), "bore"}},
          {plane_face(plate, 2, 5)}};
}

/// A disc with a hub, a bore and four bolt holes; the hub meets the disc in a fillet of 2.
Sample flange() {
  TopoDS_Shape body = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(30, 8).Shape(),
                                       BRepPrimAPI_MakeCylinder(14, 25).Shape());
  BRepFilletAPI_MakeFillet fillet(body);
  for (TopExp_Explorer it(body, TopAbs_EDGE); it.More(); it.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(it.Current()));
    if (curve.GetType() != GeomAbs_Circle || std::abs(curve.Circle().Radius() - 14) > 1e-9)
      continue;
    if (std::abs(curve.Circle().Location().Z() - 8) < 1e-9)
      fillet.Add(2, TopoDS::Edge(it.Current()));
  }
  body = fillet.Shape();
  body = BRepAlgoAPI_Cut(body, hole(0, 0, 9, 25));
  for (const auto& [x, y] :
       {std::pair(22, 0), std::pair(0, 22), std::pair(-22, 0), std::pair(0, -22)})
    body = BRepAlgoAPI_Cut(body, hole(x, y, 3, 25));
  return {{{body, "flange"}}, {}, {}};
}

/// All edges rounded: no sharp edge is left.
Sample filleted_block() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(30, 20, 10);
  BRepFilletAPI_MakeFillet fillet(box);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(box, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) fillet.Add(2, TopoDS::Edge(edges(i)));
  const TopoDS_Shape block = fillet.Shape();
  return {{{block, "block"}}, {{plane_face(block, 2, 10), "top"}}, {}};
}

Sample two_solids() {
  const TopoDS_Shape base = BRepPrimAPI_MakeBox(20, 20, 5);
  const TopoDS_Shape pin =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(10, 10, 5), gp_Dir(0, 0, 1)), 4, 10);
  const TopoDS_Shape apart = BRepPrimAPI_MakeBox(gp_Pnt(30, 0, 0), 8, 20, 8);
  return {{{base, "base"}, {pin, "pin"}, {apart, "rail"}}, {}, {}};
}

/// Pi/2 of a thick cylinder, radii 10 and 20: the symmetry planes have names.
Sample thick_cylinder() {
  const TopoDS_Shape tube =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(20, 5, M_PI / 2).Shape(), hole(0, 0, 10, 5)).Shape();
  return {{{tube, "tube"}},
          {{plane_face(tube, 0, 0), "x0"},
           {plane_face(tube, 1, 0), "y0"},
           {cylinder_face(tube, 10), "inside"},
           {cylinder_face(tube, 20), "outside"}},
          {}};
}

/// 1 x 2 x 3 inches.
Sample box_in_inches() {
  return {{{BRepPrimAPI_MakeBox(25.4, 50.8, 76.2), "block"}}, {}, {}, "INCH"};
}

/// A box without its lid.
Sample open_shell() {
  BRep_Builder builder;
  TopoDS_Compound open;
  builder.MakeCompound(open);
  const std::vector<TopoDS_Face> faces = faces_of(BRepPrimAPI_MakeBox(10, 10, 10));
  for (std::size_t k = 0; k + 1 < faces.size(); ++k) builder.Add(open, faces[k]);
  return {{{open, "shell"}}, {}, {}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_samples FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  STEPCAFControl_Controller::Init();
  write(folder / "plate_hole.step", plate_hole());
  write(folder / "flange.step", flange());
  write(folder / "filleted_block.step", filleted_block());
  write(folder / "two_solids.step", two_solids());
  write(folder / "thick_cylinder.step", thick_cylinder());
  write(folder / "box_in_inches.step", box_in_inches());
  write(folder / "open_shell.step", open_shell());
  IGESControl_Writer iges("MM", 0);  // faces, no solid
  iges.AddShape(plate_hole().parts[0].shape);
  iges.Write((folder / "plate_hole.iges").c_str());
  BRepTools::Write(plate_hole().parts[0].shape, (folder / "plate_hole.brep").c_str());
}
