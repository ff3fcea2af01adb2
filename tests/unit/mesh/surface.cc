#include <snug/mesh/face_nodes.h>
#include <snug/mesh/lagrange.h>
#include <snug/mesh/surface.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace snug;

namespace {
/// Two boxes, the first refined for x > 0.5 of its own so that nodes hang
/// on its faces.
template <int dim>
std::vector<geometry::BodyMeshParameters> hanging_boxes()
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  bodies[0].size              = std::vector<double>(dim, 1.);
  bodies[0].cells             = std::vector<unsigned int>(dim, 2);
  bodies[0].refine_where      = "x-0.5";
  bodies[0].local_refinements = 1;
  bodies[1].corner            = std::vector<double>(dim, 0.);
  bodies[1].corner[dim - 1]   = 1.;
  bodies[1].size              = std::vector<double>(dim, 2.);
  bodies[1].cells             = std::vector<unsigned int>(dim, 3);
  return bodies;
}

template <int dim>
struct SurfaceScene
{
  SurfaceScene(MPI_Comm communicator, unsigned int degree)
    : bodies(communicator, hanging_boxes<dim>(), degree)
    , surface(bodies, {{0, 2 * dim - 1}, {1, 2 * dim - 2}})
    , positions(surface.gather(bodies.reference_positions()))
  {}

  mesh::BodyMesh<dim>                bodies;
  mesh::Surface<dim>                 surface;
  typename mesh::Surface<dim>::Field positions;
};

/// Centre and outward area vector (t1 x t2 between the corners) of a face.
template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
centre_and_area(const SurfaceScene<dim> &scene, unsigned int f)
{
  const auto            &nodes = scene.surface.faces()[f].nodes;
  dealii::Tensor<1, dim> centre, area;
  for (const unsigned int node : nodes)
    centre += scene.positions[node] / double(nodes.size());
  const unsigned int p = scene.bodies.degree();
  const auto         t = scene.positions[nodes[p]] - scene.positions[nodes[0]];
  if constexpr (dim == 2)
    area = dealii::cross_product_2d(t);
  else
    area =
      dealii::cross_product_3d(t, scene.positions[nodes[p * (p + 1)]] - scene.positions[nodes[0]]);
  return {centre, area};
}

template <int dim>
void expect_whole_faces_outwards(unsigned int degree)
{
  const SurfaceScene<dim> scene(MPI_COMM_WORLD, degree);
  dealii::Tensor<1, dim>  area[2];
  for (unsigned int f = 0; f < scene.surface.faces().size(); ++f)
    {
      const auto &face = scene.surface.faces()[f];
      const auto  a    = centre_and_area(scene, f).second;
      EXPECT_GT(a[dim - 1] * (face.body == 0 ? 1. : -1.), 0.);
      area[face.body] += a;
    }
  EXPECT_NEAR(area[0][dim - 1], 1., 1e-13);
  EXPECT_NEAR(area[1][dim - 1], -std::pow(2., dim - 1), 1e-13);
}

template <int dim>
void expect_order_of_one_rank(unsigned int degree)
{
  const SurfaceScene<dim> all(MPI_COMM_WORLD, degree);
  const SurfaceScene<dim> self(MPI_COMM_SELF, degree);
  ASSERT_EQ(all.surface.faces().size(), self.surface.faces().size());
  EXPECT_EQ(all.surface.n_nodes(), self.surface.n_nodes());
  for (unsigned int f = 0; f < all.surface.faces().size(); ++f)
    {
      EXPECT_EQ(all.surface.faces()[f].body, self.surface.faces()[f].body);
      EXPECT_NEAR((centre_and_area(all, f).first - centre_and_area(self, f).first).norm(), 0.,
                  1e-14);
    }
}
} // namespace

TEST(Surface, HoldsWholeFacesOrientedOutwards)
{
  expect_whole_faces_outwards<2>(1);
  expect_whole_faces_outwards<2>(2);
  expect_whole_faces_outwards<3>(1);
  expect_whole_faces_outwards<3>(2);
}

TEST(Surface, OrderOfFacesDoesNotDependOnRanks)
{
  expect_order_of_one_rank<2>(2);
  expect_order_of_one_rank<3>(1);
  expect_order_of_one_rank<3>(2);
}

TEST(Surface, HangingNodesInterpolateTheirMasters)
{
  for (const unsigned int degree : {1, 2})
    {
      const SurfaceScene<3> scene(MPI_COMM_WORLD, degree);
      unsigned int          n_hanging = 0;
      for (unsigned int node = 0; node < scene.surface.n_nodes(); ++node)
        {
          dealii::Tensor<1, 3> interpolated;
          for (const auto &master : scene.surface.masters(node))
            {
              EXPECT_TRUE(scene.surface.masters(master.first).empty());
              interpolated += master.second * scene.positions[master.first];
            }
          if (scene.surface.masters(node).empty())
            continue;
          ++n_hanging;
          EXPECT_NEAR((interpolated - scene.positions[node]).norm(), 0., 1e-14);
        }
      // the line x = 0.5 on the top face: 2 coarse edges, each with one
      // hanging node for Q1; middle vertex and two quarter nodes for Q2
      EXPECT_EQ(n_hanging, degree == 1 ? 2u : 6u);
    }
}

TEST(Surface, GatherAndAddOwnedMoveEachNodeOnce)
{
  const SurfaceScene<3> scene(MPI_COMM_WORLD, 2);
  const auto           &bodies = scene.bodies;
  for (unsigned int node = 1; node < scene.surface.n_nodes(); ++node)
    EXPECT_LT(scene.surface.global_node(node - 1), scene.surface.global_node(node));

  mesh::BodyMesh<3>::Field numbers(bodies.n_local_nodes());
  for (unsigned int node = 0; node < numbers.size(); ++node)
    numbers[node][1] = bodies.global_node(node);
  const auto gathered = scene.surface.gather(numbers);
  for (unsigned int node = 0; node < scene.surface.n_nodes(); ++node)
    EXPECT_EQ(gathered[node][1], scene.surface.global_node(node));

  mesh::BodyMesh<3>::Field sum(bodies.n_local_nodes());
  scene.surface.add_owned(gathered, sum);
  double total = 0., expected = 0.;
  for (unsigned int node = 0; node < sum.size(); ++node)
    {
      total += sum[node][1];
      EXPECT_TRUE(sum[node][1] == 0. || sum[node][1] == numbers[node][1]);
    }
  for (const auto &value : gathered)
    expected += value[1];
  EXPECT_EQ(dealii::Utilities::MPI::sum(total, MPI_COMM_WORLD), expected);
}

/// The tangents of both are the same.
template <int dim>
void expect_points_at_the_nodes()
{
  const unsigned int        p       = 2;
  const auto                lattice = mesh::lagrange_nodes<dim>(p);
  std::vector<unsigned int> all(lattice.size());
  std::iota(all.begin(), all.end(), 0u);
  for (unsigned int face = 0; face < 2 * dim; ++face)
    {
      const auto nodes    = mesh::oriented_face_nodes<dim>(all, p, face);
      const auto on_faces = mesh::lagrange_nodes<dim - 1>(p);
      for (unsigned int k = 0; k < nodes.size(); ++k)
        EXPECT_EQ(mesh::point_on_face<dim>(face, on_faces[k].point), lattice[nodes[k]].point);
    }
}

TEST(PointOnFace, IsWhereTheOrientedNodesAre)
{
  expect_points_at_the_nodes<2>();
  expect_points_at_the_nodes<3>();
}
