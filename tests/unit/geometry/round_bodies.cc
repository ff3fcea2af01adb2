#include <snug/mesh/body_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

using namespace snug;
using dealii::Point;
using dealii::numbers::PI;

namespace {
geometry::BodyMeshParameters round_body(const geometry::Source           source,
                                        const geometry::Part             part,
                                        const std::vector<unsigned int> &cells)
{
  geometry::BodyMeshParameters parameters;
  parameters.source       = source;
  parameters.part         = part;
  parameters.radius       = 2.;
  parameters.inner_radius = 0.75;
  parameters.length       = 3.;
  parameters.round_cells  = cells;
  return parameters;
}

/// Volume of a mesh by its Q2 cells, 4^dim Gauss points each, and the
/// smallest Jacobian. Collective.
template <int dim>
std::pair<double, double> volume(const mesh::BodyMesh<dim> &mesh)
{
  const dealii::QGauss<dim> gauss(4);
  const dealii::FE_Q<dim>   fe(mesh.degree());
  const auto order = dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(mesh.degree());
  double     sum = 0., smallest = 1e300;
  for (const auto &cell : mesh.cells())
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        dealii::Tensor<2, dim> F;
        for (unsigned int k = 0; k < cell.nodes.size(); ++k)
          F += dealii::outer_product(mesh.reference_positions()[cell.nodes[k]],
                                     fe.shape_grad(order[k], gauss.point(q)));
        smallest = std::min(smallest, dealii::determinant(F));
        sum += dealii::determinant(F) * gauss.weight(q);
      }
  return {dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD),
          dealii::Utilities::MPI::min(smallest, MPI_COMM_WORLD)};
}

/// How far nodes of boundaries are from where they belong, by name.
template <int dim>
using Distances = std::map<std::string, std::function<double(const Point<dim> &)>>;

template <int dim>
void expect_body(const geometry::BodyMeshParameters &parameters,
                 double                              exact_volume,
                 const Distances<dim>               &boundaries)
{
  SCOPED_TRACE(to_text(parameters.source) + ", " + to_text(parameters.part));
  auto refined        = parameters;
  refined.refinements = 1;
  for (const auto &body : {parameters, refined})
    {
      const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, {body}, 2);
      const auto               &names = mesh.geometry(0).boundary_names();
      EXPECT_EQ(names.size(), boundaries.size());
      for (const auto &face : mesh.boundary_faces())
        for (const unsigned int node : face.nodes)
          {
            const std::string name = names[face.boundary];
            ASSERT_EQ(boundaries.count(name), 1u) << name;
            // the iterations of a spherical mean stop at 1e-10
            EXPECT_NEAR(boundaries.at(name)(Point<dim>(mesh.reference_positions()[node])), 0., 1e-9)
              << name;
          }
      const auto result = volume(mesh);
      EXPECT_GT(result.second, 0.);
      // quadratic faces of 11 degrees
      EXPECT_NEAR(result.first, exact_volume, 2e-4 * exact_volume);
    }
}

template <int dim>
std::function<double(const Point<dim> &)> coordinate(unsigned int d, double value = 0.)
{
  return [=](const Point<dim> &x) { return x[d] - value; };
}

/// Distance from the origin, in the first @p n coordinates.
template <int dim>
std::function<double(const Point<dim> &)> radius(unsigned int n, double value)
{
  return [=](const Point<dim> &x) {
    double square = 0.;
    for (unsigned int d = 0; d < n; ++d)
      square += x[d] * x[d];
    return std::sqrt(square) - value;
  };
}

using geometry::Part;
using geometry::Source;

const std::vector<Part> parts = {Part::full, Part::half, Part::quarter, Part::eighth};
} // namespace

TEST(RoundBodies, Discs)
{
  for (unsigned int p = 0; p < 3; ++p)
    {
      Distances<2> faces = {{"outer", radius<2>(2, 2.)}};
      if (p >= 1)
        faces["bottom"] = coordinate<2>(1);
      if (p >= 2)
        faces["left"] = coordinate<2>(0);
      expect_body<2>(round_body(Source::disc, parts[p], {2}), 4. * PI / (1 << p), faces);
    }
}

