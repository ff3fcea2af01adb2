#include <snug/base/errors.h>
#include <snug/base/petsc_handle.h>
#include <snug/base/petsc_options.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/shape/interior.h>
#include <snug/shape/interior_matrix.h>
#include <snug/shape/node_roles.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/map.hpp>

#include <algorithm>
#include <map>

namespace snug::shape {
namespace {
using petsc::check;

/// Relative tolerance of one solve. Two solves to this tolerance reduce the error to round-off,
/// because the second solve has the residual of the first as its right-hand side.
const double       solve_tolerance = 1e-9;
const unsigned int n_solves        = 2;

/// Up to this number of equations the matrix is factorized. Measured in 3D with 30k nodes of degree
/// 2 and 8 variables: 2 s instead of 36 s with multigrid, 10 % more memory. With more equations
/// factors take too much memory.
const PetscInt most_factorized = 100000;

/// Multigrid stops coarsening below this number of equations and factorizes the coarse problem.
const PetscInt direct_size = 1000;

template <int dim>
class SolvedInterior : public Interior<dim>
{
public:
  using Field     = typename Interior<dim>::Field;
  using FaceField = typename Interior<dim>::FaceField;

  SolvedInterior(const ShapedFace<dim> &face, const double reach, const InteriorKind kind)
    : mesh(face.mesh()), roles(face, reach)
  {
    number_unknowns();
    auto rows = assemble(kind, face.body());
    send_to_owners(rows);
    if (dealii::Utilities::MPI::sum<unsigned long>(own.size(), mesh.communicator()) == 0)
      return;
    build_matrix(rows);
    build_solver(kind);
  }

  Field extend(const FaceField &moves) const override
  {
    Field force(numbers.size());
    for (unsigned int node = 0; node < force.size(); ++node)
      // The forces contain the cells of this rank alone, because solve() sums forces over ranks.
      for (const auto &[surface_node, block] : couplings[node])
        force[node] -= block * moves[surface_node];
    Field result = solve(force);
    for (unsigned int node = 0; node < result.size(); ++node)
      if (roles.face_node(node) != none)
        result[node] = moves[roles.face_node(node)];
    return result;
  }

private:
  using Block                        = dealii::Tensor<2, dim>;
  static constexpr unsigned int none = NodeRoles<dim>::none;
  /// The blocks of one row, by column.
  using Row = std::map<unsigned int, Block>;

  void number_unknowns()
  {
    const unsigned int  rank = dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
    std::vector<double> sums(mesh.n_local_nodes(), 0.);
    for (unsigned int node = 0; node < sums.size(); ++node)
      if (roles.free_directions(node).norm() > 0. && mesh.owner(node) == rank)
        own.push_back(node);
    const unsigned int n = own.size();
    MPI_Scan(&n, &first, 1, MPI_UNSIGNED, MPI_SUM, mesh.communicator());
    first -= n;
    // Numbers begin with 1, so that 0 means a node without an unknown on the rank that owns the
    // node. The owner decides, because only the owner knows for certain whether the node hangs.
    for (unsigned int i = 0; i < n; ++i)
      sums[own[i]] = 1. + first + i;
    mesh::sum_at_shared_nodes(mesh, 1, sums);
    for (unsigned int node = 0; node < sums.size(); ++node)
      numbers.push_back(sums[node] > 0. && roles.free_directions(node).norm() > 0. ? sums[node] - 1.
                                                                                   : none);
  }

