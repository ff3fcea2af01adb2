#include <snug/base/errors.h>
#include <snug/cad/moved_solid.h>
#include <snug/cad/part.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

namespace snug {
namespace {
using Vector = dealii::Tensor<1, 3>;
using Flat   = dealii::Tensor<1, 2>;

dealii::Tensor<2, 3> unit_matrix()
{
  return dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
}

/// Return the face at which a coordinate of all of four points of the domain is @p value.
unsigned int face_at(const cad::MovedSolid &solid,
                     const unsigned int     n,
                     const unsigned int     d,
                     const double           value)
{
  for (unsigned int f = 0; f < n; ++f)
    {
      const auto domain = solid.domain(f);
      bool       all    = true;
      for (const double s : {0.1, 0.9})
        for (const double t : {0.2, 0.7})
          {
            Flat at;
            at[0] = domain.lower[0] + s * (domain.upper[0] - domain.lower[0]);
            at[1] = domain.lower[1] + t * (domain.upper[1] - domain.lower[1]);
            all   = all && std::abs(solid.point(f, at)[d] - value) < 1e-12;
          }
      if (all)
        return f;
    }
  ADD_FAILURE() << "no face at " << value;
  return 0;
}

/// Return a surface whose control points at the Greville abscissae of n spans are points of a face
/// moved by @p move. This is exact for bilinear functions of the parameters.
cad::SplineFace moved_face(const cad::MovedSolid                       &solid,
                           const unsigned int                           f,
                           const unsigned int                           n,
                           const std::function<Vector(const Vector &)> &move)
{
  const auto                         domain = solid.domain(f);
  cad::SplineFace                    result;
  std::array<std::vector<double>, 2> greville;
  result.degree = 3;
  for (unsigned int a = 0; a < 2; ++a)
    {
      const double     length = domain.upper[a] - domain.lower[a];
      cad::SplineSpans spans{{}, domain.closed[a]};
      for (unsigned int i = 0; i <= n; ++i)
        spans.breaks.push_back(domain.lower[a] + length * i / n);
      const auto knot = [&](const int k) { return spans.breaks[std::clamp(k, 0, int(n))]; };
      for (int i = 0; i < int(spans.closed ? n : n + 3); ++i)
        greville[a].push_back(spans.closed ? domain.lower[a] + length * (i - 1.) / n
                                           : (knot(i - 2) + knot(i - 1) + knot(i)) / 3.);
      result.axes.push_back(spans);
    }
  for (const double v : greville[1])
    for (const double u : greville[0])
      {
        Flat at;
        at[0]        = u;
        at[1]        = v;
        const auto x = solid.point(f, at);
        result.points.push_back(x + move(x));
      }
  return result;
}

/// A solid as OpenCASCADE reads it from a STEP file.
struct Read
{
  TopoDS_Shape               shape;
  TopTools_IndexedMapOfShape faces;
  std::vector<std::string>   names;

