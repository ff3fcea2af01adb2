#include "files.h"

#include <map>

using namespace snug;
using namespace snug::test;

namespace {
using Parameters = geometry::BodyMeshParameters;

Parameters imported(Parameters of, const std::string &text, const unsigned int dim)
{
  of.imported = mesh_file::import_mesh(text, of, dim);
  return of;
}

/// Read the file on rank 0 alone.
Parameters shared(Parameters of, const std::string &text, const unsigned int dim)
{
  unsigned int n_reads = 0;
  of.imported          = mesh_file::import_mesh(
    MPI_COMM_WORLD,
    [&]() {
      ++n_reads;
      return text;
    },
    of, dim);
  EXPECT_EQ(n_reads, dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? 1u : 0u);
  return of;
}

/// Return the sum of the weights of the masters of a node, and of the weights times the cubes of
/// their positions, which name the masters.
template <int dim>
double masters(const mesh::BodyMesh<dim> &mesh, const unsigned int node)
{
  double sum = 0.;
  if (mesh.is_hanging(node))
    for (const auto &[master, weight] : mesh.hanging()[mesh.hanging_index(node)].masters)
      {
        const auto &x = mesh.reference_positions()[master];
        sum += weight;
        for (unsigned int d = 0; d < dim; ++d)
          sum += weight * (d + 1) * x[d] * x[d] * x[d];
      }
  return sum;
}

template <int dim>
void expect_same_cell(const mesh::BodyMesh<dim> &mesh,
                      const unsigned int         cell,
                      const mesh::BodyMesh<dim> &alone,
                      const unsigned int         other)
{
  const auto &a = mesh.cells()[cell], &b = alone.cells()[other];
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.part, b.part);
  EXPECT_EQ(a.region, b.region);
  const auto middle = geometry::unit_centre<dim>() * 0.7;
  EXPECT_EQ(mesh.true_position(cell, dealii::Point<dim>(middle)),
            alone.true_position(other, dealii::Point<dim>(middle)));
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (unsigned int i = 0; i < a.nodes.size(); ++i)
    {
      EXPECT_EQ(mesh.is_hanging(a.nodes[i]), alone.is_hanging(b.nodes[i]));
      EXPECT_NEAR(masters(mesh, a.nodes[i]), masters(alone, b.nodes[i]), 1e-11);
      // Cells agree on the position of a node up to round-off, and the first cell decides.
      EXPECT_LT(
        (mesh.reference_positions()[a.nodes[i]] - alone.reference_positions()[b.nodes[i]]).norm(),
        1e-14);
    }
}

/// Both forests have the same cells, boundaries, surfaces and nodes, in the same parts. The parts
/// of the mesh on all ranks are made as if there were few ranks.
template <int dim>
void expect_same(const mesh::Forest<dim> &of_ranks,
                 const mesh::Forest<dim> &of_one,
                 const unsigned int       degree)
{
  mesh::TearingParameters tearing;
  tearing.subdomains                = 5;
  tearing.at_least_ranks            = false;
  const auto                natural = mesh::Idealization::natural(dim);
  const mesh::BodyMesh<dim> alone(of_one, degree, natural, tearing);
  const mesh::BodyMesh<dim> mesh(of_ranks, degree, natural, tearing);
  // Other ranks have the cells of files as far as they need them. p4est needs all of them.
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    EXPECT_EQ(mesh.geometry(body).has_all_cells(),
              is_first || of_one.triangulation() != nullptr || !of_one.bodies()[body].imported);
  EXPECT_EQ(mesh.n_global_cells(), alone.n_global_cells());
  EXPECT_EQ(mesh.n_global_free_nodes(), alone.n_global_free_nodes());
  std::map<dealii::CellId, unsigned int>                          number;
  std::map<std::pair<dealii::CellId, unsigned int>, unsigned int> face_at;
  for (unsigned int cell = 0; cell < alone.cells().size(); ++cell)
    number[alone.cell_id(cell)] = cell;
  for (unsigned int f = 0; f < alone.boundary_faces().size(); ++f)
    face_at[{alone.cell_id(alone.boundary_faces()[f].cell), alone.boundary_faces()[f].number}] = f;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    expect_same_cell(mesh, cell, alone, number.at(mesh.cell_id(cell)));
  for (const auto &face : mesh.boundary_faces())
    {
      const auto &other =
        alone.boundary_faces()[face_at.at({mesh.cell_id(face.cell), face.number})];
      EXPECT_EQ(face.boundary, other.boundary);
      EXPECT_EQ(face.known_surface, other.known_surface);
      ASSERT_EQ(face.samples.size(), other.samples.size());
      for (unsigned int i = 0; i < face.samples.size(); ++i)
        EXPECT_EQ(mesh.reference_positions()[face.samples[i]],
                  alone.reference_positions()[other.samples[i]]);
    }
  const auto n_faces = mesh.boundary_faces().size();
  EXPECT_EQ(dealii::Utilities::MPI::sum(n_faces, MPI_COMM_WORLD), alone.boundary_faces().size());
}

