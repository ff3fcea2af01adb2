#ifndef snug_response_response_h
#define snug_response_response_h

#include <snug/base/choice.h>
#include <snug/state/state_solver.h>

#include <memory>

namespace snug
{
  namespace response
  {
    /**
     * A scalar function J(u, X) of the state and the node positions, with the
     * partial derivatives every sensitivity method is built from:
     * dJ/dalpha_j = dJ/dX . V_j + dJ/du . u'_j.
     */
    template <int dim>
    class Response
    {
    public:
      using Field = typename mesh::BodyMesh<dim>::Field;

      virtual ~Response() = default;

      /// Whether J depends on u at all, or on the geometry alone: then only
      /// the positions of a state are read.
      virtual bool
      needs_solution() const;

      /// J. Collective.
      virtual double
      value(const state::StateSolver<dim>  &solver,
            const state::ContactState<dim> &state) const = 0;

      /// dJ/dX at fixed u: this rank's share at the local nodes, hanging ones
      /// included; the sum over ranks is the whole.
      virtual Field
      position_gradient(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state) const = 0;

      /// dJ/du at fixed X, per subdomain.
      virtual feti::PrimalVectors
      state_gradient(const state::StateSolver<dim>  &solver,
                     const state::ContactState<dim> &state) const = 0;

      /// Whether total_gradient() knows dJ/dalpha without a solve.
      virtual bool
      has_total_gradient() const;

      /// dJ/dX through the state as well, as position_gradient(). Collective.
      virtual Field
      total_gradient(const state::StateSolver<dim>  &solver,
                     const state::ContactState<dim> &state) const;
    };

    /// Rows "potential energy", "compliance", "strain energy", "volume".
    template <int dim>
    const ChoiceTable<std::unique_ptr<Response<dim>>()> &
    response_table();
  } // namespace response
} // namespace snug

#endif