  explicit Read(const std::string &path)
  {
    STEPControl_Reader reader;
    EXPECT_EQ(reader.ReadFile(path.c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    shape = reader.OneShape();
    std::filesystem::remove(path);
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    for (int f = 1; f <= faces.Extent(); ++f)
      {
        const auto item = Handle(StepRepr_RepresentationItem)::DownCast(
          reader.WS()->TransferReader()->EntityFromShapeResult(faces(f), 1));
        names.push_back(item.IsNull() ? "" : item->Name()->ToCString());
      }
    TopTools_IndexedMapOfShape solids, shells;
    TopExp::MapShapes(shape, TopAbs_SOLID, solids);
    TopExp::MapShapes(shape, TopAbs_SHELL, shells);
    EXPECT_EQ(solids.Extent(), 1);
    EXPECT_EQ(shells.Extent(), 1);
    EXPECT_TRUE(BRep_Tool::IsClosed(shells(1)));
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  }

  double volume() const
  {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    return properties.Mass();
  }

  /// Return the maximum of |distance(x)| at random points of the surface of the face that
  /// @p distance is smallest at.
  double deviation(const std::function<double(const gp_Pnt &)> &distance) const
  {
    double best = HUGE_VAL;
    for (int f = 1; f <= faces.Extent(); ++f)
      {
        std::mt19937                           random(3);
        std::uniform_real_distribution<double> uniform(0., 1.);
        const BRepAdaptor_Surface              surface(TopoDS::Face(faces(f)));
        double                                 most = 0.;
        for (unsigned int k = 0; k < 100; ++k)
          {
            const double s = uniform(random), t = uniform(random);
            most =
              std::max(most, std::abs(distance(surface.Value((1. - s) * surface.FirstUParameter() +
                                                               s * surface.LastUParameter(),
                                                             (1. - t) * surface.FirstVParameter() +
                                                               t * surface.LastVParameter()))));
          }
        best = std::min(best, most);
      }
    return best;
  }
};

std::string scratch_file()
{
  return std::filesystem::temp_directory_path() /
         ("snug-moved-solid-" + std::to_string(getpid()) + ".step");
}

/// The top of a box of 4 x 4 x 1 is raised by 0.1 x y / 16, so that its volume is 16 + 0.1 * 4 and
/// three of its vertices move. The box is placed: scaled by 2 and shifted along x.
TEST(MovedSolid, ABoxWithAMovedTopIsClosed)
{
  const cad::MovedSolid solid(cad::to_brep(BRepPrimAPI_MakeBox(2., 2., 0.5).Shape()), 2.,
                              unit_matrix(), {{10., 0., 0.}});
  const unsigned int    top  = face_at(solid, 6, 2, 1.);
  const auto            move = [](const Vector &x) {
    Vector result;
    result[2] = 0.1 * (x[0] - 10.) * x[1] / 16.;
    return result;
  };
  const auto               path = scratch_file();
  std::vector<std::string> names(6, "box.side");
  names[top] = "box.top";
  const double volume =
    solid.write(path, "mm", "box", names, {{top, moved_face(solid, top, 3, move)}}, 1e-6);
  EXPECT_NEAR(volume, 16.4, 1e-9);
  const Read read(path);
  EXPECT_EQ(read.faces.Extent(), 6);
  EXPECT_NEAR(read.volume(), 16.4, 1e-6);
  EXPECT_LT(read.deviation(
              [](const gp_Pnt &x) { return x.Z() - 1. - 0.1 * (x.X() - 10.) * x.Y() / 16.; }),
            1e-9);
}

/// The round face of a cylinder has a seam. Its radius grows from 3 to 3.3 along the axis.
TEST(MovedSolid, ACylinderWithASeamIsClosed)
{
  const cad::MovedSolid solid(cad::to_brep(BRepPrimAPI_MakeCylinder(3., 2.).Shape()), 1.,
                              unit_matrix(), {{0., 0., 0.}});
  unsigned int          round = 0;
  while (!solid.domain(round).closed[0])
    ++round;
  const auto grown = [](const Vector &x) { return 3. + 0.15 * x[2]; };
  // A uniform cubic spline through control points on a circle has a smaller radius.
  const unsigned int n      = 64;
  const double       factor = 3. / (2. + std::cos(2. * M_PI / n));
  const auto         move   = [&](const Vector &x) {
    Vector result = (factor * grown(x) / 3. - 1.) * x;
    result[2]     = 0.;
    return result;
  };
  const auto path = scratch_file();
  solid.write(path, "mm", "pin", std::vector<std::string>(3, "pin.side"),
              {{round, moved_face(solid, round, n, move)}}, 1e-5);
  const Read   read(path);
  const double a = 3., b = 3.3, volume = M_PI * 2. / 3. * (a * a + a * b + b * b);
  EXPECT_NEAR(read.volume(), volume, 1e-5 * volume);
  EXPECT_LT(read.deviation(
              [](const gp_Pnt &x) { return std::hypot(x.X(), x.Y()) - 3. - 0.15 * x.Z(); }),
            1e-6);
}

/// The top moves sideways, off the plane of a face that would have to move.
TEST(MovedSolid, NamesTheFaceThatAnEdgeLeaves)
{
  const cad::MovedSolid    solid(cad::to_brep(BRepPrimAPI_MakeBox(4., 4., 1.).Shape()), 1.,
                                 unit_matrix(), {{0., 0., 0.}});
  std::vector<std::string> names(6, "box.other");
  names[face_at(solid, 6, 0, 4.)] = "box.right";
  const unsigned int top          = face_at(solid, 6, 2, 1.);
  const auto         move         = [](const Vector &x) {
    Vector result;
    result[0] = 0.025 * x[0];
    return result;
  };
  try
    {
      solid.write(scratch_file(), "mm", "box", names, {{top, moved_face(solid, top, 2, move)}},
                  1e-6);
      ADD_FAILURE() << "no error";
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("box.right by 0.1"), std::string::npos)
        << error.what();
    }
  EXPECT_FALSE(std::filesystem::exists(scratch_file()));
}
} // namespace
} // namespace snug
