// STEP and IGES with names, colours and layers; BREP as it is.
//
// Names of bodies, faces and edges are those of STEP's representation items (ISO 10303-42: every
// item has one, mostly empty); names of parts are those of the products.
#include "cad/occt/document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Controller.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include "hexwright/base/error.h"

namespace hexwright::cad {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::BadFile, message); }

std::string read_bytes(const std::filesystem::path& path) {
  std::error_code unreadable;  // a folder on the way that may not be entered is no file either
  if (!std::filesystem::is_regular_file(path, unreadable))
    throw Error(ErrorCode::CannotOpen, "no such file; check the path");
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw Error(ErrorCode::CannotOpen, "the file cannot be read; check its permissions");
  return bytes;
}

std::string in_lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// What programs write where the designer gave no name.
bool is_placeholder(const std::string& name) {
  static const std::array<std::string, 12> kPlaceholders = {
      "none",  "solid",     "shell", "compound",      "face",       "edge",
      "shape", "compsolid", "brep",  "advanced_face", "edge_curve", "manifold_solid_brep"};
  const std::string lower = in_lower_case(name);
  return lower.empty() || lower.starts_with("open cascade") || lower.starts_with("=>") ||
         lower.find_first_not_of("0123456789# ") == std::string::npos ||
         std::ranges::find(kPlaceholders, lower) != kPlaceholders.end();
}

std::string meaningful(const std::string& text) {
  const std::string name = trimmed(text);
  return is_placeholder(name) ? "" : name;
}

std::string to_utf8(const TCollection_ExtendedString& text) {
  std::string utf8(static_cast<std::size_t>(text.LengthOfCString()), '\0');
  Standard_PCharacter at = utf8.data();
  text.ToUTF8CString(at);
  return utf8;
}

/// Of an XDE document: what the labels of parts and of their faces say.
class LabelReader {
 public:
  LabelReader(const Handle(TDocStd_Document) & document, Document& result)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colors_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
        layers_(XCAFDoc_DocumentTool::LayerTool(document->Main())),
        result_(result) {}

  void run() {
    TDF_LabelSequence labels;
    shapes_->GetShapes(labels);
    for (const TDF_Label& label : labels)
      if (XCAFDoc_ShapeTool::IsSimpleShape(label)) read_part(label);
  }

 private:
  /// The part's name, colour and layer count for what it holds, unless that has its own.
  void read_part(const TDF_Label& label) {
    const TopoDS_Shape part = XCAFDoc_ShapeTool::GetShape(label);
    TDF_LabelSequence pieces;
    XCAFDoc_ShapeTool::GetSubShapes(label, pieces);
    for (const TDF_Label& piece : pieces) {
      const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(piece);
      if (!shape.IsNull()) complete(result_.info[shape.TShape()], own_info(piece));
    }
    name_solids(part, own_info(label).name);
    for (const TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_SHELL})
      for (TopExp_Explorer it(part, kind); it.More(); it.Next())
        pass_down(it.Current(), result_.info_of(it.Current()));
    pass_down(part, own_info(label));
  }

  /// A part of one body has the name that people know; of several, bodies keep their own.
  void name_solids(const TopoDS_Shape& part, const std::string& name) {
    std::vector<PartInfo*> solids;
    for (TopExp_Explorer it(part, TopAbs_SOLID); it.More(); it.Next())
      solids.push_back(&result_.info[it.Current().TShape()]);
    if (name.empty()) return;
    for (PartInfo* solid : solids)
      if (solids.size() == 1 || solid->name.empty()) solid->name = name;
  }

  void pass_down(const TopoDS_Shape& whole, const PartInfo& info) {
    for (TopExp_Explorer it(whole, TopAbs_FACE); it.More(); it.Next())
      complete(result_.info[it.Current().TShape()], {"", info.layer, info.color});
  }

  static void complete(PartInfo& info, const PartInfo& by) {
    if (info.name.empty()) info.name = by.name;
    if (info.layer.empty()) info.layer = by.layer;
    if (!info.color) info.color = by.color;
  }

  PartInfo own_info(const TDF_Label& label) const {
    PartInfo info;
    Handle(TDataStd_Name) name;
    if (label.FindAttribute(TDataStd_Name::GetID(), name))
      info.name = meaningful(to_utf8(name->Get()));
    info.layer = layer_of(label);
    Quantity_Color color;
    for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
      if (!info.color && colors_->GetColor(label, type, color)) info.color = to_bytes(color);
    return info;
  }

  std::string layer_of(const TDF_Label& label) const {
    Handle(TColStd_HSequenceOfExtendedString) names = new TColStd_HSequenceOfExtendedString;
    if (!layers_->GetLayers(label, names) || names->IsEmpty()) return "";
    return trimmed(to_utf8(names->First()));
  }

  static CadColor to_bytes(const Quantity_Color& color) {
    std::array<double, 3> rgb;
    color.Values(rgb[0], rgb[1], rgb[2], Quantity_TOC_sRGB);
    CadColor bytes;
    for (std::size_t k = 0; k < 3; ++k)
      bytes[k] = static_cast<std::uint8_t>(std::clamp(rgb[k], 0.0, 1.0) * 255 + 0.5);
    return bytes;
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colors_;
  Handle(XCAFDoc_LayerTool) layers_;
  Document& result_;
};

