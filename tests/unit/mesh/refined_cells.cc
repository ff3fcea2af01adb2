#include <snug/mesh/refined_cells.h>
#include <snug/mesh/surface.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace snug;

namespace {
using Bodies = std::vector<geometry::BodyMeshParameters>;
using Cells  = std::set<dealii::CellId>;

/// Return the mesh of bodies with cells refined in one step.
template <int dim>
mesh::BodyMesh<dim>
refined(const Bodies &bodies, const Cells &cells, unsigned int degree, MPI_Comm communicator)
{
  mesh::Forest<dim> forest(communicator, bodies);
  forest.refine(cells);
  return {forest, degree, mesh::Idealization::natural(dim), mesh::TearingParameters()};
}

Bodies disc_and_box(unsigned int dim)
{
  Bodies bodies(2);
  bodies[0].source             = dim == 2 ? geometry::Source::disc : geometry::Source::sphere;
  bodies[0].round_cells        = {dim == 2 ? 4u : 2u};
  bodies[0].sampled_boundaries = {"outer"};
  bodies[1].cells              = std::vector<unsigned int>(dim, 2);
  bodies[1].size               = std::vector<double>(dim, 1.);
  bodies[1].corner             = std::vector<double>(dim, 3.);
  return bodies;
}

template <int dim>
std::vector<dealii::CellId> ids(const mesh::BodyMesh<dim> &mesh)
{
  std::vector<dealii::CellId> mine;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    mine.push_back(mesh.cell_id(cell));
  return mesh::gather_cells(mine, mesh.communicator());
}

/// How often cells are refined.
template <int dim>
constexpr unsigned int n_steps = dim == 2 ? 3 : 2;

/// Refine, again and again, all cells whose number is a multiple of 7.
template <int dim>
Cells some_cells(const Bodies &bodies, unsigned int degree, MPI_Comm communicator)
{
  Cells cells;
  for (unsigned int step = 0; step < n_steps<dim>; ++step)
    {
      const auto mesh = refined<dim>(bodies, cells, degree, communicator);
      const auto all  = ids(mesh);
      for (unsigned int i = 0; i < all.size(); i += 7)
        mesh::refine(all[i], cells);
    }
  return cells;
}

template <int dim>
void check_ranks()
{
  const auto bodies = disc_and_box(dim);
  const auto cells  = some_cells<dim>(bodies, 1, MPI_COMM_WORLD);
  const auto mesh   = refined<dim>(bodies, cells, 1, MPI_COMM_WORLD);
  EXPECT_EQ(cells, some_cells<dim>(bodies, 1, MPI_COMM_SELF));
  const auto alone = refined<dim>(bodies, cells, 1, MPI_COMM_SELF);
  EXPECT_EQ(ids(mesh), ids(alone));
  EXPECT_EQ(mesh.n_global_free_nodes(), alone.n_global_free_nodes());
  // what is wanted is there
  for (const auto &cell : ids(mesh))
    EXPECT_EQ(cells.count(cell), 0u) << cell;
}

/// Levels of cells that share a node, also over edges and corners only.
template <int dim>
void check_balance()
{
  const auto                bodies = disc_and_box(dim);
  const auto                cells  = some_cells<dim>(bodies, 1, MPI_COMM_SELF);
  const auto                mesh   = refined<dim>(bodies, cells, 1, MPI_COMM_SELF);
  std::vector<unsigned int> least(mesh.n_local_nodes(), 99), most(mesh.n_local_nodes(), 0);
  unsigned int              highest = 0;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    for (const unsigned int node : mesh.cells()[cell].nodes)
      {
        const unsigned int level = mesh::level(mesh.cell_id(cell));
        least[node]              = std::min(least[node], level);
        most[node]               = std::max(most[node], level);
        highest                  = std::max(highest, level);
      }
  EXPECT_EQ(highest, n_steps<dim>);
  for (unsigned int node = 0; node < least.size(); ++node)
    EXPECT_LE(most[node], least[node] + 1);
}

/// Nodes of faces that do not hang, and all samples, lie on the sphere.
template <int dim>
void check_true_surface(unsigned int degree)
{
  const auto   bodies = disc_and_box(dim);
  const auto   cells  = some_cells<dim>(bodies, degree, MPI_COMM_WORLD);
  const auto   mesh   = refined<dim>(bodies, cells, degree, MPI_COMM_WORLD);
  unsigned int n      = 0;
  for (const auto &face : mesh.boundary_faces())
    if (face.body == 0)
      {
        for (const unsigned int node : face.nodes)
          EXPECT_TRUE(mesh.is_hanging(node) ||
                      std::abs(mesh.reference_positions()[node].norm() - 1.) < 1e-12);
        for (const unsigned int sample : face.samples)
          EXPECT_NEAR(mesh.reference_positions()[sample].norm(), 1., 1e-12);
        n += face.samples.size();
      }
  EXPECT_GT(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 0u);
}
/// Return the part of each cell of all ranks.
template <int dim>
std::map<dealii::CellId, unsigned int> parts(const mesh::BodyMesh<dim> &mesh)
{
  std::map<dealii::CellId, unsigned int> mine, all;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    mine[mesh.cell_id(cell)] = mesh.cells()[cell].part;
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(
         mesh.communicator(),
         std::vector<std::pair<dealii::CellId, unsigned int>>(mine.begin(), mine.end())))
    all.insert(of_rank.begin(), of_rank.end());
  return all;
}

