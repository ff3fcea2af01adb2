#include <snug/cad/write_step.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepGProp.hxx>
#include <BRepGProp_Face.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace snug {
namespace {
using cad::SplineFace;

/// The faces of a STEP file by the names of their entities, as OpenCASCADE reads them, in mm.
std::map<std::string, TopoDS_Face> read_faces(const std::string &path)
{
  STEPControl_Reader reader;
  EXPECT_EQ(reader.ReadFile(path.c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  std::map<std::string, TopoDS_Face> result;
  for (TopExp_Explorer faces(reader.OneShape(), TopAbs_FACE); faces.More(); faces.Next())
    {
      const auto item = Handle(StepRepr_RepresentationItem)::DownCast(
        reader.WS()->TransferReader()->EntityFromShapeResult(faces.Current(), 1));
      if (!item.IsNull())
        result[item->Name()->ToCString()] = TopoDS::Face(faces.Current());
    }
  return result;
}

/// A STEP file of faces as OpenCASCADE reads it, and its text without blanks.
struct Written
{
  std::map<std::string, TopoDS_Face> faces;
  std::string                        text;
};

Written write_and_read(const std::vector<SplineFace> &faces, const std::string &unit)
{
  const std::string path = std::filesystem::temp_directory_path() /
                           ("snug-write-step-" + std::to_string(getpid()) + ".step");
  cad::write_step(path, unit, faces);
  Written       result{read_faces(path), ""};
  std::ifstream file(path);
  for (std::string word; file >> word;)
    result.text += word;
  std::filesystem::remove(path);
  return result;
}

std::map<std::string, TopoDS_Face> written(const std::vector<SplineFace> &faces)
{
  return write_and_read(faces, "mm").faces;
}

/// Return what the entity with this number is in the text of a STEP file.
std::string entity(const std::string &text, const std::string &number)
{
  const std::string head  = ";#" + number + "=";
  const auto        found = text.find(head);
  EXPECT_NE(found, std::string::npos) << number;
  if (found == std::string::npos)
    return "";
  const auto begin = found + head.size();
  return text.substr(begin, text.find(';', begin) - begin);
}

/// Return the unit of length in the text of a STEP file. Numbers of other entities are replaced by
/// these entities.
std::string unit_in(const std::string &text)
{
  std::smatch found;
  EXPECT_TRUE(
    std::regex_search(text, found, std::regex(R"(GLOBAL_UNIT_ASSIGNED_CONTEXT\(\(#(\d+),)")));
  std::string      unit = entity(text, found[1]);
  const std::regex reference(R"(#(\d+))");
  while (std::regex_search(unit, found, reference))
    unit = found.prefix().str() + entity(text, found[1]) + found.suffix().str();
  return unit;
}

/// Return the maximum x of the points in the text of a STEP file.
double maximum_x(const std::string &text)
{
  const std::regex point(R"(CARTESIAN_POINT\('',\(([^,)]+),[^,)]+,[^,)]+\)\))");
  double           result = 0.;
  for (std::sregex_iterator at(text.begin(), text.end(), point); at != std::sregex_iterator(); ++at)
    result = std::max(result, std::stod((*at)[1]));
  return result;
}

double area_of(const TopoDS_Face &face)
{
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.Mass();
}

/// Spans 0, 1, 2.5, 4 of clamped cubic splines.
const cad::SplineSpans open = {{0., 1., 2.5, 4.}, false};

/// The control points of the function s of the spans above.
const std::vector<double> greville = {0., 1. / 3, 3.5 / 3, 7.5 / 3, 10.5 / 3, 4.};

/// A bilinear face z = 0.1 s t over [0,4]^2, shifted by 10 along x.
SplineFace bilinear(const std::string &name)
{
  SplineFace face;
  face.name   = name;
  face.degree = 3;
  face.axes   = {open, open};
  for (const double t : greville)
    for (const double s : greville)
      face.points.emplace_back(10. + s, t, 0.1 * s * t);
  return face;
}

/// The control points of a closed curve about the origin.
SplineFace closed_curve(const std::string &name, const unsigned int n)
{
  SplineFace face;
  face.name   = name;
  face.degree = 3;
  face.axes   = {{{}, true}};
  for (unsigned int i = 0; i <= n; ++i)
    face.axes[0].breaks.push_back(double(i) / n);
  for (unsigned int i = 0; i < n; ++i)
    face.points.emplace_back(3. * std::cos(2. * M_PI * i / n), 3. * std::sin(2. * M_PI * i / n),
                             0.);
  return face;
}

TEST(WriteStep, FacesAreReadBackWithTheirNames)
{
  auto turned      = bilinear("part.turned");
  turned.reversed  = true;
  const auto faces = written({bilinear("part.crown"), turned});
  ASSERT_EQ(faces.size(), 2u);
  for (const auto &[name, face] : faces)
    {
      const BRepAdaptor_Surface surface(face);
      double                    lower_s, upper_s, lower_t, upper_t;
      BRepGProp_Face            oriented(face);
      oriented.Bounds(lower_s, upper_s, lower_t, upper_t);
      EXPECT_NEAR(upper_s - lower_s, 4., 1e-9);
      for (const double s : {0.3, 1.7, 3.9})
        for (const double t : {0.2, 2.6})
          {
            const gp_Pnt x = surface.Value(s, t);
            EXPECT_NEAR(x.X(), 10. + s, 1e-9);
            EXPECT_NEAR(x.Y(), t, 1e-9);
            EXPECT_NEAR(x.Z(), 0.1 * s * t, 1e-9);
            gp_Pnt at;
            gp_Vec normal;
            oriented.Normal(s, t, at, normal);
            EXPECT_EQ(normal.Z() > 0., name == "part.crown") << name;
          }
    }
}

/// Numbers are not converted: read in mm, a file in inches is larger by 25.4.
TEST(WriteStep, NumbersHaveTheUnitOfTheScene)
{
  for (const auto &[unit, factor] : std::map<std::string, double>{
         {"mm", 1.}, {"m", 1000.}, {"in", 25.4}, {"um", 1e-3}, {"parsec", 1.}})
    {
      const auto                file = write_and_read({bilinear("part.crown")}, unit);
      const BRepAdaptor_Surface surface(file.faces.at("part.crown"));
      const gp_Pnt              x = surface.Value(surface.LastUParameter(), 0.);
      EXPECT_NEAR(x.X(), 14. * factor, 1e-9 * factor) << unit;
    }
  EXPECT_FALSE(cad::is_step_unit("parsec"));
  EXPECT_TRUE(cad::is_step_unit("in"));
  EXPECT_STREQ(Interface_Static::CVal("xstep.cascade.unit"), "MM");
}

/// The text names the unit of the scene, and has the numbers of the scene.
TEST(WriteStep, TextNamesTheUnitOfTheScene)
{
  const auto metric = [](const std::string &prefix) {
    return "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(" + prefix + ",.METRE.))";
  };
  const auto converted = [&metric](const std::string &name, const std::string &number) {
    return "(CONVERSION_BASED_UNIT('" + name + "',LENGTH_MEASURE_WITH_UNIT(" + number + "," +
           metric(".MILLI.") +
           "))LENGTH_UNIT()NAMED_UNIT(DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)))";
  };
  for (const auto &[unit, expected] :
       std::map<std::string, std::string>{{"mm", metric(".MILLI.")},
                                          {"m", metric("$")},
                                          {"cm", metric(".CENTI.")},
                                          {"um", metric(".MICRO.")},
                                          {"km", metric(".KILO.")},
                                          {"in", converted("INCH", "25.4")},
                                          {"ft", converted("FOOT", "304.8")},
                                          {"parsec", metric(".MILLI.")}})
    {
      const auto text = write_and_read({bilinear("part.crown")}, unit).text;
      EXPECT_EQ(unit_in(text), expected) << unit;
      EXPECT_EQ(maximum_x(text), 14.) << unit;
    }
}

/// A closed curve swept along z is a tube, whose length is that of the polygon of fine steps.
TEST(WriteStep, ClosedCurvesAreSweptToTubes)
{
  auto curve      = closed_curve("ring.outer", 16);
  curve.sweep     = SplineFace::Sweep::extruded;
  curve.direction = {0., 0., 1.};
  curve.extent    = 2.;
  SplineFace tube = closed_curve("tube.outer", 16);
  tube.axes.push_back(open);
  tube.points.clear();
  for (const double t : greville)
    for (const auto &point : curve.points)
      tube.points.emplace_back(point[0], point[1], t / 2.);
  const auto faces = written({curve, tube});
  // The uniform cubic spline through control points on a circle is a circle of this radius up to
  // 1e-5.
  const double radius = 3. * (2. + std::cos(2. * M_PI / 16)) / 3.;
  for (const auto &name : {"ring.outer", "tube.outer"})
    {
      // The quadrature of OpenCASCADE is good to 1e-4.
      EXPECT_NEAR(area_of(faces.at(name)), 2. * 2. * M_PI * radius, 4e-3) << name;
      // Function 1 is the largest at s = 0.
      const gp_Pnt first = BRepAdaptor_Surface(faces.at(name)).Value(0., 0.);
      EXPECT_NEAR(first.X(), radius * std::cos(2. * M_PI / 16), 1e-9) << name;
      EXPECT_NEAR(first.Y(), radius * std::sin(2. * M_PI / 16), 1e-9) << name;
    }
}

/// A full cone, a sixth of it, and the half of this sixth with 0 < s < 2 within a loop.
TEST(WriteStep, RevolvedCurvesGiveSurfacesOfRevolution)
{
  SplineFace cone;
  cone.name   = "shaft.cone";
  cone.degree = 3;
  cone.axes   = {open};
  for (const double s : greville)
    cone.points.emplace_back(8. + 0.5 * s, s, 0.);
  cone.sweep      = SplineFace::Sweep::revolved;
  cone.centre     = {7., 0., 0.};
  cone.direction  = {0., 1., 0.};
  cone.extent     = 2. * M_PI;
  const auto part = [](const double r, const double s) {
    return M_PI * (1. + r) * std::hypot(s, 0.5 * s);
  };
  EXPECT_NEAR(area_of(written({cone}).at("shaft.cone")), part(3., 4.), 1e-6);
  cone.extent     = M_PI / 3.;
  const auto face = written({cone}).at("shaft.cone");
  EXPECT_NEAR(area_of(face), part(3., 4.) / 6., 1e-6);
  // A rotation about y turns x to -z.
  const gp_Pnt last = BRepAdaptor_Surface(face).Value(M_PI / 3., 0.);
  EXPECT_NEAR(last.X(), 7. + std::cos(M_PI / 3.), 1e-9);
  EXPECT_NEAR(last.Z(), -std::sin(M_PI / 3.), 1e-9);
  const dealii::Point<2> a(0., 0.), b(cone.extent, 0.), c(cone.extent, 2.), d(0., 2.);
  cone.loops = {{{a, b}, {b, c}, {c, d}, {d, a}}};
  EXPECT_NEAR(area_of(written({cone}).at("shaft.cone")), part(2., 2.) / 6., 1e-6);
}

TEST(WriteStep, LoopsTrimFaces)
{
  auto face = bilinear("part.trimmed");
  for (auto &x : face.points)
    x[2] = 0.;
  const auto circle = [](const double x, const double radius, const bool left) {
    std::vector<dealii::Point<2>> points;
    for (unsigned int k = 0; k <= 32; ++k)
      {
        const double angle = 2. * M_PI * (k % 32) / 32 * (left ? 1. : -1.);
        points.emplace_back(x + radius * std::cos(angle), 2. + radius * std::sin(angle));
      }
    return points;
  };
  face.loops = {{circle(2., 1.5, true)}, {circle(2.2, 0.5, false)}};
  EXPECT_NEAR(area_of(written({face}).at("part.trimmed")), M_PI * (1.5 * 1.5 - 0.25), 1e-3);
  // a half disc with two corners
  auto       half = circle(2., 1.5, true);
  const auto arc  = std::vector<dealii::Point<2>>(half.begin(), half.begin() + 17);
  face.loops      = {{arc, {arc.back(), arc.front()}}};
  EXPECT_NEAR(area_of(written({face}).at("part.trimmed")), 0.5 * M_PI * 1.5 * 1.5, 1e-3);
}

TEST(WriteStep, ThrowsWhereItCannotWrite)
{
  EXPECT_THROW(cad::write_step("/nowhere/profile.step", "mm", {bilinear("part.crown")}),
               std::runtime_error);
}
} // namespace
} // namespace snug
