#include <snug/shape/shapes.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace snug;

namespace
{
  const shape::BodyNames body_names{{"punch", "foundation"}};

  /// A plain box and a graded one with a curved bottom and hanging nodes.
  template <int dim>
  std::vector<mesh::BodyMeshParameters>
  shape_bodies()
  {
    std::vector<mesh::BodyMeshParameters> bodies(2);
    bodies[0].corner            = std::vector<double>(dim, 5.);
    bodies[0].cells             = std::vector<unsigned int>(dim, 2);
    bodies[1].corner            = std::vector<double>(dim, -1.);
    bodies[1].size              = std::vector<double>(dim, 2.);
    bodies[1].cells             = std::vector<unsigned int>(dim, 3);
    bodies[1].grading           = std::vector<double>(dim, 2.);
    bodies[1].curved_faces      = {{"bottom", "sphere 5"}};
    bodies[1].refine_where      = "x+y";
    bodies[1].local_refinements = 1;
    return bodies;
  }

  template <int dim>
  shape::ShapeParameters
  top_patch()
  {
    shape::ShapeParameters parameters;
    parameters.basis = "Bezier patch";
    parameters.face  = "foundation.top";
    parameters.control_points =
      dim == 2 ? std::vector<unsigned int>{4} : std::vector<unsigned int>{3, 4};
    parameters.direction          = std::vector<double>(dim, 0.);
    parameters.direction[dim - 1] = 2.;
    parameters.bounds             = {-0.5, 1.};
    return parameters;
  }

  template <int dim>
  std::unique_ptr<shape::ShapeBasis<dim>>
  basis(const mesh::BodyMesh<dim>    &mesh,
        const shape::ShapeParameters &parameters)
  {
    return choose(shape::shape_basis_table<dim>(), parameters.basis)
      .make(mesh, body_names, parameters);
  }

  std::vector<double>
  random_numbers(unsigned int n, unsigned int seed)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    std::vector<double>                    numbers(n);
    for (double &number : numbers)
      number = uniform(random);
    return numbers;
  }

  double
  bernstein_value(unsigned int n, unsigned int j, double s)
  {
    double binomial = 1.;
    for (unsigned int i = 1; i <= j; ++i)
      binomial *= (n - i) / double(i);
    return binomial * std::pow(s, j) * std::pow(1. - s, n - 1 - j);
  }

  template <int dim>
  void
  expect_unit_heights_lift_the_face(const std::string &face)
  {
    const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), 1);
    auto                      parameters = top_patch<dim>();
    parameters.face                      = "foundation." + face;
    parameters.direction[0]              = 1.5;
    const auto patch                     = basis(mesh, parameters);
    const auto moved =
      patch->apply(std::vector<double>(patch->n_variables(), 1.));
    const unsigned int f = mesh::boundary_index(mesh.geometry(1), face);
    for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
      {
        double expected = 0.;
        if (mesh.body_of_node(node) == 1 && !mesh.is_hanging(node))
          {
            const auto fraction =
              mesh.geometry(1).box_fraction(mesh.logical_positions()[node]);
            expected = f % 2 == 1 ? fraction[f / 2] : 1. - fraction[f / 2];
          }
        if (mesh.is_hanging(node))
          continue;
        EXPECT_NEAR(moved[node].norm(), expected, 1e-14);
        // direction (1.5, .., 2) / 2.5
        EXPECT_NEAR(moved[node][0], 0.6 * expected, 1e-14);
        EXPECT_NEAR(moved[node][dim - 1], 0.8 * expected, 1e-14);
      }
  }

  template <int dim>
  void
  expect_adjoint(unsigned int degree)
  {
    const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), degree);
    const auto                patch = basis(mesh, top_patch<dim>());
    const auto                alpha = random_numbers(patch->n_variables(), 1);
    // any split of a gradient over the ranks: each its own numbers
    const auto numbers =
      random_numbers(dim * mesh.n_local_nodes(),
                     2 + dealii::Utilities::MPI::this_mpi_process(
                           MPI_COMM_WORLD));
    typename mesh::BodyMesh<dim>::Field gradient(mesh.n_local_nodes());
    for (unsigned int i = 0; i < numbers.size(); ++i)
      gradient[i / dim][i % dim] = numbers[i];
    double     left = 0., right = 0.;
    const auto moved = patch->apply(alpha);
    for (unsigned int node = 0; node < moved.size(); ++node)
      left += moved[node] * gradient[node];
    left                  = dealii::Utilities::MPI::sum(left, MPI_COMM_WORLD);
    const auto transposed = patch->transpose(gradient);
    for (unsigned int i = 0; i < alpha.size(); ++i)
      right += alpha[i] * transposed[i];
    EXPECT_NEAR(left, right, 1e-12);
  }

  /// apply() is the sum of columns, and hanging nodes follow their masters.
  template <int dim>
  void
  expect_linear_and_conforming(unsigned int degree)
  {
    const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), degree);
    const auto                patch = basis(mesh, top_patch<dim>());
    const auto                alpha = random_numbers(patch->n_variables(), 3);
    const auto                moved = patch->apply(alpha);
    typename mesh::BodyMesh<dim>::Field sum(moved.size());
    for (unsigned int i = 0; i < alpha.size(); ++i)
      {
        const auto column = patch->column(i);
        for (unsigned int node = 0; node < sum.size(); ++node)
          sum[node] += alpha[i] * column[node];
      }
    auto interpolated = moved;
    mesh.interpolate_hanging(interpolated);
    for (unsigned int node = 0; node < sum.size(); ++node)
      {
        EXPECT_NEAR((sum[node] - moved[node]).norm(), 0., 1e-14);
        EXPECT_NEAR((interpolated[node] - moved[node]).norm(), 0., 1e-14);
      }
  }

  template <int dim>
  std::string
  shape_complaint(const std::function<void(shape::ShapeParameters &)> &spoil)
  {
    const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), 1);
    auto                      parameters = top_patch<dim>();
    spoil(parameters);
    try
      {
        basis(mesh, parameters);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(BezierPatch, UnitHeightsLiftTheFaceByOneAndFadeLinearly)
{
  expect_unit_heights_lift_the_face<2>("top");
  expect_unit_heights_lift_the_face<2>("left");
  expect_unit_heights_lift_the_face<3>("top");
  expect_unit_heights_lift_the_face<3>("bottom");
  expect_unit_heights_lift_the_face<3>("back");
}

TEST(BezierPatch, ColumnsAreBernsteinPolynomialsFirstAxisFastest)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 2);
  const auto              patch = basis(mesh, top_patch<3>());
  ASSERT_EQ(patch->n_variables(), 12u);
  for (unsigned int i = 0; i < 12; ++i)
    {
      const auto column = patch->column(i);
      for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
        if (mesh.body_of_node(node) == 1 && !mesh.is_hanging(node))
          {
            const auto at =
              mesh.geometry(1).box_fraction(mesh.logical_positions()[node]);
            EXPECT_NEAR(column[node][2],
                        at[2] * bernstein_value(3, i % 3, at[0]) *
                          bernstein_value(4, i / 3, at[1]),
                        1e-14);
          }
    }
}

