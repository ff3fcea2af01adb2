#include "files.h"

#include <snug/mesh/node_reach.h>
#include <snug/mesh_file/mesh_file.h>

using namespace snug;
using namespace snug::test;

namespace {
template <int dim>
double quadratic(const dealii::Tensor<1, dim> &x)
{
  const double y = x[1], z = dim == 3 ? x[dim - 1] : 0.;
  return 1. + x[0] - 2. * y + 3. * z + x[0] * x[0] - x[0] * y + 2. * y * y + 4. * z * z +
         5. * y * z - x[0] * z;
}

template <int dim>
mesh::BodyMesh<dim> mesh_of(geometry::BodyMeshParameters parameters, const std::string &text)
{
  parameters.imported = mesh_file::import_mesh(text, parameters, dim);
  return {MPI_COMM_WORLD, {parameters}, 2};
}

/// The error of quadratic functions interpolated by the masters, at the hanging nodes.
template <int dim>
double interpolation_error(const mesh::BodyMesh<dim> &mesh)
{
  const auto      &x = mesh.reference_positions();
  mesh::Field<dim> values(mesh.n_local_nodes());
  for (unsigned int node = 0; node < values.size(); ++node)
    values[node][0] = mesh.is_hanging(node) ? 0. : quadratic<dim>(x[node]);
  mesh.interpolate_hanging(values);
  double largest = 0.;
  for (unsigned int node = 0; node < values.size(); ++node)
    largest = std::max(largest, std::abs(values[node][0] - quadratic<dim>(x[node])));
  return largest;
}

/// Return the number of edges of simplices, and their corners.
unsigned long n_quadratic_nodes(const std::string &text, const unsigned int dim)
{
  const auto                                      file = mesh_file::read_mesh_file(text);
  std::set<std::pair<unsigned int, unsigned int>> nodes;
  for (const auto &element : file.elements)
    if (mesh_file::dimension(element.shape) == dim)
      for (const unsigned int a : element.corners)
        for (const unsigned int b : element.corners)
          nodes.insert(std::minmax(a, b));
  return nodes.size();
}
} // namespace

TEST(QuadraticElements, TetrahedraHaveTheNodesOfTheirEdges)
{
  for (const std::string name : {"tets-2-binary.msh", "tets-4-binary.msh"})
    {
      const auto text = contents(name);
      const auto mesh = mesh_of<3>(file_body(), text);
      EXPECT_EQ(mesh.n_global_free_nodes(), n_quadratic_nodes(text, 3));
      EXPECT_LT(interpolation_error(mesh), 1e-13);
    }
}

TEST(QuadraticElements, QuadraticFunctionsAreExactOnElementsOfAllShapes)
{
  for (const auto &row : files())
    if (row.dim == 3)
      EXPECT_LT(interpolation_error(mesh_of<3>(row.parameters, contents(row.file))), 1e-13)
        << row.file;
    else
      EXPECT_LT(interpolation_error(mesh_of<2>(row.parameters, contents(row.file))), 1e-13)
        << row.file;
}

/// The functions of a tetrahedron at the nodes of its cells give the positions, and the values of
/// masters that the constraints of each node give.
TEST(QuadraticElements, TetrahedraHoldTheNodesOfTheirCells)
{
  const auto text = contents("tets-4-binary.msh");
  const auto mesh = mesh_of<3>(file_body(), text);
  ASSERT_GT(mesh.tetrahedra().size(), 0u);
  EXPECT_EQ(4 * mesh.tetrahedra().size(), mesh.cells().size());
  const auto         &x = mesh.reference_positions();
  std::vector<double> u(3 * mesh.n_local_nodes());
  for (unsigned int i = 0; i < u.size(); ++i)
    u[i] = std::sin(double(i));
  for (const auto &tetrahedron : mesh.tetrahedra())
    for (unsigned int k = 0; k < 4; ++k)
      {
        const auto  cell = tetrahedron.cells[k];
        const auto &T    = mesh::tetrahedron_functions(k);
        EXPECT_EQ(mesh.tetrahedron(cell), &tetrahedron);
        const auto &nodes  = mesh.cells()[cell].nodes;
        const auto  direct = mesh::NodeReach<3>(mesh, nodes).values(u.data());
        const auto  values = mesh::NodeReach<3>::of_cell(mesh, cell, {}).values(u.data());
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            dealii::Tensor<1, 3> position;
            for (unsigned int a = 0; a < 10; ++a)
              position += T[10 * i + a] * x[tetrahedron.nodes[a]];
            EXPECT_LT((position - x[nodes[i]]).norm(), 1e-14);
            EXPECT_LT((values[i] - direct[i]).norm(), 1e-14);
          }
      }
}

TEST(QuadraticElements, NormalsOfTetrahedraPointOutwards)
{
  const auto  mesh = mesh_of<3>(file_body(), contents("tets-4-binary.msh"));
  const auto &x    = mesh.reference_positions();
  for (const auto &tetrahedron : mesh.tetrahedra())
    for (unsigned int opposite = 0; opposite < 4; ++opposite)
      {
        const auto face = tetrahedron.face(opposite);
        const auto normal =
          dealii::cross_product_3d(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]]);
        EXPECT_LT(normal * (x[tetrahedron.nodes[opposite]] - x[face[0]]), 0.);
        for (unsigned int e = 0; e < 3; ++e)
          EXPECT_LT((x[face[3 + e]] - 0.5 * (x[face[e]] + x[face[(e + 1) % 3]])).norm(), 1e-14);
      }
}

TEST(QuadraticElements, RefinedElementsKeepAllNodesOfTheirCells)
{
  auto parameters              = file_body();
  parameters.refine_where      = "0.7 - x";
  parameters.local_refinements = 1;
  const auto text              = contents("tets-4-binary.msh");
  const auto mesh              = mesh_of<3>(parameters, text);
  EXPECT_LT(interpolation_error(mesh), 1e-13);
  parameters.refine_where = "1";
  const auto all          = mesh_of<3>(parameters, text);
  EXPECT_TRUE(all.hanging().empty());
  EXPECT_TRUE(all.tetrahedra().empty());
  EXPECT_GT(dealii::Utilities::MPI::sum(mesh.tetrahedra().size(), MPI_COMM_WORLD), 0u);
  EXPECT_LT(mesh.n_global_free_nodes(), all.n_global_free_nodes());
  EXPECT_GT(mesh.n_global_free_nodes(), n_quadratic_nodes(text, 3));
}

TEST(QuadraticElements, CellsOfAnElementAreInOnePart)
{
  for (const std::string method : {"METIS", "grid"})
    {
      mesh::TearingParameters tearing;
      tearing.subdomains  = 5;
      tearing.method      = method;
      auto parameters     = file_body();
      parameters.imported = mesh_file::import_mesh(contents("tets-4-binary.msh"), parameters, 3);
      const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, {parameters}, 2, mesh::Idealization::natural(3),
                                   tearing);
      std::map<unsigned int, std::set<unsigned int>> parts;
      for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
        parts[mesh.geometry(0).element_part(mesh.cell_id(cell).get_coarse_cell_id()).element]
          .insert(mesh.cells()[cell].part);
      EXPECT_GT(dealii::Utilities::MPI::sum(parts.size(), MPI_COMM_WORLD), 5u);
      for (const auto &[element, of_element] : parts)
        EXPECT_EQ(of_element.size(), 1u) << element;
    }
}
