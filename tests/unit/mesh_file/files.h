#ifndef snug_tests_unit_mesh_file_files_h
#define snug_tests_unit_mesh_file_files_h

#include <snug/mesh/body_mesh.h>
#include <snug/mesh_file/import_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace snug::test {
inline std::string contents(const std::string &name)
{
  std::ifstream      in(SNUG_MESHES + name, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline geometry::BodyMeshParameters file_body()
{
  geometry::BodyMeshParameters parameters;
  parameters.source = geometry::Source::file;
  parameters.file   = "the.mesh";
  return parameters;
}

/// Return the parameters of a body whose file only numbers its groups of faces.
inline geometry::BodyMeshParameters numbered_body()
{
  auto parameters             = file_body();
  parameters.boundary_numbers = {{"2", "bottom"}, {"3", "top"}};
  return parameters;
}

inline std::string failure_reason(const std::string                  &text,
                                  const geometry::BodyMeshParameters &parameters,
                                  unsigned int                        dim)
{
  try
    {
      mesh_file::import_mesh(text, parameters, dim);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

/// @p text with @p from, which must be there, replaced.
inline std::string replaced(std::string text, const std::string &from, const std::string &to)
{
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

/// Return a file of Gmsh's format 2.2. @p nodes has lines "number x y z", and @p elements has lines
/// "number type 2 group entity nodes".
inline std::string gmsh_text(const std::string &nodes, const std::string &elements)
{
  const auto section = [](const std::string &name, const std::string &lines) {
    return "$" + name + '\n' + std::to_string(std::count(lines.begin(), lines.end(), '\n')) + '\n' +
           lines + "$End" + name + '\n';
  };
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + section("Nodes", nodes) +
         section("Elements", elements);
}

template <int dim>
double file_volume(const mesh::BodyMesh<dim> &mesh)
{
  const dealii::QGauss<dim> gauss(3);
  const dealii::FE_Q<dim>   fe(mesh.degree());
  const auto order = dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(mesh.degree());
  double     sum   = 0.;
  for (const auto &cell : mesh.cells())
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        dealii::Tensor<2, dim> F;
        for (unsigned int k = 0; k < cell.nodes.size(); ++k)
          F += dealii::outer_product(mesh.reference_positions()[cell.nodes[k]],
                                     fe.shape_grad(order[k], gauss.point(q)));
        EXPECT_GT(dealii::determinant(F), 0.);
        sum += dealii::determinant(F) * gauss.weight(q);
      }
  return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

/// The body fills [0,2] x [0,1]^(dim-1); its faces bottom and top are where
/// the last coordinate is 0 and 1, free ones elsewhere.
template <int dim>
void expect_block(const std::string           &text,
                  geometry::BodyMeshParameters parameters,
                  unsigned int                 n_cells)
{
  parameters.imported = mesh_file::import_mesh(text, parameters, dim);
  for (const unsigned int degree : {1, 2})
    {
      const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, {parameters}, degree);
      EXPECT_EQ(mesh.n_global_cells(), n_cells);
      EXPECT_NEAR(file_volume(mesh), 2., 1e-12);
      const auto &names = mesh.geometry(0).boundary_names();
      EXPECT_EQ(std::set<std::string>(names.begin(), names.end()),
                (std::set<std::string>{"bottom", "top", "free"}));
      for (const auto &face : mesh.boundary_faces())
        {
          double least = 1., largest = 0.;
          for (const unsigned int node : face.nodes)
            {
              const double z = mesh.reference_positions()[node][dim - 1];
              least          = std::min(least, z);
              largest        = std::max(largest, z);
            }
          // Positions of hanging nodes of quadratic elements have round-off.
          const std::string expected = largest < 1e-14      ? "bottom"
                                       : least > 1. - 1e-14 ? "top"
                                                            : "free";
          EXPECT_EQ(names[face.boundary], expected);
        }
    }
}
struct Row
{
  std::string                  file;
  geometry::BodyMeshParameters parameters;
  unsigned int                 dim, n_cells;
};

inline const std::vector<Row> &files()
{
  // Tetrahedra give 4 cells each; a quadrilateral beside triangles 4,
  // these 3.
  static const std::vector<Row> rows = {{"block-2.msh", file_body(), 3, 2},
                                        {"block-4.msh", file_body(), 3, 2},
                                        {"tets-2-binary.msh", file_body(), 3, 48},
                                        {"tets-4-binary.msh", file_body(), 3, 48},
                                        {"block.inp", file_body(), 3, 2},
                                        {"block-unnamed.msh", numbered_body(), 3, 2},
                                        {"square.msh", file_body(), 2, 10}};
  return rows;
}
} // namespace snug::test

#endif
