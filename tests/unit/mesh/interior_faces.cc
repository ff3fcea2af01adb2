#include <snug/mesh/body_mesh.h>
#include <snug/mesh/lagrange.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace snug;

namespace {
/// A body whose blocks meet turned against each other, refined in a corner.
template <int dim>
std::vector<geometry::BodyMeshParameters> body(geometry::Source shape)
{
  std::vector<geometry::BodyMeshParameters> bodies(1);
  bodies[0].source            = shape;
  bodies[0].cells             = std::vector<unsigned int>(dim, dim == 2 ? 4 : 3);
  bodies[0].round_cells       = {dim == 2 ? 4u : 2u};
  bodies[0].refine_where      = "x + 0.3*y - 0.4";
  bodies[0].local_refinements = dim == 2 ? 2 : 1;
  return bodies;
}

template <int dim>
dealii::Tensor<1, dim> position(const typename mesh::BodyMesh<dim>::Field &x,
                                const std::vector<unsigned int>           &nodes,
                                const mesh::LagrangePoint<dim>            &at)
{
  dealii::Tensor<1, dim> result;
  for (unsigned int a = 0; a < nodes.size(); ++a)
    result += at.value[a] * x[nodes[a]];
  return result;
}

/// Both cells place the points of their face alike, and the faces of all cells close them.
template <int dim>
void check(geometry::Source shape, unsigned int degree)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, body<dim>(shape), degree);
  const auto                x       = mesh::owners_values(mesh, mesh.reference_positions());
  const unsigned int        n_owned = mesh.cells().size();
  std::vector<double>       covered(n_owned, 0.); // faces, by the part of them
  for (const auto &face : mesh.interior_faces())
    {
      ASSERT_TRUE(face.cell < n_owned || face.neighbour < n_owned);
      const auto &cell      = mesh.known_cell(face.cell);
      const auto &neighbour = mesh.known_cell(face.neighbour);
      for (unsigned int q = 0; q < (1u << (dim - 1)); ++q)
        {
          dealii::Point<dim> point;
          for (unsigned int axis = 0, at = 0; axis < dim; ++axis)
            point[axis] = axis == face.face / 2u ? face.face % 2 : 0.2 + 0.5 * ((q >> at++) & 1);
          const auto beyond = face.in_neighbour(point);
          const auto here = position<dim>(x, cell.nodes, mesh::lagrange_point<dim>(degree, point));
          const auto there =
            position<dim>(x, neighbour.nodes, mesh::lagrange_point<dim>(degree, beyond));
          EXPECT_LT((here - there).norm(), 1e-13) << to_text(shape) << " at " << here;
        }
      const bool is_part = face.child < (1u << dim);
      if (face.cell < n_owned)
        covered[face.cell] += 1.;
      if (face.neighbour < n_owned)
        covered[face.neighbour] += is_part ? std::pow(0.5, dim - 1) : 1.;
    }
  for (const auto &face : mesh.boundary_faces())
    covered[face.cell] += 1.;
  for (const double n : covered)
    EXPECT_EQ(n, 2. * dim);
}
} // namespace

TEST(InteriorFaces, BothCellsPlaceTheirPointsAlike)
{
  for (const unsigned int degree : {1, 2})
    {
      check<2>(geometry::Source::box, degree);
      check<2>(geometry::Source::disc, degree);
      check<3>(geometry::Source::box, degree);
      check<3>(geometry::Source::sphere, degree);
    }
}
