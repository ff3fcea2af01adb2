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
     * A scalar function J of the state and the geometry, with the partial
     * derivatives every sensitivity method is built from:
     * dJ/dalpha_j = (explicit gradient . V_j) + dJ/du . u'_j.
     */
    template <int dim>
    class Response
    {
    public:
      using Field = typename mesh::BodyMesh<dim>::Field;

      virtual ~Response() = default;

      /// J. Collective.
      virtual double
      value(const state::StateSolver<dim>  &solver,
            const state::ContactState<dim> &state) const = 0;

      /**
       * The energy gradient: total dJ/dX of node positions without any solve,
       * this rank's share, hanging nodes included; false if there is none.
       */
      virtual bool
      total_gradient(const state::StateSolver<dim>  &solver,
                     const state::ContactState<dim> &state,
                     Field                          &gradient) const = 0;

      /**
       * dJ along a direction: @p velocity of the nodes with the derivative
       * @p u_derivative (per subdomain, column @p k) of the displacement.
       * Collective.
       */
      virtual double
      derivative(const state::StateSolver<dim>  &solver,
                 const state::ContactState<dim> &state,
                 const Field                    &velocity,
                 const feti::PrimalVectors      &u_derivative,
                 unsigned int                    k) const = 0;
    };

    /// Rows "potential energy", "compliance", "strain energy", "volume".
    template <int dim>
    const ChoiceTable<std::unique_ptr<Response<dim>>()> &
    response_table();
  } // namespace response
} // namespace snug

#endif
