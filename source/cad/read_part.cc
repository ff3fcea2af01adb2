#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/cad/import_cad.h>
#include <snug/cad/part.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <StepShape_TopologicalRepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace snug::cad {
namespace {
/// A shape with all solids of a file, and the names of its faces or edges.
struct FileShape
{
  TopoDS_Shape               shape;
  TopTools_IndexedMapOfShape faces;
  std::vector<std::string>   names;
  /// solids and their names, those of products first
  std::vector<std::pair<TopoDS_Shape, std::string>> named_solids;
};

TopTools_IndexedMapOfShape map_of(const TopoDS_Shape &shape, const TopAbs_ShapeEnum kind)
{
  TopTools_IndexedMapOfShape result;
  TopExp::MapShapes(shape, kind, result);
  return result;
}

/// Return a name without the characters that separate items of lists in a parameter file. CAD
/// programs write NONE or blanks for no name, OpenCASCADE its own name.
std::string usable_name(std::string name)
{
  for (char &c : name)
    if (std::string(",:;=#\\+&.").find(c) != std::string::npos ||
        static_cast<unsigned char>(c) < ' ')
      c = '_';
  name = trim(name);
  return name == "NONE" || name.rfind("Open CASCADE STEP translator", 0) == 0 ? "" : name;
}

/// Add the names of products with one solid, and of solids.
void add_names_of_solids(const StepData_StepModel &model,
                         const Handle(Transfer_TransientProcess) & transfer,
                         FileShape &file)
{
  std::vector<std::pair<TopoDS_Shape, std::string>> others;
  for (int e = 1; e <= model.NbEntities(); ++e)
    {
      const auto         product = Handle(StepBasic_ProductDefinition)::DownCast(model.Value(e));
      const auto         brep    = Handle(StepShape_ManifoldSolidBrep)::DownCast(model.Value(e));
      const auto         name    = !product.IsNull() ? product->Formation()->OfProduct()->Name()
                                   : !brep.IsNull()  ? brep->Name()
                                                     : Handle(TCollection_HAsciiString)();
      const TopoDS_Shape own =
        name.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(transfer, model.Value(e));
      if (own.IsNull() || map_of(own, TopAbs_SOLID).Extent() != 1)
        continue;
      const auto usable = usable_name(name->ToCString());
      if (!usable.empty())
        (brep.IsNull() ? file.named_solids : others)
          .emplace_back(map_of(own, TopAbs_SOLID)(1), usable);
    }
  file.named_solids.insert(file.named_solids.end(), others.begin(), others.end());
}

/// @throws InputError without the path of the file, as the functions below.
FileShape read_step(const std::string &path, const TopAbs_ShapeEnum kind)
{
  std::string first;
  std::getline(std::ifstream(path), first);
  if (first.rfind("ISO-10303-21", 0) != 0)
    throw InputError("is not a STEP file, which begins with ISO-10303-21");
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    throw InputError("cannot be read as a STEP file");
  reader.TransferRoots();
  FileShape result;
  result.shape = reader.OneShape();
  result.faces = map_of(result.shape, kind);
  result.names.resize(result.faces.Extent());
  const auto model    = reader.StepModel();
  const auto transfer = reader.WS()->TransferReader()->TransientProcess();
  for (int e = 1; e <= model->NbEntities(); ++e)
    {
      const auto item = Handle(StepShape_TopologicalRepresentationItem)::DownCast(model->Value(e));
      if (item.IsNull() || item->Name().IsNull() || item->Name()->IsEmpty())
        continue;
      const TopoDS_Shape own = TransferBRep::ShapeResult(transfer, item);
      // Instances of a part in an assembly have the same face at other places.
      for (int f = 1; f <= result.faces.Extent() && !own.IsNull(); ++f)
        if (result.faces(f).IsPartner(own))
          result.names[f - 1] = usable_name(item->Name()->ToCString());
    }
  add_names_of_solids(*model, transfer, result);
  return result;
}

/// Return the shape of a file without names of faces.
TopoDS_Shape read_nameless(const std::string &path, const std::string &ending)
{
  TopoDS_Shape shape;
  if (ending == ".brep" || ending == ".brp")
    {
      if (!BRepTools::Read(shape, path.c_str(), BRep_Builder()) || shape.IsNull())
        throw InputError("cannot be read as a BREP file");
      return shape;
    }
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    throw InputError("cannot be read as an IGES file");
  reader.TransferRoots();
  return reader.OneShape();
}

FileShape read_file(const std::string &path, const TopAbs_ShapeEnum kind)
{
  // Messages of OpenCASCADE would go to the log.
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const std::string ending = ending_of(path);
  std::error_code   unused;
  if (!std::filesystem::is_regular_file(path, unused) || !std::ifstream(path))
    throw InputError("cannot be read: there is no such file, or it is not readable");
  if (ending == ".step" || ending == ".stp")
    return read_step(path, kind);
  if (!is_cad_file(path))
    throw InputError("must be a CAD file that ends with .step, .stp, .iges, .igs, .brep or "
                     ".brp; mesh files need 'Mesh = file'");
  FileShape result;
  result.shape = read_nameless(path, ending);
  return result;
}

Bnd_Box box_of(const TopoDS_Shape &shape)
{
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  return box;
}

std::string box_text(const TopoDS_Shape &shape)
{
  double lower[3], upper[3];
  box_of(shape).Get(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
  std::ostringstream text;
  text.precision(4);
  for (unsigned int d = 0; d < 3; ++d)
    text << (d == 0 ? "" : ", ") << "xyz"[d] << ' ' << lower[d] << " to " << upper[d];
  return text.str();
}

/// Return the solid that faces enclose if gaps up to @p tolerance are closed; null: none.
TopoDS_Shape sewn(const TopoDS_Shape &faces, const double tolerance)
{
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.Add(faces);
  sewing.Perform();
  const TopTools_IndexedMapOfShape shells = map_of(sewing.SewedShape(), TopAbs_SHELL);
  if (shells.Extent() != 1 || !BRep_Tool::IsClosed(shells(1)))
    return {};
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells(1)));
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

/// Return the solid that the faces of a file enclose. @throws InputError if they do not enclose
/// one, with the tolerance with which they do.
TopoDS_Shape sewn(const TopoDS_Shape &faces)
{
  const double tolerance = 1e-5 * std::sqrt(box_of(faces).SquareExtent());
  const auto   solid     = sewn(faces, tolerance);
  if (!solid.IsNull())
    return solid;
  const std::string head = "contains no solid, and its faces do not enclose one";
  for (const double factor : {10., 100., 1000.})
    if (!sewn(faces, factor * tolerance).IsNull())
      {
        std::ostringstream text;
        text << std::setprecision(2) << head << " within the tolerance of " << tolerance
             << "; they enclose one if they are sewn with the tolerance of " << factor * tolerance
             << " in the CAD program";
        throw InputError(text.str());
      }
  throw InputError(head);
}

/// Return the solid, or in 2D the plane face, with the number @p wanted of the entry Solid.
TopoDS_Shape chosen(const TopTools_IndexedMapOfShape &all,
                    const unsigned int                wanted,
                    const std::string                &path,
                    const std::string                &what)
{
  const unsigned int n = all.Extent();
  if (wanted > n)
    throw bad_entry("Solid", to_text(wanted),
                    "must be at most " + std::to_string(n) + ", the number of " + what +
                      "s in the CAD file");
  if (wanted > 0 || n == 1)
    return all(std::max(1u, wanted));
  std::string list;
  for (unsigned int k = 1; k <= std::min(n, 9u); ++k)
    list += (k == 1 ? "" : "; ") + std::to_string(k) + ": " + box_text(all(k));
  throw bad_entry("Solid", "0",
                  "must be the number of one " + what + ", because " + path + " contains " +
                    std::to_string(n) + ": " + list + (n > 9 ? "; ..." : ""));
}

void require_in_plane(const TopoDS_Shape &shape, const std::string &path)
{
  const GeomLib_IsPlanarSurface test(BRep_Tool::Surface(TopoDS::Face(shape)), 1e-7);
  if (!test.IsPlanar() || std::abs(test.Plan().Axis().Direction().Z()) < 1. - 1e-12)
    throw bad_entry("File", path,
                    "must contain a face in the xy plane for a model with Dimension = 2");
}

/// Return the solids of a file, or in 2D its faces.
TopTools_IndexedMapOfShape bodies_of(const FileShape &file, const unsigned int dim)
{
  TopTools_IndexedMapOfShape solids = map_of(file.shape, TopAbs_SOLID);
  const auto                 faces  = map_of(file.shape, TopAbs_FACE);
  if (faces.IsEmpty())
    throw InputError("contains no face");
  if (dim == 2 && !solids.IsEmpty())
    throw InputError("contains a solid; a model with Dimension = 2 needs a plane face");
  if (dim == 2)
    return faces;
  if (solids.IsEmpty())
    solids.Add(sewn(file.shape));
  return solids;
}

Part part_of(const TopoDS_Shape &shape, const FileShape &file, const unsigned int dim)
{
  Part part;
  part.shape = shape;
  part.dim   = dim;
  part.size  = std::sqrt(box_of(shape).SquareExtent());
  // Faces that continue each other without an edge are marked, see describe_faces().
  BRepLib::EncodeRegularity(part.shape, M_PI / 360.);
  for (const auto &face : part.faces())
    {
      const int f = file.faces.FindIndex(face);
      part.names.push_back(f == 0 ? "" : file.names[f - 1]);
    }
  for (const auto &[solid, name] : file.named_solids)
    if (part.name.empty() && solid.IsPartner(shape))
      part.name = name;
  return part;
}
} // namespace

