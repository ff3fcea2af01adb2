#include <snug/cad/step_shapes.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_AdvancedFace.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <UnitsMethods.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax1.hxx>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>

#include <map>
#include <stdexcept>

namespace snug::cad {
namespace {
/// Names of units of length in STEP files, as OpenCASCADE names them.
const std::map<std::string, std::string> &step_units()
{
  static const std::map<std::string, std::string> units = {{"mm", "MM"},   {"m", "M"},
                                                           {"cm", "CM"},   {"um", "UM"},
                                                           {"in", "INCH"}, {"ft", "FT"},
                                                           {"km", "KM"}};
  return units;
}

/// This class sets a parameter of OpenCASCADE for the time of its life.
class StaticValue
{
public:
  StaticValue(const char *name, const std::string &value)
    : name(name), before(Interface_Static::CVal(name))
  {
    Interface_Static::SetCVal(name, value.c_str());
  }
  ~StaticValue() { Interface_Static::SetCVal(name, before.c_str()); }

  StaticValue(const StaticValue &)            = delete;
  StaticValue &operator=(const StaticValue &) = delete;

private:
  const char       *name;
  const std::string before;
};

/// Knots, multiplicities and the control points along one axis of a spline that is not periodic.
struct Knots
{
  TColStd_Array1OfReal    values;
  TColStd_Array1OfInteger multiplicities;
  int                     n_points;

