#include <snug/accuracy/jumps.h>
#include <snug/elasticity/element.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/state/continuity.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::accuracy {
template <int dim>
mesh::Field<dim> jump(const state::StateSolver<dim> &solver,
                      const feti::PrimalVectors     &torn,
                      const feti::PrimalVectors     &continuous,
                      const unsigned int             j)
{
  const auto         &mesh = solver.mesh();
  std::vector<double> sums(static_cast<std::size_t>(dim) * mesh.n_local_nodes(), 0.);
  for (unsigned int s = 0; s < torn.size(); ++s)
    {
      const auto &nodes = solver.tearing().subdomains[s].nodes;
      for (unsigned int i = 0; i < dim * nodes.size(); ++i)
        sums[static_cast<std::size_t>(dim) * nodes[i / dim] + i % dim] +=
          dealii::Utilities::fixed_power<2>(torn[s](i, j) - continuous[s](i, j));
    }
  mesh::sum_at_shared_nodes(mesh, dim, sums);
  mesh::Field<dim> result(mesh.n_local_nodes());
  for (unsigned int i = 0; i < sums.size(); ++i)
    result[i / dim][i % dim] = std::sqrt(sums[i]);
  mesh.interpolate_hanging(result);
  return mesh::owners_values(mesh, result);
}

namespace {
/// Return the energy norm of a field at all local nodes. Collective.
template <int dim>
double energy_norm(const state::StateSolver<dim>  &solver,
                   const state::ContactState<dim> &state,
                   const mesh::Field<dim>         &field)
{
  // Motions of reference points, which follow the nodes, have no jumps.
  feti::PrimalVectors torn;
  for (unsigned int s = 0; s < state.u.size(); ++s)
    {
      const auto &nodes = solver.tearing().subdomains[s].nodes;
      torn.emplace_back(state.u[s].n_rows());
      for (unsigned int i = 0; i < dim * nodes.size(); ++i)
        torn.back()(i, 0) = field[nodes[i / dim]][i % dim];
    }
  return state::energy_norms(solver.feti(state), torn)[0];
}
} // namespace

/// The flux of a stiff cell acts on a soft one, and that of a dilatation on shear. In a flat cell
/// it acts over the large faces on functions that bend them. Without the factor of safety the bound
/// of rough fields was at least 1.7 times the norm (test EnergyEstimate.BoundsErrorsOfJumps).
template <int dim>
double bound_of_errors(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state,
                       const mesh::Field<dim>         &jump)
{
  const double                        safety = 2.;
  const auto                         &mesh   = solver.mesh();
  const elasticity::Element<dim>      element(mesh.degree(), mesh.idealization());
  double                              stiffest = 0., softness = 0., aspect = 1.;
  std::vector<dealii::Tensor<1, dim>> X;
  for (const auto &cell : mesh.cells())
    {
      const auto &material = solver.model().bodies[cell.body].material(cell);
      stiffest             = std::max(stiffest, material.lame_lambda() + 2. * material.lame_mu());
      softness             = std::max(softness, 1. / material.lame_mu());
      X.clear();
      for (const unsigned int node : cell.nodes)
        X.push_back(state.positions[node]);
      aspect = std::max(aspect, element.aspect(X));
    }
  std::array<double, 3> largest = {{stiffest, softness, aspect}};
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 3, MPI_DOUBLE, MPI_MAX, mesh.communicator());
  return safety * std::sqrt(largest[0] * largest[1]) * largest[2] *
         energy_norm(solver, state, jump);
}

template <int dim>
double error_of_jump(const LocalErrors<dim>         &local,
                     const state::StateSolver<dim>  &solver,
                     const state::ContactState<dim> &state,
                     const mesh::Field<dim>         &jump,
                     const double                    allowed)
{
  if (const double bound = bound_of_errors(solver, state, jump); bound <= allowed)
    return bound;
  double square = 0.;
  for (const auto &cell : local.products({{jump, {}, {}, {}, 0., 0.}}))
    square += cell.norms[0] * cell.norms[0];
  return std::sqrt(dealii::Utilities::MPI::sum(square, solver.mesh().communicator()));
}

#define SNUG_INSTANTIATE(dim)                                                                            \
  template mesh::Field<dim> jump(const state::StateSolver<dim> &, const feti::PrimalVectors &,           \
                                 const feti::PrimalVectors &, unsigned int);                             \
  template double           bound_of_errors(const state::StateSolver<dim> &,                             \
                                            const state::ContactState<dim> &, const mesh::Field<dim> &); \
  template double           error_of_jump(const LocalErrors<dim> &, const state::StateSolver<dim> &,     \
                                          const state::ContactState<dim> &, const mesh::Field<dim> &,    \
                                          double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
