#include <snug/geometry/fitted_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace snug;
using Surface = geometry::KnownSurface<3>;
using Sample  = geometry::SurfaceSample<3>;
using Kind    = Surface::Kind;
using dealii::Point;
using Vector = dealii::Tensor<1, 3>;

namespace {
/// A patch of a surface of revolution with a random position, axis and size.
class RandomPatch
{
public:
  RandomPatch(const Kind kind, const unsigned int seed) : random(seed)
  {
    surface.kind   = kind;
    surface.centre = Point<3>(between(-5., 5.), between(-5., 5.), between(-5., 5.));
    frame[2]       = unit();
    frame[0]       = cross_product_3d(frame[2], unit());
    frame[0] /= frame[0].norm();
    frame[1]              = cross_product_3d(frame[2], frame[0]);
    surface.axis          = kind == Kind::sphere ? Vector() : frame[2];
    surface.radius        = kind == Kind::cone ? 0. : between(1., 3.);
    surface.tube          = kind == Kind::torus ? between(0.2, 0.8) : 0.;
    surface.angle         = kind == Kind::cone ? between(0.2, 1.2) : 0.;
    surface.encloses_body = seed % 2 == 0;
    const double to       = between(1., 3.);
    for (unsigned int i = 0; i < 8; ++i)
      for (unsigned int j = 0; j < 8; ++j)
        add(to * i / 7., j / 7.);
  }

  Surface surface;
  Sample  sample;

  double between(const double from, const double to)
  {
    return std::uniform_real_distribution<double>(from, to)(random);
  }

private:
  std::mt19937          random;
  std::array<Vector, 3> frame;

  Vector unit()
  {
    const Vector result({between(-1., 1.), between(-1., 1.), between(-1., 1.)});
    return result / result.norm();
  }

  /// Add the point at the angle @p phi about the axis and at @p v in [0,1] along the section, by
  /// the formulas of the surfaces.
  void add(const double phi, const double v)
  {
    const double theta = 0.4 + 1.8 * v;
    double       r = surface.radius, z = 2. * v, n_r = 1., n_z = 0.;
    if (surface.kind == Kind::sphere || surface.kind == Kind::torus)
      {
        const double tube = surface.kind == Kind::torus ? surface.tube : surface.radius;
        n_r               = std::sin(theta);
        n_z               = std::cos(theta);
        r                 = (surface.kind == Kind::torus ? surface.radius : 0.) + tube * n_r;
        z                 = tube * n_z;
      }
    else if (surface.kind == Kind::cone)
      {
        z   = 1. + v;
        r   = z * std::tan(surface.angle);
        n_r = std::cos(surface.angle);
        n_z = -std::sin(surface.angle);
      }
    const Vector out = std::cos(phi) * frame[0] + std::sin(phi) * frame[1];
    sample.points.push_back(surface.centre + r * out + z * frame[2]);
    sample.at.push_back(sample.points.back());
    sample.normals.push_back((surface.encloses_body ? 1. : -1.) * (n_r * out + n_z * frame[2]));
  }
};
} // namespace

TEST(RecognizedSurfaces, HaveThePositionAndSizeOfTheirPoints)
{
  for (const auto kind : {Kind::sphere, Kind::cylinder, Kind::cone, Kind::torus})
    for (unsigned int seed = 1; seed <= 20; ++seed)
      {
        SCOPED_TRACE("kind " + std::to_string(int(kind)) + ", seed " + std::to_string(seed));
        const RandomPatch patch(kind, seed);
        const auto       &given = patch.surface;
        const auto        found = geometry::recognized_surface(patch.sample, 1e-9);
        ASSERT_TRUE(found);
        ASSERT_EQ(found->kind, kind);
        EXPECT_EQ(found->encloses_body, given.encloses_body);
        EXPECT_NEAR(found->radius, given.radius, 1e-8);
        EXPECT_NEAR(found->tube, given.tube, 1e-8);
        EXPECT_NEAR(found->angle, given.angle, 1e-8);
        if (kind != Kind::sphere)
          {
            EXPECT_NEAR(std::abs(found->axis * given.axis), 1., 1e-12);
          }
        // The centre of a cylinder is any point of its axis.
        const Vector offset = found->centre - given.centre;
        EXPECT_NEAR(
          (kind == Kind::cylinder ? offset - (offset * given.axis) * given.axis : offset).norm(),
          0., 1e-7);
        for (unsigned int i = 0; i < patch.sample.at.size(); ++i)
          EXPECT_NEAR((found->normal(patch.sample.at[i]) - patch.sample.normals[i]).norm(), 0.,
                      1e-8);
      }
}

TEST(RecognizedSurfaces, ArePointsWithinTheTolerance)
{
  for (const auto kind : {Kind::sphere, Kind::cylinder, Kind::cone, Kind::torus})
    for (unsigned int seed = 1; seed <= 5; ++seed)
      {
        RandomPatch patch(kind, seed);
        for (unsigned int i = 0; i < patch.sample.points.size(); ++i)
          patch.sample.points[i] += patch.between(-1e-4, 1e-4) * patch.sample.normals[i];
        const auto loose = geometry::recognized_surface(patch.sample, 2e-4);
        ASSERT_TRUE(loose);
        EXPECT_LE(patch.sample.largest_distance(*loose), 2e-4);
        EXPECT_FALSE(geometry::recognized_surface(patch.sample, 1e-6));
      }
}

TEST(RecognizedSurfaces, ProjectionsAreTheClosestPoints)
{
  for (const auto kind : {Kind::sphere, Kind::cylinder, Kind::cone, Kind::torus})
    for (unsigned int seed = 1; seed <= 5; ++seed)
      {
        RandomPatch patch(kind, seed);
        for (unsigned int i = 0; i < patch.sample.points.size(); i += 5)
          {
            const double   height = patch.between(-0.1, 0.1);
            const Point<3> x      = patch.sample.points[i] + height * patch.sample.normals[i];
            EXPECT_NEAR(patch.surface.distance(x), height, 1e-13);
            EXPECT_NEAR(patch.surface.project(x).distance(patch.sample.points[i]), 0., 1e-13);
          }
      }
}

TEST(RecognizedSurfaces, PlacementsMoveThemWithTheirPoints)
{
  const double               angle = 0.7, scale = 2.5;
  const dealii::Tensor<2, 3> Q({{std::cos(angle), -std::sin(angle), 0.},
                                {std::sin(angle), std::cos(angle), 0.},
                                {0., 0., 1.}});
  const Vector               shift({1., -2., 3.});
  for (const auto kind : {Kind::sphere, Kind::cylinder, Kind::cone, Kind::torus})
    {
      const RandomPatch patch(kind, 7);
      const auto        placed = patch.surface.placed(scale, Q, shift);
      for (unsigned int i = 0; i < patch.sample.points.size(); ++i)
        {
          const Point<3> x(scale * (Q * patch.sample.points[i]) + shift);
          EXPECT_NEAR(placed.distance(x), 0., 1e-13);
          EXPECT_NEAR((placed.normal(x) - Q * patch.sample.normals[i]).norm(), 0., 1e-13);
        }
    }
}
