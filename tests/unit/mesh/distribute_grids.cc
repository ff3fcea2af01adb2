#include <snug/mesh/body_mesh.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/grid_partition.h>

#include <deal.II/base/mpi.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>

#include <gtest/gtest.h>

#include <map>

using namespace snug;

namespace {
using Bodies = std::vector<geometry::BodyMeshParameters>;

/// Graded and curved boxes and rings, open and closed, some with slender cells.
template <int dim>
Bodies bodies()
{
  Bodies result(5);
  for (auto &body : result)
    body.cells.assign(dim, dim == 2 ? 17 : 7);
  result[0].cells[1] = 11;
  result[0].grading.assign(dim, 3.);
  result[0].boundary_formulas = {{"pad", "top & x > 0"}, {"corner", "right & y > 0"}};
  result[1].cells[0]          = 3;
  result[1].fine_length.assign(dim, 0.);
  result[1].fine_length[0]       = 0.3;
  result[1].curved_faces["left"] = "0.1 * y";
  result[1].size.assign(dim, 1.);
  result[1].size.back() = 0.1;
  result[2].cells.assign(dim, 1);
  result[3].source = geometry::Source::ring;
  result[3].round_cells =
    dim == 2 ? std::vector<unsigned int>{12, 2} : std::vector<unsigned int>{3, 2, 3};
  result[4]      = result[3];
  result[4].part = geometry::Part::half;
  result[4].warp.assign(dim, "0");
  result[4].warp[0]           = "0.1 * x";
  result[4].boundary_formulas = {{"rim", "outer & y > -1"}};
  return result;
}

template <int dim>
void expect_same_cells(const dealii::parallel::fullydistributed::Triangulation<dim> &all,
                       const dealii::parallel::fullydistributed::Triangulation<dim> &grids)
{
  const dealii::FE_Q<dim> fe(2);
  dealii::DoFHandler<dim> nodes(all), others(grids);
  nodes.distribute_dofs(fe);
  others.distribute_dofs(fe);
  ASSERT_EQ(all.n_active_cells(), grids.n_active_cells());
  EXPECT_EQ(all.ghost_owners(), grids.ghost_owners());
  std::vector<dealii::types::global_dof_index> of_cell(fe.n_dofs_per_cell()), of_other = of_cell;
  auto                                         other = others.begin_active();
  for (const auto &cell : nodes.active_cell_iterators())
    {
      ASSERT_EQ(cell->subdomain_id(), other->subdomain_id());
      // The artificial cell of a rank without cells has no id.
      if (!cell->is_artificial())
        {
          EXPECT_EQ(cell->id(), other->id());
          EXPECT_EQ(cell->material_id(), other->material_id());
          for (const unsigned int v : cell->vertex_indices())
            EXPECT_EQ(cell->vertex(v), other->vertex(v));
          for (const unsigned int f : cell->face_indices())
            {
              EXPECT_EQ(cell->at_boundary(f), other->at_boundary(f));
              EXPECT_EQ(cell->face(f)->boundary_id(), other->face(f)->boundary_id());
            }
          cell->get_dof_indices(of_cell);
          other->get_dof_indices(of_other);
          EXPECT_EQ(of_cell, of_other);
        }
      ++other;
    }
}

/// Cells, ranks, parts, boundaries and numbers of nodes from the grids are those from the coarse
/// mesh of all bodies.
template <int dim>
void expect_same(const MPI_Comm communicator, const Bodies &bodies, const unsigned int subdomains)
{
  mesh::TearingParameters tearing;
  tearing.subdomains = subdomains;
  const auto by_size = mesh::cells_per_subdomain(dim, 1, mesh::Idealization::natural(dim));
  const mesh::Forest<dim>                                forest(communicator, bodies);
  dealii::parallel::fullydistributed::Triangulation<dim> all(communicator), grids(communicator);
  EXPECT_EQ(mesh::distribute_coarse(forest, mesh::QuadraticElements<dim>(forest), tearing, by_size,
                                    all)
              .parts,
            mesh::distribute_grids(*forest.geometries(), tearing, by_size, grids));
  expect_same_cells(all, grids);
}

template <int dim>
void expect_same(const MPI_Comm communicator)
{
  for (const unsigned int subdomains : {0, 7, 40})
    {
      expect_same<dim>(communicator, bodies<dim>(), subdomains);
      for (const auto &body : bodies<dim>())
        expect_same<dim>(communicator, {body}, subdomains);
    }
}

/// The parts of all cells of a grid are those of a partition of its cells.
void expect_parts(const unsigned int n, const double length, const double cells_each)
{
  SCOPED_TRACE(std::to_string(n) + " layers of the length " + std::to_string(length));
  const geometry::CellGrid<2> grid{{{n, 2}}};
  mesh::CellSet<2>            set;
  set.communicator = MPI_COMM_SELF;
  set.n_global     = 2 * n;
  set.size[0]      = length;
  set.size[1]      = 1.;
  for (unsigned int cell = 0; cell < set.n_global; ++cell)
    set.centres.emplace_back((grid.layers(cell)[0] + 0.5) / n, (grid.layers(cell)[1] + 0.5) / 2);
  const auto               partition = mesh::grid_partition(set, cells_each);
  const mesh::GridParts<2> parts(grid, set.size, cells_each);
  ASSERT_EQ(parts.n_parts(), partition.n_parts);
  std::vector<unsigned long> cells(partition.n_parts, 0);
  for (unsigned int cell = 0; cell < set.n_global; ++cell)
    {
      EXPECT_EQ(parts.part(grid.layers(cell)), partition.part[cell]);
      ++cells[partition.part[cell]];
    }
  unsigned long before = 0, n_filled = 0;
  for (unsigned int part = 0; part < cells.size(); ++part)
    {
      EXPECT_EQ(parts.cells_before(part), before);
      before += cells[part];
      n_filled += cells[part] > 0 ? 1 : 0;
      const auto [begin, end] = parts.layers(part);
      EXPECT_EQ((end[0] - begin[0]) * (end[1] - begin[1]), cells[part]);
    }
  EXPECT_EQ(parts.cells_before(parts.n_parts()), set.n_global);
  EXPECT_EQ(parts.n_filled(), n_filled);
}
} // namespace

