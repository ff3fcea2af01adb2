#include <snug/base/petsc_options.h>

#include <deal.II/base/mpi.h>

#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;
using shape::InteriorKind;

/// The top of a cube with an interior.
template <int dim>
shape::ShapeParameters cube_top(const InteriorKind interior)
{
  auto parameters     = on_top<dim>("Bezier patch", "cube");
  parameters.interior = interior;
  return parameters;
}

/**
 * Sides slide and the bottom stays: a top lifted as a whole stretches a
 * cube evenly. That is harmonic, and an elastic bar held sideways does the
 * same; the stiffness of its cells may only vary with height for that,
 * here not at all.
 */
template <int dim>
void expect_even_stretch(unsigned int degree, const InteriorKind interior)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, plain_cube<dim>(4), degree);
  const shape::Shapes<dim>  shapes(mesh, {{"cube"}}, {cube_top<dim>(interior)});
  const auto                moved = shapes.apply(std::vector<double>(shapes.n_variables(), 1.));
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      dealii::Tensor<1, dim> expected;
      expected[dim - 1] = mesh.reference_positions()[node][dim - 1];
      EXPECT_NEAR((moved[node] - expected).norm(), 0., 1e-12) << to_text(interior);
    }
}

TEST(Interior, StretchesACubeEvenly)
{
  for (const char *const type : {"cholesky", "gamg"})
    for (const auto interior : {InteriorKind::Laplace, InteriorKind::elasticity})
      for (const unsigned int degree : {1, 2})
        {
          const petsc::DefaultOption preconditioner("interior_", "pc_type", type);
          expect_even_stretch<2>(degree, interior);
          expect_even_stretch<3>(degree, interior);
        }
}

/// Laplace: cos(pi x) sinh(pi y) / sinh(pi) meets the sliding sides
/// x = 0, 1 and the held bottom; the error is of order h^2.
double harmonic_error(unsigned int n)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, plain_cube<2>(n), 1);
  auto                    parameters = formulas<2>();
  parameters.face                    = "cube.top";
  parameters.modes                   = {{"0", "cos(3.14159265358979323846*x)"}};
  parameters.interior                = InteriorKind::Laplace;
  const shape::Shapes<2> shapes(mesh, {{"cube"}}, {parameters});
  const auto             moved = shapes.apply({1.});
  const double           pi    = dealii::numbers::PI;
  double                 error = 0.;
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      const auto &x = mesh.reference_positions()[node];
      error         = std::max(error, std::abs(moved[node][1] -
                                               std::cos(pi * x[0]) * std::sinh(pi * x[1]) / std::sinh(pi)));
    }
  return dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
}

TEST(Interior, LaplaceConvergesToTheHarmonicFunction)
{
  const double coarse = harmonic_error(8), fine = harmonic_error(16);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(coarse / fine, 3.5);
  EXPECT_LT(coarse / fine, 4.5);
}

/// A body with a curved side: its nodes keep their distance from the
/// tangent planes, those of the held bottom stay, and the top is as told.
TEST(Interior, NeighbouringFacesSlideAndOthersAreHeld)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 1);
  for (const auto interior : {InteriorKind::Laplace, InteriorKind::elasticity})
    {
      auto parameters     = on_top<3>("Bezier patch");
      parameters.interior = interior;
      const shape::Shapes<3> shapes(mesh, body_names(), {parameters});
      const auto             alpha = random_numbers(shapes.n_variables(), 9);
      const auto             moved = shapes.apply(alpha);
      parameters.interior          = InteriorKind::linear_blending;
      const auto of_the_face = shape::Shapes<3>(mesh, body_names(), {parameters}).apply(alpha);
      for (const auto &face : mesh.boundary_faces())
        for (const unsigned int node : face.nodes)
          {
            const bool held = face.body == 0 || face.boundary == 4;
            const bool top  = face.boundary == 5;
            // the sides are plane
            const double wrong = held  ? moved[node].norm()
                                 : top ? (moved[node] - of_the_face[node]).norm()
                                       : std::abs(moved[node][face.boundary / 2]);
            EXPECT_NEAR(wrong, 0., held ? 0. : 1e-12);
          }
    }
}

