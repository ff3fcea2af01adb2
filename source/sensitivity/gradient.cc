#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/methods.h>

namespace snug
{
  namespace sensitivity
  {
    namespace
    {
      using Values = std::vector<Gradient>;

      template <int dim>
      using Method = Values(const GradientProblem<dim> &,
                            const Responses<dim> &);

      /// Name and reason of the method of each response.
      using Choices = std::vector<std::pair<std::string, std::string>>;

      /// Each response by its method, those of one method together.
      template <int dim>
      Values
      by_methods(const GradientProblem<dim> &problem,
                 const Responses<dim>       &responses,
                 const Choices              &choices)
      {
        const std::pair<std::string, Method<dim> *> methods[] = {
          {"energy", energy_gradients<dim>},
          {"adjoint", adjoint_gradients<dim>},
          {"direct", direct_gradients<dim>}};
        Values result(responses.size());
        for (const auto &[name, method] : methods)
          {
            Responses<dim> group;
            for (unsigned int i = 0; i < responses.size(); ++i)
              if (choices[i].first == name)
                group.push_back(responses[i]);
            if (group.empty())
              continue;
            const Values of_group = method(problem, group);
            auto         next     = of_group.begin();
            for (unsigned int i = 0; i < responses.size(); ++i)
              if (choices[i].first == name)
                {
                  result[i]        = *next++;
                  result[i].reason = choices[i].second;
                }
          }
        return result;
      }

      /// All by @p method, but what depends on the geometry alone.
      template <int dim>
      std::function<Method<dim>>
      solving(const std::string &method)
      {
        return [method](const GradientProblem<dim> &problem,
                        const Responses<dim>       &responses) {
          Choices choices;
          for (const auto *response : responses)
            choices.emplace_back(response->needs_solution() ? method : "energy",
                                 "");
          return by_methods(problem, responses, choices);
        };
      }

      template <int dim>
      Values
      cheapest_gradients(const GradientProblem<dim> &problem,
                         const Responses<dim>       &responses)
      {
        const unsigned int k        = problem.basis.n_variables();
        unsigned int       n_solves = 0;
        for (const auto *response : responses)
          n_solves += needs_solve(*response);
        const auto by_solves = [&](const std::string &method) {
          return std::make_pair(method,
                                std::to_string(n_solves) +
                                  " responses that need a solve, " +
                                  std::to_string(k) + " variables");
        };
        Choices choices;
        for (const auto *response : responses)
          if (!response->needs_solution())
            choices.emplace_back("energy", "depends on the geometry alone");
          else if (response->stationary())
            choices.emplace_back("energy", "the state makes it stationary");
          else
            choices.push_back(by_solves(n_solves < k ? "adjoint" : "direct"));
        return by_methods(problem, responses, choices);
      }
    } // namespace

    template <int dim>
    const ChoiceTable<Method<dim>> &
    gradient_table()
    {
      static const ChoiceTable<Method<dim>> table = {
        {"auto",
         "the cheapest exact one: energy where it applies, else adjoint for "
         "fewer responses than variables, else direct",
         cheapest_gradients<dim>},
        {"energy",
         "without any solve, for potential energy and volume",
         energy_gradients<dim>},
        {"adjoint",
         "one linear solve per response with the state's factorizations",
         solving<dim>("adjoint")},
        {"direct",
         "the derivatives of the state, one linear solve per variable with the "
         "state's factorizations",
         solving<dim>("direct")},
        {"finite differences",
         "central differences of cold-started states, a baseline",
         difference_gradients<dim>}};
      return table;
    }

    template <int dim>
    Gradients
    gradients(const GradientProblem<dim> &problem,
              const Responses<dim>       &responses)
    {
      RunContext             &context = problem.solver.context();
      const RunContext::Timer timer(context, "gradient");
      const double            start  = context.seconds();
      const Work              before = context.total_work();
      Gradients               result;
      result.of_response =
        choose(gradient_table<dim>(), problem.parameters.method)
          .make(problem, responses);
      const Work after = context.total_work();
      result.f_mults   = after.f_mults - before.f_mults;
      result.numeric_factorizations =
        after.numeric_factorizations - before.numeric_factorizations;
      result.seconds = context.seconds() - start;
      return result;
    }

#define SNUG_INSTANTIATE(dim)                                \
  template const ChoiceTable<std::vector<Gradient>(          \
    const GradientProblem<dim> &, const Responses<dim> &)>   \
                    &gradient_table<dim>();                  \
  template Gradients gradients(const GradientProblem<dim> &, \
                               const Responses<dim> &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace sensitivity
} // namespace snug
