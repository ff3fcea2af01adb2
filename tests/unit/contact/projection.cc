#include "two_boxes.h"

#include <snug/faces/closest_point.h>
#include <snug/faces/outer_edges.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace snug;
using namespace snug::contact;
using namespace snug::faces;

namespace {
template <int dim>
std::vector<unsigned int> master_faces(const TwoBoxes<dim> &scene)
{
  std::vector<unsigned int> faces;
  for (unsigned int f = 0; f < scene.surface.faces().size(); ++f)
    if (scene.surface.faces()[f].body == 1)
      faces.push_back(f);
  return faces;
}

template <int dim>
dealii::Tensor<1, dim> master_point(const TwoBoxes<dim> &scene, const Projection<dim> &projection)
{
  dealii::Tensor<1, dim> x;
  for (const auto &master : projection.masters)
    x += master.second * scene.positions[master.first];
  return x;
}

template <int dim>
void expect_one_master_each(unsigned int degree)
{
  const TwoBoxes<dim> scene(TwoBoxes<dim>::boxes(5, 5), degree);
  EXPECT_EQ(scene.contact().n_rows(), std::pow(5 * degree + 1, dim - 1));
  for (const auto &projection : scene.projections())
    {
      ASSERT_EQ(projection.masters.size(), 1u);
      EXPECT_EQ(projection.masters[0].second, 1.);
      EXPECT_NEAR(
        (scene.positions[projection.masters[0].first] - scene.positions[projection.slave]).norm(),
        0., 1e-15);
    }
}

/// Flat faces with unrelated meshes: the projection is vertical, and weights
/// reproduce positions.
template <int dim>
void expect_linear_reproduction(unsigned int degree)
{
  auto bodies               = TwoBoxes<dim>::boxes(3, 5);
  bodies[0].corner[dim - 1] = 1.3;
  bodies[0].grading         = std::vector<double>(dim, 1.);
  bodies[0].grading[0]      = 3.;
  const TwoBoxes<dim> scene(bodies, degree);
  EXPECT_EQ(scene.contact().n_rows(), std::pow(3 * degree + 1, dim - 1));
  for (const auto &projection : scene.projections())
    {
      double total = 0.;
      for (const auto &master : projection.masters)
        total += master.second;
      EXPECT_NEAR(total, 1., 1e-14);
      auto expected     = scene.positions[projection.slave];
      expected[dim - 1] = 1.;
      EXPECT_NEAR((master_point(scene, projection) - expected).norm(), 0., 1e-13);
    }
}

/// The normal of the master leads to the slave, but where that side ends; and
/// the tree may not miss the closest face: compare with all faces, from far
/// and near.
template <int dim>
void expect_normals_from_near_the_closest_point(unsigned int degree, double distance)
{
  TwoBoxes<dim> scene(TwoBoxes<dim>::hanging_boxes(), degree);
  scene.bend();
  const auto noise = scene.random_field(3);
  for (unsigned int node = 0; node < scene.positions.size(); ++node)
    if (!scene.is_master(node))
      {
        scene.positions[node] += 0.1 * noise[node];
        scene.positions[node][dim - 1] += distance;
      }
  const FaceShape<dim> shape(degree);
  EXPECT_GT(scene.contact().n_rows(), 3u);
  const auto         faces = master_faces(scene);
  const NodalNormals normals(scene.surface, faces, shape, scene.positions);
  unsigned int       n_normals = 0, n = 0;
  for (const auto &projection : scene.projections())
    {
      const auto            &p      = scene.positions[projection.slave];
      const auto             normal = p - master_point(scene, projection);
      dealii::Tensor<1, dim> v;
      for (const auto &master : projection.masters)
        v += master.second * normals.normals()[master.first];
      v /= v.norm();
      ++n;
      n_normals += (normal - (normal * v) * v).norm() < 1e-12;
      double least = 1e300;
      for (const unsigned int f : faces)
        {
          std::vector<dealii::Tensor<1, dim>> nodes;
          for (const unsigned int node : scene.surface.faces()[f].nodes)
            nodes.push_back(scene.positions[node]);
          least = std::min(least, closest_point(shape, nodes, p).squared_distance);
        }
      EXPECT_GE(normal.norm(), std::sqrt(least) - 1e-12);
      EXPECT_LE(normal.norm(), 1.5 * std::sqrt(least));
    }
  EXPECT_GT(2 * n_normals, n);
}
} // namespace

TEST(Projection, MatchingNodesPairOneToOne)
{
  expect_one_master_each<2>(1);
  expect_one_master_each<2>(2);
  expect_one_master_each<3>(1);
  expect_one_master_each<3>(2);
}

TEST(Projection, WeightsReproduceLinearFields)
{
  expect_linear_reproduction<2>(1);
  expect_linear_reproduction<2>(2);
  expect_linear_reproduction<3>(1);
  expect_linear_reproduction<3>(2);
}