/// Compare the parts of a forest refined step by step with those of a forest refined at once, on
/// all ranks and on one.
template <int dim>
void check_history()
{
  const auto        bodies = disc_and_box(dim);
  mesh::Forest<dim> step_by_step(MPI_COMM_WORLD, bodies);
  Cells             cells;
  for (unsigned int step = 0; step < n_steps<dim>; ++step)
    {
      const mesh::BodyMesh<dim> untorn(step_by_step, 1, mesh::Idealization::natural(dim), {});
      const auto                all = ids(untorn);
      for (unsigned int i = 0; i < all.size(); i += 7)
        mesh::refine(all[i], cells);
      step_by_step.refine(cells);
    }
  mesh::TearingParameters tearing;
  tearing.method     = "METIS";
  tearing.subdomains = 12;
  const auto natural = mesh::Idealization::natural(dim);
  const auto found   = parts(mesh::BodyMesh<dim>(step_by_step, 1, natural, tearing));
  for (MPI_Comm communicator : {MPI_COMM_WORLD, MPI_COMM_SELF})
    {
      mesh::Forest<dim> at_once(communicator, bodies);
      at_once.refine(cells);
      EXPECT_EQ(found, parts(mesh::BodyMesh<dim>(at_once, 1, natural, tearing)));
    }
}
} // namespace

TEST(RefinedCells, DoNotDependOnTheStepsOfRefinement)
{
  check_history<2>();
  check_history<3>();
}

TEST(RefinedCells, HaveTheirAncestors)
{
  const dealii::CellId cell(3, {1, 2});
  Cells                cells;
  mesh::refine(cell, cells);
  const Cells expected = {cell, dealii::CellId(3, {1}), dealii::CellId(3, {})};
  EXPECT_EQ(cells, expected);
  EXPECT_EQ(mesh::parent(cell), dealii::CellId(3, {1}));
  EXPECT_EQ(mesh::level(cell), 2u);
}

TEST(RefinedCells, MakeTheSameMeshOnAnyRanks)
{
  check_ranks<2>();
  check_ranks<3>();
}

TEST(RefinedCells, LeaveNeighboursWithinOneLevel)
{
  check_balance<2>();
  check_balance<3>();
}

TEST(RefinedCells, HaveNodesOnTheTrueSurface)
{
  for (const unsigned int degree : {1, 2})
    {
      check_true_surface<2>(degree);
      check_true_surface<3>(degree);
    }
}

TEST(RefinedCells, GoAgain)
{
  // without the cells: the mesh as given
  const auto              bodies = disc_and_box(2);
  const mesh::BodyMesh<2> given(MPI_COMM_WORLD, bodies, 1);
  const auto              none = refined<2>(bodies, {}, 1, MPI_COMM_WORLD);
  EXPECT_EQ(ids(given), ids(none));
}

TEST(Surface, KnowsTheCellsOfItsFaces)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, disc_and_box(3), 1);
  const mesh::Surface<3>  surface(mesh, {{1, 5}});
  unsigned int            n = 0;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    for (const unsigned int cell : surface.cells_of({f}))
      {
        EXPECT_EQ(mesh.cells()[cell].body, 1u);
        ++n;
      }
  EXPECT_EQ(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 4u);
}