TEST(DistributeGrids, CellsAndNodesAreThoseOfTheCoarseMesh)
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  for (int n = 1; n <= n_ranks; ++n)
    {
      SCOPED_TRACE(std::to_string(n) + " ranks");
      MPI_Comm some;
      MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : 1, rank, &some);
      if (rank < n)
        {
          expect_same<2>(some);
          expect_same<3>(some);
        }
      MPI_Comm_free(&some);
    }
}

TEST(DistributeGrids, PositionsAreThoseOfTheWholeMesh)
{
  const mesh::BodyMesh<3> whole(MPI_COMM_SELF, bodies<3>(), 2),
    mesh(MPI_COMM_WORLD, bodies<3>(), 2);
  std::map<dealii::CellId, unsigned int> place;
  for (unsigned int cell = 0; cell < whole.cells().size(); ++cell)
    place[whole.cell_id(cell)] = cell;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    {
      const auto &nodes = mesh.cells()[cell].nodes;
      const auto &same  = whole.cells()[place.at(mesh.cell_id(cell))].nodes;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        EXPECT_EQ(mesh.reference_positions()[nodes[i]], whole.reference_positions()[same[i]]);
    }
}

TEST(DistributeGrids, PartsAreThoseOfTheCells)
{
  for (unsigned int n = 1; n < 40; ++n)
    for (const double length : {0.01, 1., 30.})
      for (const double cells_each : {0.5, 1., 2., 5., 13.})
        expect_parts(n, length, cells_each);
  expect_parts(2048, 2048., 256.);
}

TEST(DistributeGrids, ManyLayersAreCutAtTheNearestLayer)
{
  const mesh::GridParts<2> parts({{{10001, 1}}}, dealii::Point<2>(4., 1.), 2500.);
  ASSERT_EQ(parts.n_parts(), 4u);
  EXPECT_EQ(parts.cells_before(1), 2500u);
  EXPECT_EQ(parts.cells_before(2), 5000u); // the lower one of two that are as near
  EXPECT_EQ(parts.cells_before(3), 7501u);
  EXPECT_EQ(parts.part({{7500, 0}}), 2u);
  EXPECT_EQ(parts.part({{7501, 0}}), 3u);
}
