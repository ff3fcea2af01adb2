#include <snug/sensitivity/direct.h>
#include <snug/sensitivity/gradient.h>

#include <deal.II/base/mpi.h>

namespace snug
{
  namespace sensitivity
  {
    template <int dim>
    typename mesh::BodyMesh<dim>::Field
    positions(const mesh::BodyMesh<dim>    &mesh,
              const shape::ShapeBasis<dim> &basis,
              const std::vector<double>    &design)
    {
      auto       x = mesh.reference_positions();
      const auto v = basis.apply(design);
      for (unsigned int node = 0; node < x.size(); ++node)
        x[node] += v[node];
      return x;
    }

    namespace
    {
      template <int dim>
      std::vector<double>
      energy_gradient(const GradientProblem<dim> &problem)
      {
        if (!problem.response.has_total_gradient())
          throw InputError("entry 'Gradient/Method' = 'energy': the response "
                           "has no gradient without a solve; use 'direct'");
        return problem.basis.transpose(
          problem.response.total_gradient(problem.solver, problem.state));
      }

      template <int dim>
      std::vector<double>
      direct_gradient(const GradientProblem<dim> &problem)
      {
        const unsigned int k = problem.basis.n_variables();
        std::vector<typename mesh::BodyMesh<dim>::Field> velocities;
        for (unsigned int j = 0; j < k; ++j)
          velocities.push_back(problem.basis.column(j));
        const auto derivatives =
          direct(problem.solver, problem.state, velocities, problem.parameters);
        const auto dJ_du =
          problem.response.state_gradient(problem.solver, problem.state);
        std::vector<double> through_state(k, 0.);
        for (unsigned int j = 0; j < k; ++j)
          for (unsigned int s = 0; s < dJ_du.size(); ++s)
            for (unsigned int i = 0; i < dJ_du[s].n_rows(); ++i)
              through_state[j] += dJ_du[s](i) * derivatives.u[s](i, j);
        dealii::Utilities::MPI::sum(through_state,
                                    problem.solver.context().communicator(),
                                    through_state);
        auto values = problem.basis.transpose(
          problem.response.position_gradient(problem.solver, problem.state));
        for (unsigned int j = 0; j < k; ++j)
          values[j] += through_state[j];
        return values;
      }

      template <int dim>
      std::vector<double>
      difference_gradient(const GradientProblem<dim> &problem)
      {
        std::vector<double> values;
        for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
          {
            const double step =
              problem.parameters.step * problem.bound_widths[j];
            double difference = 0.;
            for (const double sign : {1., -1.})
              {
                // cold start: a warm one would stop at once and hide u'
                auto design = problem.design;
                design[j] += sign * step;
                const auto state = problem.solver.solve(
                  positions(problem.solver.mesh(), problem.basis, design),
                  qp::WarmStart());
                difference +=
                  sign * problem.response.value(problem.solver, state);
              }
            values.push_back(difference / (2 * step));
          }
        return values;
      }

      template <int dim>
      std::string
      cheapest_method(const response::Response<dim> &response)
      {
        return response.has_total_gradient() ? "energy" : "direct";
      }
    } // namespace

    template <int dim>
    const ChoiceTable<std::vector<double>(const GradientProblem<dim> &)> &
    gradient_table()
    {
      static const ChoiceTable<std::vector<double>(
        const GradientProblem<dim> &)>
        table = {{"auto",
                  "the cheapest exact method: energy where it applies, else "
                  "direct",
                  [](const GradientProblem<dim> &problem) {
                    return choose(gradient_table<dim>(),
                                  cheapest_method(problem.response))
                      .make(problem);
                  }},
                 {"energy",
                  "without any solve, for potential energy and volume",
                  energy_gradient<dim>},
                 {"direct",
                  "all u' by one block solve with the state's factorizations",
                  direct_gradient<dim>},
                 {"finite differences",
                  "central differences of cold-started states, a baseline",
                  difference_gradient<dim>}};
      return table;
    }

    template <int dim>
    Gradient
    gradient(const GradientProblem<dim> &problem, const std::string &method)
    {
      RunContext             &context = problem.solver.context();
      const RunContext::Timer timer(context, "gradient");
      const double            start  = context.seconds();
      const Work              before = context.total_work();
      Gradient                result;
      result.method =
        method == "auto" ? cheapest_method(problem.response) : method;
      result.values =
        choose(gradient_table<dim>(), result.method).make(problem);
      const Work after = context.total_work();
      result.f_mults   = after.f_mults - before.f_mults;
      result.numeric_factorizations =
        after.numeric_factorizations - before.numeric_factorizations;
      result.seconds = context.seconds() - start;
      return result;
    }

#define SNUG_INSTANTIATE(dim)                     \
  template mesh::BodyMesh<dim>::Field positions(  \
    const mesh::BodyMesh<dim> &,                  \
    const shape::ShapeBasis<dim> &,               \
    const std::vector<double> &);                 \
  template const ChoiceTable<std::vector<double>( \
    const GradientProblem<dim> &)>                \
                   &gradient_table<dim>();        \
  template Gradient gradient(const GradientProblem<dim> &, const std::string &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace sensitivity
} // namespace snug
