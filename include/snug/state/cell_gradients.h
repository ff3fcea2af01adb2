#ifndef snug_state_cell_gradients_h
#define snug_state_cell_gradients_h

#include <snug/state/state_solver.h>

#include <functional>

namespace snug::state {
/// Call @p work(s, i) for every cell i of every subdomain s of this rank
/// that belongs to the body called @p body; empty: to any.
template <int dim>
void for_each_cell(const state::StateSolver<dim>                             &solver,
                   const std::string                                         &body,
                   const std::function<void(unsigned int s, unsigned int i)> &work);

/// gradient += values at the nodes of cell i of subdomain s.
template <int dim>
void add_to_cell_nodes(const state::StateSolver<dim>             &solver,
                       unsigned int                               s,
                       unsigned int                               i,
                       const std::vector<dealii::Tensor<1, dim>> &values,
                       typename mesh::BodyMesh<dim>::Field       &gradient);

/// gradient += factor * d/dX (w'K u) at fixed u and w, the first column of
/// @p w; this rank's share.
template <int dim>
void add_stiffness_gradient(const state::StateSolver<dim>       &solver,
                            const state::ContactState<dim>      &state,
                            const feti::PrimalVectors           &w,
                            double                               factor,
                            typename mesh::BodyMesh<dim>::Field &gradient);

/// gradient += factor * d/dX (f'w), the same way. Collective.
template <int dim>
void add_load_gradient(const state::StateSolver<dim>       &solver,
                       const state::ContactState<dim>      &state,
                       const feti::PrimalVectors           &w,
                       double                               factor,
                       typename mesh::BodyMesh<dim>::Field &gradient);

/// gradient += d/dX of lambda'(B u - g) over all rows at fixed u and
/// lambda. The share of this rank: its own nodes. Collective.
template <int dim>
void add_constraint_gradient(const state::StateSolver<dim>       &solver,
                             const state::ContactState<dim>      &state,
                             typename mesh::BodyMesh<dim>::Field &gradient);
} // namespace snug::state

#endif
