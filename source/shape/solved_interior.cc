#include <snug/base/errors.h>
#include <snug/shape/solved_interior.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::shape {
namespace {
using petsc::check;

/// Two solves to this tolerance, the second for the residual of the
/// first, leave round-off.
const double       solve_tolerance = 1e-9;
const unsigned int n_solves        = 2;

/// Coarse problems of this size are factorized.
const PetscInt direct_size = 1000;

/// row[column] += block.
template <typename Row, typename Block>
void add_block(Row &row, const unsigned int column, const Block &block)
{
  for (auto &entry : row)
    if (entry.first == column)
      {
        entry.second += block;
        return;
      }
  row.emplace_back(column, block);
}

/// The local form of a vector with ghosts, as long as this lives.
class LocalForm
{
public:
  explicit LocalForm(Vec vector) : vector(vector)
  {
    check(VecGhostGetLocalForm(vector, &local));
    check(VecGetArray(local, &values));
  }

  ~LocalForm()
  {
    VecRestoreArray(local, &values);
    VecGhostRestoreLocalForm(vector, &local);
  }

  LocalForm(const LocalForm &)            = delete;
  LocalForm &operator=(const LocalForm &) = delete;

  PetscScalar *values = nullptr;

private:
  Vec vector, local = nullptr;
};
} // namespace

template <int dim>
SolvedInterior<dim>::SolvedInterior(const ShapedFace<dim> &face,
                                    const double           reach,
                                    const InteriorKind     kind)
  : face(face), roles(face, reach)
{
  number_unknowns();
  const unsigned int n    = dealii::Utilities::MPI::sum(n_own, face.mesh().communicator());
  auto               rows = assemble(kind);
  send_to_owners(rows);
  if (n == 0)
    return;
  build_matrix(rows);
  build_solver(kind);
}

