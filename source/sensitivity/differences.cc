#include <snug/sensitivity/methods.h>

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

    template <int dim>
    std::vector<Gradient>
    difference_gradients(const GradientProblem<dim> &problem,
                         const Responses<dim>       &responses)
    {
      std::vector<Gradient> result(responses.size(),
                                   {"finite differences", "", {}});
      for (unsigned int j = 0; j < problem.basis.n_variables(); ++j)
        {
          const double step = problem.parameters.step * problem.bound_widths[j];
          std::vector<double> differences(responses.size());
          for (const double sign : {1., -1.})
            {
              // cold start: a warm one would stop at once and hide u'
              auto design = problem.design;
              design[j] += sign * step;
              const auto state = problem.solver.solve(
                positions(problem.solver.mesh(), problem.basis, design),
                qp::WarmStart());
              for (unsigned int i = 0; i < responses.size(); ++i)
                differences[i] +=
                  sign * responses[i]->value(problem.solver, state);
            }
          for (unsigned int i = 0; i < responses.size(); ++i)
            result[i].values.push_back(differences[i] / (2 * step));
        }
      return result;
    }
#define SNUG_INSTANTIATE(dim)                          \
  template mesh::BodyMesh<dim>::Field positions(       \
    const mesh::BodyMesh<dim> &,                       \
    const shape::ShapeBasis<dim> &,                    \
    const std::vector<double> &);                      \
  template std::vector<Gradient> difference_gradients( \
    const GradientProblem<dim> &, const Responses<dim> &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace sensitivity
} // namespace snug
