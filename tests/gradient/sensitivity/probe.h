#ifndef snug_tests_gradient_sensitivity_probe_h
#define snug_tests_gradient_sensitivity_probe_h

#include <snug/response/response.h>

#include <deal.II/base/mpi.h>

#include <unit/state/test_scene.h>

namespace snug::test {
/**
 * A response of everything a response may depend on, without a meaning:
 * sum_a (b_a . u_a + b_a . X_a) over the copies of all nodes and
 * sum_i (c_i p_i + p_i^2 / 10) over the contact forces p_i, with numbers
 * b, c made of indices.
 */
template <int dim>
class Probe : public response::Response<dim>
{
public:
  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    double sum = 0.;
    for (unsigned int s = 0; s < state.u.size(); ++s)
      {
        const auto &nodes = solver.tearing().subdomains[s].nodes;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          for (unsigned int c = 0; c < dim; ++c)
            sum += weight(solver, nodes[a], c) *
                   (state.u[s](dim * a + c) + state.positions[nodes[a]][c]);
      }
    sum = dealii::Utilities::MPI::sum(sum, solver.context().communicator());
    for (unsigned int i = 0; i < state.contact.size(); ++i)
      {
        const double p = state.contact[i].force;
        sum += std::cos(i) * p + p * p / 10;
      }
    return sum;
  }

  response::FieldDerivative<dim>
  field_derivative(const state::StateSolver<dim> & /*solver*/,
                   const state::ContactState<dim> & /*state*/) const override
  {
    return {}; // the probe depends on u at points only
  }

  response::Partials<dim> partials(const state::StateSolver<dim>  &solver,
                                   const state::ContactState<dim> &state) const override
  {
    response::Partials<dim> result;
    result.positions.resize(solver.mesh().n_local_nodes());
    for (unsigned int s = 0; s < state.u.size(); ++s)
      {
        const auto &nodes = solver.tearing().subdomains[s].nodes;
        result.u.emplace_back(state.u[s].n_rows());
        for (unsigned int a = 0; a < nodes.size(); ++a)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double b           = weight(solver, nodes[a], c);
              result.u[s](dim * a + c) = b;
              result.positions[nodes[a]][c] += b;
            }
      }
    for (unsigned int i = 0; i < state.contact.size(); ++i)
      result.forces.push_back(std::cos(i) + state.contact[i].force / 5);
    return result;
  }

private:
  static double weight(const state::StateSolver<dim> &solver, unsigned int node, unsigned int c)
  {
    return std::sin(solver.mesh().global_node(node) + 2. * c);
  }
};
} // namespace snug::test

#endif
