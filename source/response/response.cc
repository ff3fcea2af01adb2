#include <snug/response/cell_gradients.h>
#include <snug/response/response.h>

namespace snug
{
  namespace response
  {
    template <int dim>
    bool
    Response<dim>::needs_solution() const
    {
      return true;
    }

    template <int dim>
    bool
    Response<dim>::stationary() const
    {
      return false;
    }

    namespace
    {
      template <int dim>
      typename mesh::BodyMesh<dim>::Field
      zero_field(const state::StateSolver<dim> &solver)
      {
        return
          typename mesh::BodyMesh<dim>::Field(solver.mesh().n_local_nodes());
      }

      /**
       * J = s 1/2 u'Ku + l f'u. For the potential energy, s = 1 and l = -1,
       * the derivative needs no solve, because u minimises J on the contact
       * constraints:
       * J' = 1/2 u'K'u - f''u + lambda'(B'u - g').
       */
      template <int dim>
      class Work : public Response<dim>
      {
      public:
        using State = state::ContactState<dim>;

        /// @p value: where a state holds J.
        Work(double State::*value, double stiffness, double load)
          : member(value), stiffness(stiffness), load(load)
        {
        }

        double
        value(const state::StateSolver<dim> &,
              const State &state) const override
        {
          return state.*member;
        }

        bool
        stationary() const override
        {
          return stiffness == 1. && load == -1.;
        }

        Partials<dim>
        partials(const state::StateSolver<dim> &solver,
                 const State                   &state) const override
        {
          Partials<dim> result{{}, {}, zero_field(solver)};
          const auto    f = solver.loads(state.positions, state.load_case);
          for (unsigned int s = 0; s < state.u.size(); ++s)
            {
              result.u.emplace_back(state.u[s].n_rows());
              result.u.back().add(load, f[s]);
              if (stiffness != 0.)
                solver.feti().subdomains()[s].K.multiply_add(stiffness,
                                                             state.u[s],
                                                             result.u.back());
            }
          if (stiffness != 0.)
            add_stiffness_gradient(
              solver, state, state.u, stiffness / 2., result.positions);
          if (load != 0.)
            add_load_gradient(solver, state, state.u, load, result.positions);
          return result;
        }

      private:
        double State::*member;
        double         stiffness, load; ///< s and l
      };

      /// Volume of all bodies; does not depend on u.
      template <int dim>
      class Volume : public Response<dim>
      {
      public:
        bool
        needs_solution() const override
        {
          return false;
        }

        double
        value(const state::StateSolver<dim>  &solver,
              const state::ContactState<dim> &state) const override
        {
          double volume = 0.;
          for (unsigned int body = 0; body < solver.mesh().n_bodies(); ++body)
            volume += solver.volume(body, state.positions);
          return volume;
        }

        Partials<dim>
        partials(const state::StateSolver<dim>  &solver,
                 const state::ContactState<dim> &state) const override
        {
          Partials<dim> result{{}, {}, zero_field(solver)};
          add_volume_gradient(solver, state, result.positions);
          return result;
        }
      };
    } // namespace

    template <int dim>
    const ChoiceTable<std::unique_ptr<Response<dim>>()> &
    response_table()
    {
      using State = state::ContactState<dim>;
      static const ChoiceTable<std::unique_ptr<Response<dim>>()> table = {
        {"potential energy",
         "1/2 u'Ku - f'u [force length]; its least value at fixed volume "
         "spreads the contact pressure evenly",
         []() { return std::make_unique<Work<dim>>(&State::energy, 1., -1.); }},
        {"compliance",
         "f'u, the work of the loads [force length]; with a body held by "
         "contact alone it rewards lifting that body",
         []() {
           return std::make_unique<Work<dim>>(&State::compliance, 0., 1.);
         }},
        {"strain energy",
         "1/2 u'Ku [force length]",
         []() {
           return std::make_unique<Work<dim>>(&State::strain_energy, 1., 0.);
         }},
        {"volume", "volume of all bodies [length^3]", []() {
           return std::make_unique<Volume<dim>>();
         }}};
      return table;
    }

    template class Response<2>;
    template class Response<3>;
    template const ChoiceTable<std::unique_ptr<Response<2>>()> &
    response_table<2>();
    template const ChoiceTable<std::unique_ptr<Response<3>>()> &
    response_table<3>();
  } // namespace response
} // namespace snug