TEST(Projection, NormalsBeginNearTheClosestPoint)
{
  for (const double distance : {0.02, 2.})
    for (const unsigned int degree : {1, 2})
      {
        expect_normals_from_near_the_closest_point<2>(degree, distance);
        expect_normals_from_near_the_closest_point<3>(degree, distance);
      }
}

TEST(Projection, SlaveNodesBeyondTheEdgeCarryNoRow)
{
  // slave nodes at x = -0.25, 0, .., 1.25, master faces 0.25 wide over [0,1]
  for (const double shift : {0., 0.01, 0.02})
    {
      auto bodies         = TwoBoxes<3>::boxes(6, 4);
      bodies[0].corner[0] = -0.25 + shift;
      bodies[0].size[0]   = 1.5;
      bodies[0].cells[1]  = 4;
      const TwoBoxes<3> scene(bodies, 1);
      // 0.01 beyond is within the tolerance of 5 % of 0.25, 0.02 is not
      const unsigned int columns = shift > 0.0125 ? 4 : 5;
      EXPECT_EQ(scene.contact().n_rows(), columns * 5) << shift;
    }
}

TEST(Projection, TheMasterGivesWayBeyondItsEdge)
{
  // a column of slave nodes 0.01 beyond master faces of 0.25
  auto bodies         = TwoBoxes<3>::boxes(6, 4);
  bodies[0].corner[0] = -0.26;
  bodies[0].size[0]   = 1.5;
  bodies[0].cells[1]  = 4;
  const TwoBoxes<3> scene(bodies, 1);
  const auto        contact = scene.contact();
  const auto        rows    = contact.rows(scene.positions);
  unsigned int      beyond  = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const bool   is_beyond = scene.positions[contact.places()[i].slave][0] < 0.;
      const double t = 0.8, radius = 0.0125;
      beyond += is_beyond;
      EXPECT_NEAR(rows[i].gap, is_beyond ? radius * t * t * t * t / (2. * (1. - t * t)) : 0.,
                  1e-14);
    }
  EXPECT_EQ(beyond, 5u);
  // without a kink at the edge, without a limit where rows end
  EXPECT_EQ(edge_softening(0., 1.), 0.);
  EXPECT_LT(edge_softening(0.01 * edge_tolerance, 1.), 3e-10);
  EXPECT_GT(edge_softening((1. - 1e-9) * edge_tolerance, 1.), 1e6);
  EXPECT_LT(derivative_error(scene, contact, 1e-4), 1e-9);
}

TEST(Projection, HangingSlaveNodesCarryNoRow)
{
  const TwoBoxes<3>      scene(TwoBoxes<3>::hanging_boxes(), 2);
  std::set<unsigned int> expected, found;
  for (const auto &face : scene.surface.faces())
    if (face.body == 0)
      for (const unsigned int node : face.nodes)
        if (scene.surface.masters(node).empty())
          expected.insert(node);
  for (const auto &projection : scene.projections())
    found.insert(projection.slave);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(scene.contact().n_rows(), found.size());
}

TEST(Projection, PairWithoutRowsIsNamed)
{
  auto bodies         = TwoBoxes<2>::boxes(2, 2);
  bodies[0].corner[0] = 5.;
  const TwoBoxes<2> scene(bodies, 1);
  try
    {
      scene.contact();
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("contact pair 'slave: master'"), std::string::npos);
    }
}

TEST(OuterEdges, AreTheRimAlsoWhereNodesHang)
{
  for (const unsigned int degree : {1, 2})
    {
      const TwoBoxes<3>   scene(TwoBoxes<3>::hanging_boxes(), degree);
      const FaceShape<3>  shape(degree);
      const auto          faces = master_faces(scene);
      const OuterEdges<3> edges(scene.surface, faces, shape);
      for (const unsigned int f : faces)
        for (const dealii::Point<2> &xi :
             {dealii::Point<2>(0., 0.5), dealii::Point<2>(1., 0.5), dealii::Point<2>(0.5, 0.),
              dealii::Point<2>(0.5, 1.), dealii::Point<2>(0., 0.), dealii::Point<2>(1., 1.),
              dealii::Point<2>(0.5, 0.5)})
          {
            const auto           values = shape.at(xi);
            dealii::Tensor<1, 3> x;
            for (unsigned int k = 0; k < shape.n_nodes(); ++k)
              x += values.value[k] * scene.positions[scene.surface.faces()[f].nodes[k]];
            for (unsigned int d = 0; d < 2; ++d)
              for (const double sign : {-1., 1.})
                {
                  dealii::Tensor<1, 3> offset;
                  offset[d]         = 0.1 * sign;
                  const bool at_rim = std::abs(x[d] - (sign > 0. ? 1. : 0.)) < 1e-12;
                  EXPECT_EQ(edges.excess(f, xi, offset, scene.positions) > 0.05, at_rim)
                    << "at " << x << " towards " << offset;
                }
          }
    }
}