  /// Assemble the blocks of the cells of this rank. Return the rows of A_ff by local node, with
  /// numbers of unknowns as columns, and store A_fd in couplings.
  std::vector<Row> assemble(const InteriorKind kind, const unsigned int body)
  {
    const auto                identity = dealii::unit_symmetric_tensor<dim>();
    const InteriorMatrix<dim> cell_matrix(mesh, kind);
    std::vector<Row>          rows(numbers.size());
    couplings.resize(numbers.size());
    for (const auto &cell : mesh.cells())
      {
        if (cell.body != body)
          continue;
        const auto         K = cell_matrix.of_cell(cell);
        const unsigned int m = K.nodes.size();
        for (unsigned int a = 0; a < m; ++a)
          {
            const unsigned int row = K.nodes[a];
            if (numbers[row] == none)
              continue;
            const Block &P = roles.free_directions(row);
            for (unsigned int b = 0; b < m; ++b)
              {
                const unsigned int node  = K.nodes[b];
                const Block        block = P * K.blocks[a * m + b];
                if (numbers[node] != none)
                  rows[row][numbers[node]] += block * roles.free_directions(node);
                else if (roles.face_node(node) != none)
                  couplings[row][roles.face_node(node)] += block;
              }
            // In the directions in which the node may not move, a diagonal of the same size as in
            // the other directions keeps A_ff regular and does not change its condition number.
            rows[row][numbers[row]] += trace(K.blocks[a * m + a]) / dim * (Block(identity) - P);
          }
      }
    return rows;
  }

  /// Send the rows of ghost nodes to the owners of the nodes. The owners add the rows in the order
  /// of ranks, because sums in the order of messages would not be reproducible.
  void send_to_owners(std::vector<Row> &rows) const
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
    std::map<unsigned int, std::map<unsigned int, Row>> parcels;
    for (unsigned int node = 0; node < rows.size(); ++node)
      // The parcel names the number of the unknown, because local indices differ between ranks.
      if (mesh.owner(node) != rank && !rows[node].empty())
        parcels[mesh.owner(node)][numbers[node]] = rows[node];
    for (const auto &received : dealii::Utilities::MPI::some_to_some(mesh.communicator(), parcels))
      for (const auto &[number, row] : received.second)
        for (const auto &[column, block] : row)
          rows[own[number - first]][column] += block;
  }

  void build_matrix(const std::vector<Row> &rows)
  {
    const unsigned int    n = own.size();
    std::vector<PetscInt> own_columns, other_columns;
    for (const unsigned int node : own)
      {
        const Row &row = rows[node];
        own_columns.push_back(std::distance(row.lower_bound(first), row.lower_bound(first + n)));
        other_columns.push_back(row.size() - own_columns.back());
      }
    check(MatCreate(mesh.communicator(), matrix.put()));
    check(MatSetSizes(matrix, dim * n, dim * n, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetBlockSize(matrix, dim));
    check(MatSetType(matrix, MATAIJ));
    check(MatXAIJSetPreallocation(matrix, dim, own_columns.data(), other_columns.data(), nullptr,
                                  nullptr));
    for (const unsigned int node : own)
      for (const auto &entry : rows[node])
        {
          const PetscInt row = numbers[node], column = entry.first;
          check(
            MatSetValuesBlocked(matrix, 1, &row, 1, &column, &entry.second[0][0], INSERT_VALUES));
        }
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
    check(MatCreateVecs(matrix, x.put(), b.put()));
    for (petsc::Vector *vector : {&residual, &correction})
      check(VecDuplicate(b, vector->put()));
  }

  void build_solver(const InteriorKind kind)
  {
    check(KSPCreate(mesh.communicator(), solver.put()));
    check(KSPSetOptionsPrefix(solver, "interior_"));
    check(KSPSetOperators(solver, matrix, matrix));
    check(KSPSetType(solver, KSPCG));
    check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
    PetscReal divergence;
    PetscInt  max_iterations;
    check(KSPGetTolerances(solver, nullptr, nullptr, &divergence, &max_iterations));
    check(KSPSetTolerances(solver, solve_tolerance, 0., divergence, max_iterations));
    PC       preconditioner;
    PetscInt n_equations;
    check(KSPGetPC(solver, &preconditioner));
    check(MatGetSize(matrix, &n_equations, nullptr));
    const std::string type =
      petsc::option("interior_", "pc_type", n_equations > most_factorized ? PCGAMG : PCCHOLESKY);
    if (type == PCGAMG)
      add_multigrid(preconditioner, kind);
    else
      {
        check(PCSetType(preconditioner, PCCHOLESKY));
        check(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS));
      }
    check(KSPSetFromOptions(solver));
    check(KSPSetUp(solver));
  }