template <int dim>
void expect_same(const std::vector<Parameters> &shared_bodies,
                 const std::vector<Parameters> &whole,
                 const unsigned int             degree)
{
  expect_same(mesh::Forest<dim>(MPI_COMM_WORLD, shared_bodies),
              mesh::Forest<dim>(MPI_COMM_SELF, whole), degree);
}

template <int dim>
void expect_same(Parameters parameters, const std::string &text)
{
  parameters.samples_all_curved = true;
  for (const unsigned int degree : {1, 2})
    for (const unsigned int refinements : {0, 1})
      {
        parameters.refinements = refinements;
        SCOPED_TRACE(parameters.file + " degree " + std::to_string(degree));
        expect_same<dim>({shared(parameters, text, dim)}, {imported(parameters, text, dim)},
                         degree);
      }
}
} // namespace

TEST(FilesOnRanks, HaveTheMeshOfOneRank)
{
  for (auto row : files())
    {
      row.parameters.file = row.file;
      if (row.dim == 2)
        expect_same<2>(row.parameters, contents(row.file));
      else
        expect_same<3>(row.parameters, contents(row.file));
    }
}

TEST(FilesOnRanks, HaveTheirCurvedSurfaces)
{
  auto body             = file_body();
  body.boundary_numbers = {{"1", "one"}};
  for (const std::string name : {"tri6.msh", "quad9.inp"})
    expect_same<2>(body, contents("quadratic/" + name));
  for (const std::string name : {"tet10.msh", "prism15.inp", "hex27.msh"})
    expect_same<3>(body, contents("quadratic/" + name));
}

TEST(FilesOnRanks, MayBePlacedAndHaveFormulas)
{
  auto body              = file_body();
  body.rotate            = {{"z", "90"}};
  body.scale             = 2.;
  body.shift             = {1., 2., 3.};
  body.region_formulas   = {{"half", "y - 4"}};
  body.boundary_formulas = {{"part", "bottom & y - 4"}};
  expect_same<3>(body, contents("block-4.msh"));
}

TEST(FilesOnRanks, MayStandBesideOtherBodies)
{
  Parameters box, ring;
  box.cells        = {3, 4, 5};
  ring.source      = geometry::Source::cylinder;
  ring.round_cells = {2, 3};
  box.complete(3);
  ring.complete(3);
  const auto text = contents("tets-2-binary.msh");
  for (const unsigned int degree : {1, 2})
    expect_same<3>({box, shared(file_body(), text, 3), ring, shared(file_body(), text, 3)},
                   {box, imported(file_body(), text, 3), ring, imported(file_body(), text, 3)},
                   degree);
}

/// The coarse cells come to all ranks when a cell is refined, after a mesh without refined cells.
TEST(FilesOnRanks, MayBeRefinedLater)
{
  const auto      text = contents("tets-4-binary.msh");
  mesh::Forest<3> of_ranks(MPI_COMM_WORLD, {shared(file_body(), text, 3)}),
    of_one(MPI_COMM_SELF, {imported(file_body(), text, 3)});
  for (const unsigned int n_refined : {0, 1, 3})
    {
      std::set<dealii::CellId> cells;
      for (unsigned int cell = 0; cell < n_refined; ++cell)
        cells.insert(dealii::CellId(7 * cell, {}));
      of_ranks.refine(cells);
      of_one.refine(cells);
      expect_same<3>(of_ranks, of_one, 2);
    }
}

TEST(FilesOnRanks, FailTogether)
{
  auto body = file_body();
  EXPECT_THROW(shared(body, "no mesh", 3), InputError);
  body.boundary_formulas = {{"part", "bottom & x - 0.3"}}; // cuts faces
  EXPECT_THROW(mesh::BodyMesh<3>(MPI_COMM_WORLD, {shared(body, contents("block-2.msh"), 3)}, 1),
               InputError);
}
