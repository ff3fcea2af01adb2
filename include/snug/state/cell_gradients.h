#ifndef snug_state_cell_gradients_h
#define snug_state_cell_gradients_h

#include <snug/state/state_solver.h>

#include <functional>

namespace snug::state {
/// Call @p work(s, i) for every cell i of every subdomain s of this rank that belongs to the body
/// named @p body. An empty name stands for all bodies.
template <int dim>
void for_each_cell(const state::StateSolver<dim>                             &solver,
                   const std::string                                         &body,
                   const std::function<void(unsigned int s, unsigned int i)> &work);

/// Add values at the nodes of cell i of subdomain s to the gradient.
template <int dim>
void add_to_cell_nodes(const state::StateSolver<dim>             &solver,
                       unsigned int                               s,
                       unsigned int                               i,
                       const std::vector<dealii::Tensor<1, dim>> &values,
                       typename mesh::BodyMesh<dim>::Field       &gradient);

/// Add factor * d/dX (w'K u) at fixed u and w to the gradient, where w is the first column of @p w.
/// Add the share of this rank only.
template <int dim>
void add_stiffness_gradient(const state::StateSolver<dim>       &solver,
                            const state::ContactState<dim>      &state,
                            const feti::PrimalVectors           &w,
                            double                               factor,
                            typename mesh::BodyMesh<dim>::Field &gradient);

/// Add factor * d/dX (f'w) to the gradient, with w as in add_stiffness_gradient(). Collective.
template <int dim>
void add_load_gradient(const state::StateSolver<dim>       &solver,
                       const state::ContactState<dim>      &state,
                       const feti::PrimalVectors           &w,
                       double                               factor,
                       typename mesh::BodyMesh<dim>::Field &gradient);

/// Add d/dX of lambda'(B u - g) over all rows at fixed u and lambda to the gradient. Add the share
/// of this rank only, which is that of its own nodes. Collective.
template <int dim>
void add_constraint_gradient(const state::StateSolver<dim>       &solver,
                             const state::ContactState<dim>      &state,
                             typename mesh::BodyMesh<dim>::Field &gradient);
} // namespace snug::state

#endif