TEST(BezierPatch, TransposeIsTheAdjointOfApply)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_adjoint<2>(degree);
      expect_adjoint<3>(degree);
    }
}

TEST(BezierPatch, IsLinearAndHangingNodesFollow)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_linear_and_conforming<2>(degree);
      expect_linear_and_conforming<3>(degree);
    }
}

TEST(BezierPatch, ControlPointsStandOnTheFlatFace)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 1);
  auto                    parameters = top_patch<3>();
  parameters.face                    = "foundation.bottom";
  const shape::Shapes<3> shapes(mesh, body_names, {parameters});
  std::vector<double>    alpha(12, 0.);
  alpha[7]          = 0.25;
  const auto points = shapes.control_points(alpha);
  ASSERT_EQ(points.size(), 12u);
  const auto expect_at = [&](unsigned int i, const dealii::Point<3> &place) {
    EXPECT_EQ(points[i].index, i);
    EXPECT_NEAR(points[i].position.distance(place), 0., 1e-15);
  };
  expect_at(0, {-1., -1., -1.});
  expect_at(2, {1., -1., -1.});
  // height 7 = 1 + 3 * 2: s = 1/2, t = 2/3
  expect_at(7, {0., 1. / 3, -0.75});
  expect_at(11, {1., 1., -1.});
  EXPECT_NEAR(points[7].move[2], 0.25, 1e-15);
  EXPECT_EQ(points[6].move.norm(), 0.);
}

TEST(BezierPatch, RejectsBadEntriesByName)
{
  using P                 = shape::ShapeParameters;
  const auto expect_entry = [](const std::string              &entry,
                               const std::function<void(P &)> &spoil) {
    const std::string message = shape_complaint<3>(spoil);
    EXPECT_NE(message.find("'" + entry + "'"), std::string::npos)
      << entry << ": " << message;
  };
  EXPECT_EQ(shape_complaint<3>([](P &) {}), "");
  expect_entry("Face", [](P &p) { p.face = "anvil.top"; });
  expect_entry("Face", [](P &p) { p.face = "foundation.roof"; });
  expect_entry("Face", [](P &p) { p.face = "foundation"; });
  expect_entry("Face", [](P &p) { p.face = ""; });
  expect_entry("Control points", [](P &p) { p.control_points = {3}; });
  expect_entry("Control points", [](P &p) { p.control_points = {3, 1}; });
  expect_entry("Direction", [](P &p) { p.direction = {0., 0., 0.}; });
  expect_entry("Direction", [](P &p) { p.direction = {0., 1.}; });
  expect_entry("Direction", [](P &p) { p.direction = {0., 1., NAN}; });
}

TEST(NoBasis, HasNoVariables)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, shape_bodies<2>(), 1);
  const auto              none = basis(mesh, shape::ShapeParameters());
  EXPECT_EQ(none->n_variables(), 0u);
  const auto moved = none->apply({});
  EXPECT_EQ(moved.size(), mesh.n_local_nodes());
  for (const auto &value : moved)
    EXPECT_EQ(value.norm(), 0.);
  EXPECT_TRUE(none->transpose(moved).empty());
}