  void add_multigrid(PC preconditioner, const InteriorKind kind) const
  {
    check(PCSetType(preconditioner, PCGAMG));
    check(PCGAMGSetCoarseEqLim(preconditioner, direct_size));
    if (kind == InteriorKind::elasticity)
      {
        // PETSc derives the rigid motions, which coarse levels must represent, from the
        // coordinates. The pointer must not be null on ranks without unknowns, because PETSc takes
        // a null pointer for no coordinates and all ranks must agree.
        std::vector<double> places(dim * std::max<std::size_t>(own.size(), 1));
        for (unsigned int i = 0; i < dim * own.size(); ++i)
          places[i] = mesh.reference_positions()[own[i / dim]][i % dim];
        check(PCSetCoordinates(preconditioner, dim, own.size(), places.data()));
      }
  }

  /// Return A_ff^-1 force at the unknowns and zero at other nodes. The contributions of all ranks
  /// to @p force are added up.
  Field solve(const Field &force) const
  {
    Field result(force.size());
    if (static_cast<Mat>(matrix) == nullptr)
      return result;
    std::vector<double> sums(dim * force.size());
    for (unsigned int i = 0; i < sums.size(); ++i)
      sums[i] = force[i / dim][i % dim];
    mesh::sum_at_shared_nodes(mesh, dim, sums);
    PetscScalar *values;
    check(VecGetArray(b, &values));
    for (unsigned int i = 0; i < dim * own.size(); ++i)
      values[i] = sums[dim * own[i / dim] + i % dim];
    check(VecRestoreArray(b, &values));
    check(VecSet(x, 0.));
    check(VecCopy(b, residual));
    for (unsigned int k = 0; k < n_solves; ++k)
      {
        check(KSPSolve(solver, residual, correction));
        KSPConvergedReason reason;
        check(KSPGetConvergedReason(solver, &reason));
        if (reason < 0)
          throw SolveError("the interior motion of a shaped body was not "
                           "computed: conjugate gradients stopped with PETSc's reason " +
                           std::to_string(reason));
        check(VecAXPY(x, 1., correction));
        check(MatMult(matrix, x, residual));
        check(VecAYPX(residual, -1., b));
      }
    // Only owners have nonzero values, so sums over ranks copy the values of owners to all ranks.
    std::fill(sums.begin(), sums.end(), 0.);
    check(VecGetArray(x, &values));
    for (unsigned int i = 0; i < dim * own.size(); ++i)
      sums[dim * own[i / dim] + i % dim] = values[i];
    check(VecRestoreArray(x, &values));
    mesh::sum_at_shared_nodes(mesh, dim, sums);
    for (unsigned int i = 0; i < sums.size(); ++i)
      result[i / dim][i % dim] = sums[i];
    return result;
  }

  const mesh::BodyMesh<dim> &mesh;
  NodeRoles<dim>             roles;

  std::vector<unsigned int> own;       ///< local nodes of the unknowns of this rank
  unsigned int              first = 0; ///< number of the first unknown of this rank
  std::vector<unsigned int> numbers;   ///< unknowns of local nodes, or none; unique over ranks
  std::vector<Row>          couplings; ///< A_fd by local nodes, with surface nodes as columns

  petsc::Matrix matrix; ///< A_ff; null if no node is free
  petsc::Solver solver;
  petsc::Vector b, x, residual, correction;
};

} // namespace

template <int dim>
std::unique_ptr<Interior<dim>> solved_interior(const ShapedFace<dim> &face,
                                               const ShapeParameters &parameters)
{
  return std::make_unique<SolvedInterior<dim>>(face, parameters.reach, parameters.interior);
}

template std::unique_ptr<Interior<2>> solved_interior(const ShapedFace<2> &,
                                                      const ShapeParameters &);
template std::unique_ptr<Interior<3>> solved_interior(const ShapedFace<3> &,
                                                      const ShapeParameters &);
} // namespace snug::shape
