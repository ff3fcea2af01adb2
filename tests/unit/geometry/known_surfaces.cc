#include <snug/geometry/body_geometry.h>
#include <snug/geometry/cell_numbering.h>

#include <gtest/gtest.h>

#include <set>

using namespace snug;
using dealii::Point;

namespace {
/// Faces that a body says lie on a known surface do, normals point out, and the number of the
/// boundaries that say so is @p n.
template <int dim>
void expect_known(const geometry::BodyMeshParameters &parameters, unsigned int n)
{
  SCOPED_TRACE(to_text(parameters.source));
  const auto                                     body = geometry::make_geometry<dim>(parameters);
  const auto                                     surfaces = body->known_surfaces();
  const auto                                     mesh     = body->coarse_mesh();
  std::map<std::set<unsigned int>, unsigned int> boundary;
  for (const auto &face : mesh.boundary_faces)
    boundary[{face.first.begin(), face.first.end()}] = face.second;
  std::map<unsigned int, std::set<bool>> said;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        const auto         face  = geometry::face_of<dim>(mesh.cells[c], f);
        const auto         found = boundary.find({face.begin(), face.end()});
        const unsigned int known = body->known_surface(c, f);
        if (found == boundary.end())
          {
            EXPECT_EQ(known, body->no_surface);
            continue;
          }
        said[found->second].insert(known < surfaces.size());
        if (known >= surfaces.size())
          continue;
        Point<dim> unit;
        for (unsigned int d = 0; d < dim; ++d)
          unit[d] = 0.3 + 0.2 * d;
        unit[f / 2]        = f % 2;
        const Point<dim> x = body->position({c, unit});
        EXPECT_NEAR(surfaces[known].distance(x), 0., 1e-14);
        unit[f / 2] = 0.5;
        EXPECT_GT((x - body->position({c, unit})) * surfaces[known].normal(x), 0.);
      }
  unsigned int count = 0;
  for (const auto &one : said)
    {
      EXPECT_EQ(one.second.size(), 1u) << body->boundary_names()[one.first];
      count += *one.second.begin();
    }
  EXPECT_EQ(count, n);
}
} // namespace

TEST(KnownSurfaces, GeneratedBodiesSayWhatTheyAre)
{
  geometry::BodyMeshParameters parameters;
  parameters.shift  = {0.3, -0.2};
  parameters.rotate = {{"z", "25"}};
  using geometry::Part;
  using geometry::Source;
  for (const auto part : {Part::full, Part::half, Part::quarter})
    {
      parameters.part   = part;
      parameters.source = Source::ring;
      parameters.shift  = {0.3, -0.2};
      expect_known<2>(parameters, 2);
      parameters.source = Source::disc;
      expect_known<2>(parameters, 1);
      parameters.shift = {0.3, -0.2, 0.1};
      for (const auto source : {Source::cylinder, Source::sphere})
        {
          parameters.source = source;
          expect_known<3>(parameters, 1);
        }
      for (const auto source : {Source::ring, Source::shell})
        {
          parameters.source = source;
          expect_known<3>(parameters, 2);
        }
    }
}

TEST(KnownSurfaces, OfABoxUnlessAFaceBesideMovesThem)
{
  geometry::BodyMeshParameters parameters;
  parameters.source       = geometry::Source::box;
  parameters.cells        = {2, 3, 2};
  parameters.curved_faces = {{"top", "sphere 4"}};
  expect_known<3>(parameters, 1);
  parameters.curved_faces = {{"top", "cylinder x -3"}, {"bottom", "cylinder y 2"}};
  expect_known<3>(parameters, 2);
  parameters.curved_faces = {{"top", "sphere 4"}, {"left", "sphere 5"}};
  expect_known<3>(parameters, 0);
  parameters.curved_faces = {{"top", "x*x"}};
  expect_known<3>(parameters, 0);
  parameters.cells        = {2, 3};
  parameters.curved_faces = {{"left", "cylinder z 4"}, {"right", "sphere -2"}};
  expect_known<2>(parameters, 2);
}