  /// Closed splines are continued by a period at both ends: the splines are not clamped there.
  Knots(const SplineSpans &spans, const int degree)
    : values(1, spans.breaks.size() + (spans.closed ? 2 * degree : 0))
    , multiplicities(1, values.Size())
    , n_points(spans.breaks.size() - 1 + degree)
  {
    const int    n = spans.breaks.size() - 1, offset = spans.closed ? degree : 0;
    const double period = spans.breaks.back() - spans.breaks.front();
    for (int k = 1; k <= values.Size(); ++k)
      {
        const int i       = k - 1 - offset;
        const int turns   = i < 0 ? -1 : i > n ? 1 : 0;
        values(k)         = spans.breaks[i - turns * n] + turns * period;
        multiplicities(k) = !spans.closed && (k == 1 || k == values.Size()) ? degree + 1 : 1;
      }
  }
};

gp_Pnt point(const dealii::Point<3> &x)
{
  return {x[0], x[1], x[2]};
}

Handle(Geom_BSplineCurve) curve_of(const SplineFace &face)
{
  const auto        &spans = face.axes[0];
  const Knots        knots(spans, face.degree);
  TColgp_Array1OfPnt poles(1, knots.n_points);
  for (int i = 0; i < knots.n_points; ++i)
    poles(i + 1) = point(face.points[i % face.points.size()]);
  Handle(Geom_BSplineCurve) curve =
    new Geom_BSplineCurve(poles, knots.values, knots.multiplicities, face.degree);
  if (spans.closed)
    curve->Segment(spans.breaks.front(), spans.breaks.back());
  return curve;
}

/// Return the curve of parameters through the points of a smooth piece. A piece that ends where it
/// begins is a periodic curve.
Handle(Geom2d_BSplineCurve) curve_through(const std::vector<dealii::Point<2>> &points)
{
  const bool closed                   = points.front().distance(points.back()) == 0.;
  const int  n                        = points.size() - (closed ? 1 : 0);
  Handle(TColgp_HArray1OfPnt2d) array = new TColgp_HArray1OfPnt2d(1, n);
  for (int i = 0; i < n; ++i)
    array->SetValue(i + 1, gp_Pnt2d(points[i][0], points[i][1]));
  Geom2dAPI_Interpolate through(array, closed, 1e-12);
  through.Perform();
  return through.Curve();
}

/// Return the surface of a face, in the ranges of its parameters.
Handle(Geom_Surface) whole_surface(const SplineFace &face)
{
  if (face.sweep == SplineFace::Sweep::none)
    return surface_of(face);
  const gp_Dir direction(face.direction[0], face.direction[1], face.direction[2]);
  const auto   curve = curve_of(face);
  const double first = curve->FirstParameter(), last = curve->LastParameter();
  if (face.sweep == SplineFace::Sweep::extruded)
    return new Geom_RectangularTrimmedSurface(new Geom_SurfaceOfLinearExtrusion(curve, direction),
                                              first, last, 0., face.extent);
  Handle(Geom_Surface) surface =
    new Geom_SurfaceOfRevolution(curve, gp_Ax1(point(face.centre), direction));
  if (face.extent > (1. - 1e-9) * 2. * M_PI)
    return surface;
  return new Geom_RectangularTrimmedSurface(surface, 0., face.extent, first, last);
}

/// Return the face within its loops. The curves of its edges deviate from the curves of parameters
/// by at most a millionth of the ranges of the parameters.
TopoDS_Face trimmed(const SplineFace &face, const Handle(Geom_Surface) & surface)
{
  double ranges = 0.;
  for (const auto &axis : face.axes)
    ranges += axis.breaks.back() - axis.breaks.front();
  BRepBuilderAPI_MakeFace make;
  for (unsigned int l = 0; l < face.loops.size(); ++l)
    {
      BRepBuilderAPI_MakeWire wire;
      for (const auto &piece : face.loops[l])
        {
          const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(curve_through(piece), surface);
          BRepLib::BuildCurve3d(edge, 1e-6 * ranges);
          wire.Add(edge);
        }
      if (!wire.IsDone())
        throw std::runtime_error("the edges of the face " + face.name + " do not form a wire");
      if (l == 0)
        make = BRepBuilderAPI_MakeFace(surface, wire.Wire());
      else
        make.Add(wire.Wire());
    }
  return make.Face();
}

TopoDS_Face face_of(const SplineFace &face)
{
  const auto  surface = whole_surface(face);
  TopoDS_Face result =
    face.loops.empty() ? BRepBuilderAPI_MakeFace(surface, 1e-7).Face() : trimmed(face, surface);
  if (face.reversed)
    result.Reverse();
  return result;
}

/// Set the names of the entities of faces, which most programs take as the names of the faces. The
/// entities have the order of the faces, while the shapes of the faces may be replaced by copies.
void set_names(const Handle(Interface_InterfaceModel) & model,
               const std::vector<std::string> &names)
{
  auto name = names.begin();
  for (int e = 1; e <= model->NbEntities() && name != names.end(); ++e)
    if (const auto face = Handle(StepShape_AdvancedFace)::DownCast(model->Value(e)); !face.IsNull())
      face->SetName(new TCollection_HAsciiString((name++)->c_str()));
}

void write(const std::string              &path,
           const std::vector<NamedShape>  &products,
           const std::vector<std::string> &faces)
{
  // Messages of OpenCASCADE would go to the log.
  Message::DefaultMessenger()->ChangePrinters().Clear();
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  for (const auto &[shape, name] : products)
    TDataStd_Name::Set(shapes->AddShape(shape, false), name.c_str());
  STEPCAFControl_Writer writer;
  // OpenCASCADE 7.8 reads "write.step.unit" for the unit that the file names, but converts the
  // numbers to the unit of the model, which would be mm.
  writer.ChangeWriter().Model()->SetWriteLengthUnit(
    UnitsMethods::GetLengthFactorValue(Interface_Static::IVal("write.step.unit")));
  bool done = writer.Transfer(document, STEPControl_AsIs);
  set_names(writer.ChangeWriter().Model(), faces);
  done = done && writer.Write(path.c_str()) == IFSelect_RetDone;
  XCAFApp_Application::GetApplication()->Close(document);
  if (!done)
    throw std::runtime_error("OpenCASCADE cannot write " + path);
}
} // namespace

Handle(Geom_BSplineSurface) surface_of(const SplineFace &face)
{
  const auto        &s = face.axes[0], &t = face.axes[1];
  const Knots        along_s(s, face.degree), along_t(t, face.degree);
  const int          n = s.closed ? along_s.n_points - face.degree : along_s.n_points;
  const int          m = face.points.size() / n;
  TColgp_Array2OfPnt poles(1, along_s.n_points, 1, along_t.n_points);
  for (int i = 0; i < along_s.n_points; ++i)
    for (int j = 0; j < along_t.n_points; ++j)
      poles(i + 1, j + 1) = point(face.points[i % n + n * (j % m)]);
  Handle(Geom_BSplineSurface) surface =
    new Geom_BSplineSurface(poles, along_s.values, along_t.values, along_s.multiplicities,
                            along_t.multiplicities, face.degree, face.degree);
  if (s.closed || t.closed)
    surface->Segment(s.breaks.front(), s.breaks.back(), t.breaks.front(), t.breaks.back());
  return surface;
}

bool is_step_unit(const std::string &unit)
{
  return step_units().count(unit) > 0;
}

void write_step(const std::string              &path,
                const std::string              &unit,
                const std::vector<NamedShape>  &products,
                const std::vector<std::string> &faces)
{
  const STEPCAFControl_Writer declares_the_parameters;
  const std::string           known = step_units().at(is_step_unit(unit) ? unit : "mm");
  // OpenCASCADE would convert numbers from the one unit to the other.
  const StaticValue of_numbers("xstep.cascade.unit", known), of_file("write.step.unit", known);
  write(path, products, faces);
}

void write_step(const std::string             &path,
                const std::string             &unit,
                const std::vector<SplineFace> &faces)
{
  try
    {
      std::vector<NamedShape>  made;
      std::vector<std::string> names;
      for (const auto &face : faces)
        {
          made.emplace_back(face_of(face), face.name);
          names.push_back(face.name);
        }
      write_step(path, unit, made, names);
    }
  catch (const Standard_Failure &failure)
    {
      throw std::runtime_error("OpenCASCADE cannot write " + path + ": " +
                               failure.GetMessageString());
    }
}
} // namespace snug::cad