/// Expect that the displacements of a shape rotate with the body, up to rounding.
template <int dim>
void expect_turned_moves(double reach)
{
  auto       bodies = shape_bodies<dim>();
  const auto moves  = [&]() {
    const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, bodies, 1);
    auto                      parameters = on_top<dim>("Bezier patch");
    parameters.reach                     = reach;
    const shape::Shapes<dim> shapes(mesh, body_names(), {parameters});
    return shapes.apply(random_numbers(shapes.n_variables(), 9));
  };
  bodies[1].refine_where = "1";
  const auto straight    = moves();
  bodies[1].shift        = std::vector<double>(dim, 0.7);
  bodies[1].rotate       = {{"z", "30"}};
  if (dim == 3)
    bodies[1].rotate = {{"x", "90"}, {"z", "30"}};
  const auto turned = moves();
  // about x by 90 degrees first in 3D, then about z by 30
  const double           c = std::sqrt(0.75), s = 0.5;
  dealii::Tensor<2, dim> Q;
  Q[0][0]       = c;
  Q[1][0]       = s;
  Q[0][dim - 1] = dim == 2 ? -s : s;
  Q[1][dim - 1] = dim == 2 ? c : -c;
  if (dim == 3)
    Q[dim - 1][1] = 1.;
  double largest = 0.;
  for (unsigned int node = 0; node < turned.size(); ++node)
    {
      EXPECT_LT((turned[node] - Q * straight[node]).norm(), 1e-12);
      largest = std::max(largest, turned[node].norm());
    }
  EXPECT_GT(dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD), 0.1);
}

TEST(Interior, BlendsRotatedBoxesToo)
{
  for (const double reach : {0., 1.1})
    {
      expect_turned_moves<2>(reach);
      expect_turned_moves<3>(reach);
    }
}

template <int dim>
void expect_reach(const InteriorKind interior)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, plain_cube<dim>(8), 1);
  auto                      parameters = cube_top<dim>(interior);
  parameters.reach                     = 0.4;
  const shape::Shapes<dim> shapes(mesh, {{"cube"}}, {parameters});
  const auto               moved = shapes.apply(std::vector<double>(shapes.n_variables(), 1.));
  for (unsigned int node = 0; node < moved.size(); ++node)
    {
      const double depth = 1. - mesh.reference_positions()[node][dim - 1];
      EXPECT_EQ(moved[node].norm() > 0., depth < 0.4) << to_text(interior);
      if (interior == InteriorKind::linear_blending)
        {
          EXPECT_NEAR(moved[node][dim - 1], std::max(0., 1. - depth / 0.4), 1e-14);
        }
    }
}

TEST(Interior, ReachesNoFurtherThanAsked)
{
  for (const auto interior :
       {InteriorKind::linear_blending, InteriorKind::Laplace, InteriorKind::elasticity})
    {
      expect_reach<2>(interior);
      expect_reach<3>(interior);
    }
}

/// Least quotient of a cell's height after and before, where a bump is
/// pressed into a layer of thin cells.
double least_stretch(const InteriorKind interior)
{
  auto bodies       = plain_cube<2>(12);
  bodies[0].grading = {1., 0.02}; // thin cells below the top
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, bodies, 1);
  auto                    parameters = formulas<2>();
  parameters.face                    = "cube.top";
  parameters.modes                   = {{"0", "-0.1*sin(9*x)^2"}};
  parameters.interior                = interior;
  const shape::Shapes<2> shapes(mesh, {{"cube"}}, {parameters});
  const auto             moved = shapes.apply({1.});
  double                 least = 1.;
  for (const auto &cell : mesh.cells())
    for (const unsigned int corner : {0, 1})
      {
        const unsigned int a = cell.nodes[corner];
        const unsigned int b = cell.nodes[corner + 2];
        const double height  = mesh.reference_positions()[b][1] - mesh.reference_positions()[a][1];
        least                = std::min(least, 1. + (moved[b][1] - moved[a][1]) / height);
      }
  return dealii::Utilities::MPI::min(least, MPI_COMM_WORLD);
}

TEST(Interior, ElasticityWithStiffSmallCellsSparesThem)
{
  const double laplace = least_stretch(InteriorKind::Laplace);
  const double elastic = least_stretch(InteriorKind::elasticity);
  EXPECT_GT(elastic, 0.5);
  EXPECT_GT(elastic, laplace + 0.1);
}
} // namespace
} // namespace snug