std::string ending_of(const std::string &path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](const unsigned char c) { return std::tolower(c); });
  return ending;
}

std::vector<TopoDS_Shape> Part::faces() const
{
  const auto                map = map_of(shape, dim == 2 ? TopAbs_EDGE : TopAbs_FACE);
  std::vector<TopoDS_Shape> result;
  for (int f = 1; f <= map.Extent(); ++f)
    result.push_back(map(f));
  return result;
}

Part read_part(const std::string &path, const unsigned int solid, const unsigned int dim)
{
  FileShape                  file;
  TopTools_IndexedMapOfShape bodies;
  try
    {
      file   = read_file(path, dim == 2 ? TopAbs_EDGE : TopAbs_FACE);
      bodies = bodies_of(file, dim);
    }
  catch (const InputError &error)
    {
      throw bad_entry("File", path, error.what());
    }
  const auto shape = chosen(bodies, solid, path, dim == 2 ? "face" : "solid");
  if (dim == 2)
    require_in_plane(shape, path);
  return part_of(shape, file, dim);
}

std::vector<Part> read_solids(const std::string &path)
{
  const auto        file   = read_file(path, TopAbs_FACE);
  const auto        bodies = bodies_of(file, 3);
  std::vector<Part> result;
  for (int k = 1; k <= bodies.Extent(); ++k)
    result.push_back(part_of(bodies(k), file, 3));
  return result;
}

std::string to_brep(const TopoDS_Shape &shape)
{
  std::ostringstream text;
  BRepTools::Write(shape, text);
  return text.str();
}

TopoDS_Shape from_brep(const std::string &text)
{
  TopoDS_Shape       result;
  std::istringstream in(text);
  BRepTools::Read(result, in, BRep_Builder());
  return result;
}
} // namespace snug::cad
