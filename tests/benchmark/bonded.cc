#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/supports/support.h>

#include <benchmark/bonded.h>

#include <algorithm>
#include <numeric>

namespace snug::benchmark {
namespace {
using petsc::check;

const unsigned int dim = 3;

/// Local node -> the node it is glued to (itself if to none).
std::vector<unsigned int> glue(const state::StateSolver<dim> &solver)
{
  const auto               &mesh    = solver.mesh();
  const auto               &surface = solver.surface();
  std::vector<unsigned int> target(mesh.n_local_nodes());
  std::iota(target.begin(), target.end(), 0);
  const auto rows = solver.contact(0).rows(surface.gather(mesh.reference_positions()));
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const unsigned int slave = solver.contact(0).places()[i].slave;
      const auto        &c     = rows[i].coefficients;
      if (c.size() != 2)
        throw InputError("slave and master nodes do not match");
      const unsigned int master = c[c[0].first == slave].first;
      target[mesh.local_node(surface.global_node(slave))] =
        mesh.local_node(surface.global_node(master));
    }
  return target;
}
} // namespace

Bonded::Bonded(const state::StateSolver<dim> &solver, const feti::LoadedProblem &dual)
{
  number_unknowns(solver);
  assemble(solver, dual);
  wrap();
  add_rigid_motions(solver);
}

void Bonded::number_unknowns(const state::StateSolver<dim> &solver)
{
  const auto target = glue(solver);
  unknown.resize(dim * target.size());
  unsigned int n = 0;
  for (unsigned int node = 0; node < target.size(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      if (target[node] == node)
        unknown[dim * node + c] = n++;
  for (unsigned int node = 0; node < target.size(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      unknown[dim * node + c] = unknown[dim * target[node] + c];
  is_held.assign(n, false);
  const auto frames = solver.held().frames(solver.mesh().reference_positions());
  for (unsigned int node = 0; node < target.size(); ++node)
    {
      const unsigned int h = solver.held().find(solver.mesh().global_node(node));
      if (h == solver.held().n_nodes())
        continue;
      for (const auto &direction : frames.directions(h))
        for (unsigned int c = 0; c < dim; ++c)
          if (direction[c] == 1.)
            is_held[unknown[dim * node + c]] = true;
    }
}

void Bonded::assemble(const state::StateSolver<dim> &solver, const feti::LoadedProblem &dual)
{
  const auto                            &systems = dual.linearization().subdomains();
  std::vector<std::vector<unsigned int>> maps;
  for (const auto &subdomain : solver.tearing().subdomains)
    {
      maps.emplace_back();
      for (const unsigned int node : subdomain.nodes)
        for (unsigned int c = 0; c < dim; ++c)
          maps.back().push_back(unknown[dim * node + c]);
    }
  // i and j: unknowns, p: position in the subdomain's matrix
  const auto for_all_entries = [&](const auto &visit) {
    for (unsigned int s = 0; s < systems.size(); ++s)
      for (unsigned int row = 0; row < systems[s].n_dofs(); ++row)
        for (PetscInt p = systems[s].K.row_start()[row]; p < systems[s].K.row_start()[row + 1]; ++p)
          {
            const unsigned int i = maps[s][row];
            const unsigned int j = maps[s][systems[s].K.columns()[p]];
            if (i == j || !(is_held[i] || is_held[j]))
              visit(i, j, systems[s].K.values[p]);
          }
  };
  std::vector<std::vector<PetscInt>> pattern(is_held.size());
  for_all_entries([&](unsigned int i, unsigned int j, double) { pattern[i].push_back(j); });
  for (auto &row : pattern)
    {
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
    }
  K = feti::CsrMatrix::from_rows(pattern, narrow<unsigned int>(pattern.size()));
  for_all_entries(
    [&](unsigned int i, unsigned int j, double value) { K.values[K.position(i, j)] += value; });
  f = u = qp::MultiVector(K.n_rows());
  for (unsigned int s = 0; s < systems.size(); ++s)
    for (unsigned int row = 0; row < systems[s].n_dofs(); ++row)
      if (!is_held[maps[s][row]])
        f(maps[s][row]) += dual.loads()[s](row);
}

void Bonded::wrap()
{
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, K.n_rows(), K.n_rows(),
                                  const_cast<PetscInt *>(K.row_start().data()),
                                  const_cast<PetscInt *>(K.columns().data()), K.values.data(),
                                  matrix.put()));
  check(MatSetBlockSize(matrix, dim));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  check(
    VecCreateSeqWithArray(PETSC_COMM_SELF, dim, K.n_rows(), f.column(0), right_hand_side.put()));
  check(VecCreateSeqWithArray(PETSC_COMM_SELF, dim, K.n_rows(), u.column(0), solution.put()));
}

void Bonded::add_rigid_motions(const state::StateSolver<dim> &solver)
{
  petsc::Vector coordinates;
  check(VecDuplicate(solution, coordinates.put()));
  double *x;
  check(VecGetArray(coordinates, &x));
  const auto &positions = solver.mesh().reference_positions();
  for (unsigned int i = 0; i < unknown.size(); ++i)
    x[unknown[i]] = positions[i / dim][i % dim];
  check(VecRestoreArray(coordinates, &x));
  petsc::NullSpace motions;
  check(MatNullSpaceCreateRigidBody(coordinates, motions.put()));
  check(MatSetNearNullSpace(matrix, motions));
}

double Bonded::residual() const
{
  qp::MultiVector rest = f;
  K.multiply_add(-1., u, rest);
  return qp::norms(rest, MPI_COMM_SELF)[0] / qp::norms(f, MPI_COMM_SELF)[0];
}
} // namespace snug::benchmark