TEST(RoundBodies, Rings)
{
  const double area = PI * (4. - 0.75 * 0.75);
  for (unsigned int p = 0; p < 3; ++p)
    {
      Distances<2> flat  = {{"inner", radius<2>(2, 0.75)}, {"outer", radius<2>(2, 2.)}};
      Distances<3> solid = {{"inner", radius<3>(2, 0.75)},
                            {"outer", radius<3>(2, 2.)},
                            {"bottom", coordinate<3>(2)},
                            {"top", coordinate<3>(2, 3.)}};
      if (p >= 1)
        {
          const unsigned int end = p == 1 ? 1 : 0;
          flat["start"]          = coordinate<2>(1);
          flat["end"]            = coordinate<2>(end);
          solid["start"]         = coordinate<3>(1);
          solid["end"]           = coordinate<3>(end);
        }
      const unsigned int n = 16 >> p;
      expect_body<2>(round_body(Source::ring, parts[p], {n, 2}), area / (1 << p), flat);
      expect_body<3>(round_body(Source::ring, parts[p], {n, 2, 2}), 3. * area / (1 << p), solid);
    }
}

TEST(RoundBodies, Cylinders)
{
  for (unsigned int p = 0; p < 3; ++p)
    {
      Distances<3> faces = {{"outer", radius<3>(2, 2.)},
                            {"bottom", coordinate<3>(2)},
                            {"top", coordinate<3>(2, 3.)}};
      if (p >= 1)
        faces["front"] = coordinate<3>(1);
      if (p >= 2)
        faces["left"] = coordinate<3>(0);
      expect_body<3>(round_body(Source::cylinder, parts[p], {2, 1}), 12. * PI / (1 << p), faces);
    }
}

TEST(RoundBodies, SpheresAndShells)
{
  const std::vector<std::string> cuts = {"bottom", "front", "left"};
  for (unsigned int p = 0; p < 4; ++p)
    {
      Distances<3> faces = {{"outer", radius<3>(3, 2.)}};
      for (unsigned int c = 0; c < p; ++c)
        faces[cuts[c]] = coordinate<3>(2 - c);
      const double ball = 4. / 3. * PI / (1 << p);
      expect_body<3>(round_body(Source::sphere, parts[p], {2}), 8. * ball, faces);
      faces["inner"] = radius<3>(3, 0.75);
      expect_body<3>(round_body(Source::shell, parts[p], {2, 1}), (8. - std::pow(0.75, 3)) * ball,
                     faces);
    }
}

TEST(RoundBodies, PlacedBodiesAreWarpedScaledTurnedAndShiftedInThisOrder)
{
  auto body   = round_body(Source::cylinder, Part::full, {2, 1});
  body.warp   = {"0", "0", "0.1*z"};
  body.scale  = 0.5;
  body.rotate = {{"x", "90"}, {"z", "90"}};
  body.shift  = {1., 2., 3.};
  // the axis z goes to -y, then to x
  expect_body<3>(body, 12. * PI * 1.1 / 8.,
                 {{"bottom", coordinate<3>(0, 1.)},
                  {"top", coordinate<3>(0, 1. + 3. * 1.1 / 2.)},
                  {"outer",
                   [](const Point<3> &x) { return std::hypot(x[1] - 2., x[2] - 3.) - 1.; }}});
}

TEST(RoundBodies, BadEntriesAreNamed)
{
  const auto expect_entry = [](const std::string &entry, const geometry::BodyMeshParameters &body) {
    try
      {
        geometry::make_geometry<3>(body);
        ADD_FAILURE() << entry;
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("'" + entry + "'"), std::string::npos)
          << error.what();
      }
  };
  const auto with = [](auto member, auto value) {
    auto body    = round_body(Source::ring, Part::half, {4, 1, 1});
    body.*member = value;
    return body;
  };
  using P = geometry::BodyMeshParameters;
  expect_entry("Mesh", round_body(Source::disc, Part::full, {2}));
  expect_entry("Part", with(&P::part, Part::eighth));
  expect_entry("Radius", with(&P::radius, -1.));
  expect_entry("Inner radius", with(&P::inner_radius, 2.));
  expect_entry("Length", with(&P::length, 0.));
  expect_entry("Cells", with(&P::round_cells, std::vector<unsigned>{4, 1}));
  expect_entry("Cells", round_body(Source::ring, Part::full, {2, 1, 1}));
  expect_entry("Scale", with(&P::scale, 0.));
  expect_entry("Shift", with(&P::shift, std::vector<double>{1., 2.}));
  expect_entry("Warp", with(&P::warp, std::vector<std::string>{"x"}));
  for (const std::string turn : {"30 degrees", "", "inf"})
    expect_entry("Rotate",
                 with(&P::rotate, std::vector<std::pair<std::string, std::string>>{{"x", turn}}));
}