/// Everything in the document, placed.
TopoDS_Shape whole_of(const Handle(TDocStd_Document) & document) {
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  TDF_LabelSequence free;
  shapes->GetFreeShapes(free);
  BRep_Builder builder;
  TopoDS_Compound whole;
  builder.MakeCompound(whole);
  for (const TDF_Label& label : free) builder.Add(whole, XCAFDoc_ShapeTool::GetShape(label));
  return whole;
}

/// Of bodies, faces and edges: the names of STEP's representation items.
void read_item_names(const Handle(XSControl_WorkSession) & session, Document& result) {
  const auto process = session->TransferReader()->TransientProcess();
  const auto model = session->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto item = Handle(StepRepr_RepresentationItem)::DownCast(model->Value(i));
    if (item.IsNull() || item->Name().IsNull()) continue;
    const std::string name = meaningful(item->Name()->ToCString());
    if (name.empty()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, item);
    if (!shape.IsNull()) result.info[shape.TShape()].name = name;
  }
}

std::string first_unit(const STEPControl_Reader& given) {
  auto& reader = const_cast<STEPControl_Reader&>(given);  // what it tells changes nothing
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  return lengths.IsEmpty() ? "" : in_lower_case(lengths.First().ToCString());
}

/// A document that is closed whatever happens.
class OpenDocument {
 public:
  OpenDocument() { XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_); }
  ~OpenDocument() { XCAFApp_Application::GetApplication()->Close(document_); }
  OpenDocument(const OpenDocument&) = delete;
  OpenDocument& operator=(const OpenDocument&) = delete;
  const Handle(TDocStd_Document) & get() const { return document_; }

 private:
  Handle(TDocStd_Document) document_;
};

void read_step(const std::filesystem::path& path, const std::string& bytes, Document& result) {
  result.format = "STEP";
  constexpr std::size_t kTail = 4096;  // comments may follow the end
  const std::size_t from = bytes.size() > kTail ? bytes.size() - kTail : 0;
  if (bytes.find("END-ISO-10303-21", from) == std::string::npos)
    refuse("the file ends before its last line, END-ISO-10303-21; copy or export it again");
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    refuse("the content is not valid STEP; export it again (AP203, AP214 or AP242)");
  OpenDocument document;
  Handle(TDocStd_Document) target = document.get();
  if (!reader.Transfer(target))
    refuse("the file holds no shape; export the solid itself, not a drawing or an empty part");
  result.unit = first_unit(reader.Reader());
  read_item_names(reader.Reader().WS(), result);
  LabelReader(target, result).run();
  result.shape = whole_of(target);
}

void read_iges(const std::filesystem::path& path, Document& result) {
  result.format = "IGES";
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  IGESCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    refuse("the content is not valid IGES; export it again, or as STEP");
  OpenDocument document;
  Handle(TDocStd_Document) target = document.get();
  if (!reader.Transfer(target))
    refuse("the file holds no surface; export the solid itself, best as STEP");
  if (const auto unit = reader.IGESModel()->GlobalSection().UnitName(); !unit.IsNull())
    result.unit = in_lower_case(unit->ToCString());
  LabelReader(target, result).run();
  result.shape = whole_of(target);
}

void read_brep(const std::filesystem::path& path, Document& result) {
  result.format = "BREP";
  BRep_Builder builder;
  if (!BRepTools::Read(result.shape, path.c_str(), builder) || result.shape.IsNull())
    refuse("the content is not valid BREP; write it again, or as STEP");
}

}  // namespace

Document read_document(const std::filesystem::path& path) {
  Document result;
  const std::string bytes = read_bytes(path);
  const std::string head = bytes.substr(0, 4096);
  const std::string extension = in_lower_case(path.extension().string());
  if (bytes.empty()) refuse("the file is empty; export it again");
  if (head.find("ISO-10303-21") != std::string::npos)
    read_step(path, bytes, result);
  else if (head.find("DBRep_DrawableShape") != std::string::npos ||
           head.find("CASCADE Topology") != std::string::npos)
    read_brep(path, result);
  else if (extension == ".igs" || extension == ".iges")
    read_iges(path, result);
  else
    refuse(
        "the content is that of no CAD file; give STEP (its first line is ISO-10303-21;), IGES "
        "or BREP");
  return result;
}

}  // namespace hexwright::cad