template <int dim>
void SolvedInterior<dim>::number_unknowns()
{
  using Numbers                        = std::vector<unsigned int>;
  const auto                     &mesh = face.mesh();
  const MPI_Comm                  comm = mesh.communicator();
  const unsigned int              rank = dealii::Utilities::MPI::this_mpi_process(comm);
  std::map<unsigned int, Numbers> ghosts, asked;
  unknowns.assign(mesh.n_local_nodes(), NodeRoles<dim>::none);
  for (unsigned int node = 0; node < unknowns.size(); ++node)
    if (roles.freedom(node).norm() > 0.)
      {
        if (mesh.owner(node) != rank)
          {
            ghosts[mesh.owner(node)].push_back(node);
            asked[mesh.owner(node)].push_back(mesh.global_node(node));
            continue;
          }
        unknowns[node] = nodes.size();
        nodes.push_back(node);
      }
  n_own              = nodes.size();
  unsigned int first = 0;
  MPI_Exscan(&n_own, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
  for (unsigned int i = 0; i < n_own; ++i)
    numbers.push_back((rank == 0 ? 0 : first) + i);

  // The owner knows better which nodes hang.
  std::map<unsigned int, Numbers> answers;
  for (const auto &question : dealii::Utilities::MPI::some_to_some(comm, asked))
    for (const unsigned int global : question.second)
      {
        const unsigned int i = unknowns[mesh.local_node(global)];
        answers[question.first].push_back(i == NodeRoles<dim>::none ? i : numbers[i]);
      }
  for (const auto &answer : dealii::Utilities::MPI::some_to_some(comm, answers))
    for (unsigned int k = 0; k < answer.second.size(); ++k)
      if (answer.second[k] != NodeRoles<dim>::none)
        {
          const unsigned int node = ghosts[answer.first][k];
          unknowns[node]          = nodes.size();
          nodes.push_back(node);
          numbers.push_back(answer.second[k]);
        }
}

template <int dim>
std::vector<typename SolvedInterior<dim>::Row>
SolvedInterior<dim>::assemble(const InteriorKind kind)
{
  constexpr unsigned int    none     = NodeRoles<dim>::none;
  const auto                identity = dealii::unit_symmetric_tensor<dim>();
  const InteriorMatrix<dim> cell_matrix(face.mesh(), kind);
  std::vector<Row>          rows(nodes.size());
  couplings.resize(nodes.size());
  for (const auto &cell : face.mesh().cells())
    {
      if (cell.body != face.body())
        continue;
      const auto         K = cell_matrix.of_cell(cell);
      const unsigned int m = K.nodes.size();
      for (unsigned int a = 0; a < m; ++a)
        {
          const unsigned int i = unknowns[K.nodes[a]];
          if (i == none)
            continue;
          const Block &P = roles.freedom(K.nodes[a]);
          for (unsigned int b = 0; b < m; ++b)
            {
              const unsigned int node  = K.nodes[b];
              const Block        block = P * K.blocks[a * m + b];
              if (unknowns[node] != none)
                add_block(rows[i], unknowns[node], block * roles.freedom(node));
              else if (roles.driver(node) != none)
                add_block(couplings[i], roles.driver(node), block);
            }
          add_block(rows[i], i, trace(K.blocks[a * m + a]) / dim * (Block(identity) - P));
        }
    }
  for (Row &row : rows)
    for (auto &entry : row)
      entry.first = numbers[entry.first];
  return rows;
}

/// Rows of ghosts go to their owners, who add them in the order of ranks:
/// sums that depended on the order of messages would not repeat.
template <int dim>
void SolvedInterior<dim>::send_to_owners(std::vector<Row> &rows) const
{
  const auto                                 &mesh = face.mesh();
  std::map<unsigned int, std::vector<double>> parcels;
  for (unsigned int i = n_own; i < rows.size(); ++i)
    for (const auto &entry : rows[i])
      {
        auto &parcel = parcels[mesh.owner(nodes[i])];
        parcel.push_back(numbers[i]);
        parcel.push_back(entry.first);
        for (unsigned int c = 0; c < dim * dim; ++c)
          parcel.push_back(entry.second[c / dim][c % dim]);
      }
  rows.resize(n_own);
  for (const auto &received : dealii::Utilities::MPI::some_to_some(mesh.communicator(), parcels))
    {
      const auto &parcel = received.second;
      for (unsigned int k = 0; k < parcel.size(); k += 2 + dim * dim)
        {
          Block block;
          for (unsigned int c = 0; c < dim * dim; ++c)
            block[c / dim][c % dim] = parcel[k + 2 + c];
          add_block(rows[static_cast<unsigned int>(parcel[k]) - numbers[0]], parcel[k + 1], block);
        }
    }
}

template <int dim>
void SolvedInterior<dim>::build_matrix(const std::vector<Row> &rows)
{
  const MPI_Comm        comm  = face.mesh().communicator();
  const unsigned int    first = n_own == 0 ? 0 : numbers[0];
  std::vector<PetscInt> own_columns, other_columns;
  for (const Row &row : rows)
    {
      own_columns.push_back(std::count_if(row.begin(), row.end(), [&](const auto &entry) {
        return entry.first >= first && entry.first < first + n_own;
      }));
      other_columns.push_back(row.size() - own_columns.back());
    }
  check(MatCreate(comm, matrix.put()));
  check(MatSetSizes(matrix, dim * n_own, dim * n_own, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix, dim));
  check(MatSetType(matrix, MATAIJ));
  check(MatXAIJSetPreallocation(matrix, dim, own_columns.data(), other_columns.data(), nullptr,
                                nullptr));
  for (unsigned int i = 0; i < n_own; ++i)
    for (const auto &entry : rows[i])
      {
        const PetscInt row = numbers[i], column = entry.first;
        double         values[dim * dim];
        for (unsigned int c = 0; c < dim * dim; ++c)
          values[c] = entry.second[c / dim][c % dim];
        check(MatSetValuesBlocked(matrix, 1, &row, 1, &column, values, INSERT_VALUES));
      }
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));

  const std::vector<PetscInt> ghosts(numbers.begin() + n_own, numbers.end());
  check(VecCreateGhostBlock(comm, dim, dim * n_own, PETSC_DETERMINE, ghosts.size(), ghosts.data(),
                            b.put()));
  for (petsc::Vector *vector : {&x, &residual, &correction})
    check(VecDuplicate(b, vector->put()));
}

