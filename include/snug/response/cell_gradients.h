#ifndef snug_response_cell_gradients_h
#define snug_response_cell_gradients_h

#include <snug/state/state_solver.h>

namespace snug
{
  namespace response
  {
    /// gradient += factor * d/dX (w'K u) at fixed u and w, the first column of
    /// @p w; this rank's share.
    template <int dim>
    void
    add_stiffness_gradient(const state::StateSolver<dim>       &solver,
                           const state::ContactState<dim>      &state,
                           const feti::PrimalVectors           &w,
                           double                               factor,
                           typename mesh::BodyMesh<dim>::Field &gradient);

    /// gradient += factor * d/dX (f'w), the same way. Collective.
    template <int dim>
    void
    add_load_gradient(const state::StateSolver<dim>       &solver,
                      const state::ContactState<dim>      &state,
                      const feti::PrimalVectors           &w,
                      double                               factor,
                      typename mesh::BodyMesh<dim>::Field &gradient);

    /// gradient += d/dX of the volume of all bodies, this rank's share.
    template <int dim>
    void
    add_volume_gradient(const state::StateSolver<dim>       &solver,
                        const state::ContactState<dim>      &state,
                        typename mesh::BodyMesh<dim>::Field &gradient);

    /// gradient += d/dX of lambda'(B u - g) over all rows at fixed u and
    /// lambda. The share of this rank: its own nodes. Collective.
    template <int dim>
    void
    add_constraint_gradient(const state::StateSolver<dim>       &solver,
                            const state::ContactState<dim>      &state,
                            typename mesh::BodyMesh<dim>::Field &gradient);
  } // namespace response
} // namespace snug

#endif
