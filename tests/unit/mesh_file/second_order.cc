#include "grid_text.h"

#include <snug/geometry/block_geometry.h>
#include <snug/mesh_file/mesh_file.h>

using namespace snug;
using namespace snug::test;
using dealii::Point;

namespace {
/// Return the displacement by which gmsh moved the nodes of reference elements before it wrote the
/// files in tests/meshes/quadratic: of degree 2, and of degree 2 in each coordinate for elements
/// with nodes in the middle of faces, for a prism without x^2 y^2.
template <int dim>
Point<dim> moved(const Point<dim> &p, const bool all, const bool cube)
{
  const double x = p[0], y = p[1], z = dim == 3 ? p[dim - 1] : 0.;
  const double result[3] = {x + .1 * y * z - .08 * y * y + .05 * x * z +
                              (all ? .05 * y * y * z * z : 0.),
                            y + .07 * x * x + .1 * z * z - .06 * x * y +
                              (all ? .04 * x * x * z * z : 0.),
                            z + .09 * x * y - .05 * x * x + .04 * y * y + .03 * z * x +
                              (all && cube ? .06 * x * x * y * y : 0.)};
  Point<dim>   q;
  for (unsigned int d = 0; d < dim; ++d)
    q[d] = result[d];
  return q;
}

struct Element
{
  std::string name, nodes, element; ///< lines of gmsh_text()
  bool        all;
};

template <int dim>
std::unique_ptr<geometry::BodyGeometry<dim>> body_of(const std::string &text)
{
  auto body             = file_body();
  body.boundary_numbers = {{"1", "one"}};
  body.imported         = mesh_file::import_mesh(text, body, dim);
  return geometry::make_geometry<dim>(body);
}

/// Points of the faces of the cell's boundary, on a lattice.
template <int dim>
std::vector<geometry::MeshPoint<dim>> boundary_points(const geometry::BodyGeometry<dim> &body)
{
  std::vector<geometry::MeshPoint<dim>> result;
  const auto                            mesh = body.coarse_mesh();
  std::set<std::set<unsigned int>>      outside;
  for (const auto &face : mesh.boundary_faces)
    outside.emplace(face.first.begin(), face.first.end());
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int f = 0; f < 2 * dim; ++f)
      {
        const auto face = geometry::face_of<dim>(mesh.cells[c], f);
        if (outside.count({face.begin(), face.end()}) > 0)
          for (unsigned int i = 0; i < (dim == 3 ? 25 : 5); ++i)
            {
              Point<dim> unit;
              unit[f / 2]             = f % 2;
              unit[(f / 2 + 1) % dim] = (i % 5) / 4.;
              if (dim == 3)
                unit[(f / 2 + 2) % dim] = (i / 5) / 4.;
              result.push_back({c, unit});
            }
      }
  return result;
}

/// Blocks are the same of the file and of the straight reference element.
template <int dim>
void expect_isoparametric(const Element &element, const std::string &ending)
{
  SCOPED_TRACE(element.name + ending);
  const auto reference = body_of<dim>(gmsh_text(element.nodes, element.element));
  const auto curved    = body_of<dim>(contents("quadratic/" + element.name + ending));
  for (const auto &point : boundary_points(*reference))
    EXPECT_NEAR(curved->position(point).distance(
                  moved(reference->position(point), element.all, element.name != "prism18")),
                0., 1e-12);
  const mesh_file::MeshFile file =
    mesh_file::read_mesh_file(contents("quadratic/" + element.name + ending));
  EXPECT_GT(file.middles.size(), 2u);
}
} // namespace

TEST(SecondOrder, BoundariesAreIsoparametricInEveryFormat)
{
  const std::string hex   = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n"
                            "7 1 1 1\n8 0 1 1\n";
  const std::string prism = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n";
  const std::string tet   = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const std::string tri   = "1 0 0 0\n2 1 0 0\n3 0 1 0\n";
  const std::string quad  = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n";
  for (const std::string ending : {".msh", ".inp"})
    {
      expect_isoparametric<2>({"tri6", tri, "1 2 2 1 1 1 2 3\n", false}, ending);
      expect_isoparametric<2>({"quad8", quad, "1 3 2 1 1 1 2 3 4\n", false}, ending);
      expect_isoparametric<2>({"quad9", quad, "1 3 2 1 1 1 2 3 4\n", true}, ending);
      expect_isoparametric<3>({"tet10", tet, "1 4 2 1 1 1 2 3 4\n", false}, ending);
      expect_isoparametric<3>({"prism15", prism, "1 6 2 1 1 1 2 3 4 5 6\n", false}, ending);
      if (ending == ".msh")
        expect_isoparametric<3>({"prism18", prism, "1 6 2 1 1 1 2 3 4 5 6\n", true}, ending);
      expect_isoparametric<3>({"hex20", hex, "1 5 2 1 1 1 2 3 4 5 6 7 8\n", false}, ending);
      expect_isoparametric<3>({"hex27", hex, "1 5 2 1 1 1 2 3 4 5 6 7 8\n", true}, ending);
    }
  expect_isoparametric<3>({"hex20", hex, "1 5 2 1 1 1 2 3 4 5 6 7 8\n", false}, "-4.msh");
  expect_isoparametric<3>({"hex27", hex, "1 5 2 1 1 1 2 3 4 5 6 7 8\n", true}, "-4-binary.msh");
}

