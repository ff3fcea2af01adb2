#include <snug/response/cell_gradients.h>
#include <snug/response/response.h>

#include <deal.II/base/exceptions.h>

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
    Response<dim>::has_total_gradient() const
    {
      return false;
    }

    template <int dim>
    typename Response<dim>::Field
    Response<dim>::total_gradient(const state::StateSolver<dim> &,
                                  const state::ContactState<dim> &) const
    {
      AssertThrow(false,
                  dealii::ExcMessage("This response has no total gradient."));
      return {};
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

      /// K u per subdomain.
      template <int dim>
      feti::PrimalVectors
      stiffness_times_u(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state)
      {
        feti::PrimalVectors Ku;
        for (unsigned int s = 0; s < state.u.size(); ++s)
          {
            Ku.emplace_back(state.u[s].n_rows());
            solver.feti().subdomains()[s].K.multiply_add(1.,
                                                         state.u[s],
                                                         Ku.back());
          }
        return Ku;
      }

      /**
       * J = 1/2 u'Ku - f'u. Its total derivative needs no solve, because u
       * minimises J on the contact constraints:
       * J' = 1/2 u'K'u - f''u + lambda'(B'u - g').
       */
      template <int dim>
      class PotentialEnergy : public Response<dim>
      {
      public:
        using Field = typename Response<dim>::Field;

        double
        value(const state::StateSolver<dim> &,
              const state::ContactState<dim> &state) const override
        {
          return state.energy;
        }

        Field
        position_gradient(const state::StateSolver<dim>  &solver,
                          const state::ContactState<dim> &state) const override
        {
          Field gradient = zero_field(solver);
          add_stiffness_gradient(solver, state, 0.5, gradient);
          add_load_gradient(solver, state, -1., gradient);
          return gradient;
        }

        feti::PrimalVectors
        state_gradient(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state) const override
        {
          auto       gradient = stiffness_times_u(solver, state);
          const auto f        = solver.feti().loads();
          for (unsigned int s = 0; s < f.size(); ++s)
            gradient[s].add(-1., f[s]);
          return gradient;
        }

        bool
        has_total_gradient() const override
        {
          return true;
        }

        Field
        total_gradient(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state) const override
        {
          Field gradient = position_gradient(solver, state);
          add_contact_gradient(solver, state, gradient);
          return gradient;
        }
      };

      /// C = f'u.
      template <int dim>
      class Compliance : public Response<dim>
      {
      public:
        using Field = typename Response<dim>::Field;

        double
        value(const state::StateSolver<dim> &,
              const state::ContactState<dim> &state) const override
        {
          return state.compliance;
        }

        Field
        position_gradient(const state::StateSolver<dim>  &solver,
                          const state::ContactState<dim> &state) const override
        {
          Field gradient = zero_field(solver);
          add_load_gradient(solver, state, 1., gradient);
          return gradient;
        }

        feti::PrimalVectors
        state_gradient(const state::StateSolver<dim> &solver,
                       const state::ContactState<dim> &) const override
        {
          return solver.feti().loads();
        }
      };

      /// E = 1/2 u'Ku.
      template <int dim>
      class StrainEnergy : public Response<dim>
      {
      public:
        using Field = typename Response<dim>::Field;

        double
        value(const state::StateSolver<dim> &,
              const state::ContactState<dim> &state) const override
        {
          return state.strain_energy;
        }

        Field
        position_gradient(const state::StateSolver<dim>  &solver,
                          const state::ContactState<dim> &state) const override
        {
          Field gradient = zero_field(solver);
          add_stiffness_gradient(solver, state, 0.5, gradient);
          return gradient;
        }

        feti::PrimalVectors
        state_gradient(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state) const override
        {
          return stiffness_times_u(solver, state);
        }
      };

      /// Volume of all bodies; does not depend on u.
      template <int dim>
      class Volume : public Response<dim>
      {
      public:
        using Field = typename Response<dim>::Field;

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

        Field
        position_gradient(const state::StateSolver<dim>  &solver,
                          const state::ContactState<dim> &state) const override
        {
          Field gradient = zero_field(solver);
          for (const auto &cell : solver.mesh().cells())
            {
              std::vector<dealii::Tensor<1, dim>> X, values(cell.nodes.size());
              for (const unsigned int node : cell.nodes)
                X.push_back(state.positions[node]);
              solver.element().add_volume_gradient(X, 1., values);
              for (unsigned int a = 0; a < cell.nodes.size(); ++a)
                gradient[cell.nodes[a]] += values[a];
            }
          return gradient;
        }

        feti::PrimalVectors
        state_gradient(const state::StateSolver<dim> &,
                       const state::ContactState<dim> &state) const override
        {
          feti::PrimalVectors zero;
          for (const auto &u : state.u)
            zero.emplace_back(u.n_rows());
          return zero;
        }

        bool
        has_total_gradient() const override
        {
          return true;
        }

        Field
        total_gradient(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state) const override
        {
          return position_gradient(solver, state);
        }
      };
    } // namespace

    template <int dim>
    const ChoiceTable<std::unique_ptr<Response<dim>>()> &
    response_table()
    {
      static const ChoiceTable<std::unique_ptr<Response<dim>>()> table = {
        {"potential energy",
         "1/2 u'Ku - f'u [force length]; its least value at fixed volume "
         "spreads the contact pressure evenly",
         []() { return std::make_unique<PotentialEnergy<dim>>(); }},
        {"compliance",
         "f'u, the work of the loads [force length]; with a body held by "
         "contact alone it rewards lifting that body",
         []() { return std::make_unique<Compliance<dim>>(); }},
        {"strain energy",
         "1/2 u'Ku [force length]",
         []() { return std::make_unique<StrainEnergy<dim>>(); }},
        {"volume", "volume of all bodies [length^dim]", []() {
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