template <int dim>
void SolvedInterior<dim>::build_solver(const InteriorKind kind)
{
  check(KSPCreate(face.mesh().communicator(), solver.put()));
  check(KSPSetOptionsPrefix(solver, "interior_"));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(solver, solve_tolerance, 0., PETSC_DEFAULT, PETSC_DEFAULT));
  PC preconditioner;
  check(KSPGetPC(solver, &preconditioner));
  check(PCSetType(preconditioner, PCGAMG));
  check(PCGAMGSetCoarseEqLim(preconditioner, direct_size));
  if (kind == InteriorKind::elasticity)
    {
      // For the rigid motions, which coarse levels must hold. Never a null
      // pointer, which means no coordinates: all ranks must agree.
      std::vector<double> places(dim * std::max(n_own, 1u));
      for (unsigned int i = 0; i < dim * n_own; ++i)
        places[i] = face.mesh().reference_positions()[nodes[i / dim]][i % dim];
      check(PCSetCoordinates(preconditioner, dim, n_own, places.data()));
    }
  check(KSPSetFromOptions(solver));
  check(KSPSetUp(solver));
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
SolvedInterior<dim>::solve(const std::vector<dealii::Tensor<1, dim>> &right_hand_side) const
{
  std::vector<dealii::Tensor<1, dim>> result(nodes.size());
  if (static_cast<Mat>(matrix) == nullptr)
    return result;
  {
    const LocalForm local(b);
    for (unsigned int i = 0; i < dim * nodes.size(); ++i)
      local.values[i] = right_hand_side[i / dim][i % dim];
  }
  check(VecGhostUpdateBegin(b, ADD_VALUES, SCATTER_REVERSE));
  check(VecGhostUpdateEnd(b, ADD_VALUES, SCATTER_REVERSE));
  check(VecSet(x, 0.));
  check(VecCopy(b, residual));
  for (unsigned int k = 0; k < n_solves; ++k)
    {
      check(KSPSolve(solver, residual, correction));
      KSPConvergedReason reason;
      check(KSPGetConvergedReason(solver, &reason));
      if (reason < 0)
        throw SolveError("the interior of a shaped body was not found: "
                         "conjugate gradients ended with PETSc's reason " +
                         std::to_string(reason));
      check(VecAXPY(x, 1., correction));
      check(MatMult(matrix, x, residual));
      check(VecAYPX(residual, -1., b));
    }
  check(VecGhostUpdateBegin(x, INSERT_VALUES, SCATTER_FORWARD));
  check(VecGhostUpdateEnd(x, INSERT_VALUES, SCATTER_FORWARD));
  const LocalForm local(x);
  for (unsigned int i = 0; i < dim * nodes.size(); ++i)
    result[i / dim][i % dim] = local.values[i];
  return result;
}

template <int dim>
typename SolvedInterior<dim>::Field SolvedInterior<dim>::extend(const FaceField &moves) const
{
  const auto                         &mesh = face.mesh();
  std::vector<dealii::Tensor<1, dim>> force(nodes.size());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    for (const auto &coupling : couplings[i])
      force[i] -= coupling.second * moves[coupling.first];
  const auto u = solve(force);
  Field      result(mesh.n_local_nodes());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    result[nodes[i]] = u[i];
  for (unsigned int node = 0; node < result.size(); ++node)
    if (roles.driver(node) != NodeRoles<dim>::none)
      result[node] = moves[roles.driver(node)];
  mesh.interpolate_hanging(result);
  return result;
}

template <int dim>
typename SolvedInterior<dim>::FaceField SolvedInterior<dim>::transpose(const Field &gradient) const
{
  const auto &mesh = face.mesh();
  Field       free = gradient;
  mesh.distribute_hanging(free);
  std::vector<dealii::Tensor<1, dim>> force(nodes.size());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    force[i] = free[nodes[i]];
  const auto          u = solve(force);
  std::vector<double> sums(dim * face.surface().n_nodes(), 0.);
  const auto          add = [&sums](unsigned int node, const dealii::Tensor<1, dim> &value) {
    for (unsigned int c = 0; c < dim; ++c)
      sums[dim * node + c] += value[c];
  };
  for (unsigned int i = 0; i < nodes.size(); ++i)
    for (const auto &coupling : couplings[i])
      add(coupling.first, -1. * (u[i] * coupling.second));
  for (unsigned int node = 0; node < free.size(); ++node)
    if (roles.driver(node) != NodeRoles<dim>::none)
      add(roles.driver(node), free[node]);
  dealii::Utilities::MPI::sum(sums, mesh.communicator(), sums);
  FaceField result(face.surface().n_nodes());
  for (unsigned int i = 0; i < sums.size(); ++i)
    result[i / dim][i % dim] = sums[i];
  return result;
}

template class SolvedInterior<2>;
template class SolvedInterior<3>;
} // namespace snug::shape