TEST(SecondOrder, SplitTetrahedraMeetOnTheirSharedFaces)
{
  // a cube of six tetrahedra, whose nodes are those of a 3 x 3 x 3 lattice, straight and moved
  std::ostringstream cells[2], points[2];
  points[1].precision(17);
  for (unsigned int i = 0; i < 27; ++i)
    {
      const Point<3> x((i % 3) / 2., (i / 3 % 3) / 2., (i / 9) / 2.);
      points[0] << i + 1 << ' ' << x << '\n';
      points[1] << i + 1 << ' ' << moved(x, false, true) << '\n';
    }
  std::array<int, 3> axes   = {{1, 3, 9}};
  unsigned int       number = 0;
  do
    {
      // along the axes from a corner to the opposite one
      std::vector<int> tet = {0, 2 * axes[0], 2 * (axes[0] + axes[1]), 26};
      if ((axes[0] < axes[1]) + (axes[1] < axes[2]) + (axes[0] < axes[2]) != 3 &&
          (axes[0] < axes[1]) + (axes[1] < axes[2]) + (axes[0] < axes[2]) != 1)
        std::swap(tet[1], tet[2]);
      ++number;
      cells[0] << number << " 4 2 1 1";
      cells[1] << number << " 11 2 1 1";
      for (const int corner : tet)
        for (auto &text : cells)
          text << ' ' << corner + 1;
      for (const auto &edge :
           {std::array<int, 2>{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{2, 3}}, {{1, 3}}})
        cells[1] << ' ' << (tet[edge[0]] + tet[edge[1]]) / 2 + 1;
      for (auto &text : cells)
        text << '\n';
  } while (std::next_permutation(axes.begin(), axes.end()));
  std::unique_ptr<geometry::BodyGeometry<3>> body[2];
  for (const unsigned int order : {0, 1})
    body[order] = body_of<3>(gmsh_text(points[order].str(), cells[order].str()));
  expect_continuous(*body[1]);
  for (const auto &point : boundary_points(*body[0]))
    EXPECT_NEAR(body[1]->position(point).distance(moved(body[0]->position(point), false, true)), 0.,
                1e-14);
}

TEST(SecondOrder, StraightElementsAreLeftAsTheyAre)
{
  const std::string square =
    gmsh_text("1 0.1 0 0\n2 1 0 0\n3 1 1 0\n4 0.1 1 0\n5 0.55 0 0\n6 1 0.5 0\n7 0.55 1 0\n"
              "8 0.1 0.5 0\n",
              "1 16 2 1 1 1 2 3 4 5 6 7 8\n");
  const auto mesh = mesh_file::import_mesh(square, file_body(), 2)->flat;
  EXPECT_TRUE(mesh->pieces.empty());
  // a middle node away from the middle of a straight edge is one all the same
  const auto moved =
    mesh_file::import_mesh(replaced(square, "0.55 0 0", "0.6 0 0"), file_body(), 2);
  auto body     = file_body();
  body.imported = moved;
  EXPECT_EQ(geometry::make_geometry<2>(body)->position({0, Point<2>(0.5, 0.)}), Point<2>(0.6, 0.));
  body.surfaces["free"] = "facets";
  body.imported         = mesh_file::import_mesh(replaced(square, "0.55 0 0", "0.6 0 0"), body, 2);
  EXPECT_TRUE(body.imported->flat->pieces.empty());
}

TEST(SecondOrder, OneRegionOfAFileHasTheMiddleNodesOfItsOwnCells)
{
  const std::string msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"left\"\n2 2 \"right\"\n"
    "$EndPhysicalNames\n$Nodes\n13\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n6 1 0.5 0\n"
    "7 0.5 1.2 0\n8 0 0.5 0\n9 2 0 0\n10 2 1 0\n11 1.5 0 0\n12 2 0.5 0\n13 1.5 0.9 0\n"
    "$EndNodes\n$Elements\n2\n1 16 2 1 1 1 2 3 4 5 6 7 8\n2 16 2 2 2 2 9 10 3 11 12 13 6\n"
    "$EndElements\n";
  for (const auto &[region, top] : {std::pair("left", 1.2), std::pair("right", 0.9)})
    {
      auto body     = file_body();
      body.regions  = {region};
      body.imported = mesh_file::import_mesh(msh, body, 2);
      EXPECT_NEAR(geometry::make_geometry<2>(body)->position({0, Point<2>(0.5, 1.)})[1], top, 1e-14)
        << region;
    }
}
