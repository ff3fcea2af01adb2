#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::response {
namespace {
template <int dim>
class LeastScaledJacobian : public Response<dim>
{
public:
  explicit LeastScaledJacobian(const ResponseParameters &parameters)
    : body(parameters.body), p(parameters.exponent)
  {}

  std::vector<std::string> entries() const override { return {"Body", "Exponent"}; }

  bool needs_solution() const override { return false; }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto of = distortion(solver, state);
    return 1. - of.scale * std::pow(of.sum, 1. / p);
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    const auto of = distortion(solver, state);
    // Nothing but right angles: J is at its largest.
    if (of.sum == 0.)
      return result;
    // The scale is a constant: it cancels in J.
    const double factor = -of.scale * std::pow(of.sum, 1. / p - 1.) / p;
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      const auto                         &assembler = *solver.assemblers()[s];
      const auto                          X         = assembler.cell_field(i, state.positions);
      std::vector<dealii::Tensor<1, dim>> values(X.size());
      assembler.element().add_distortion_gradient(X, p, of.scale, factor, values);
      state::add_to_cell_nodes(solver, s, i, values, result.positions);
    });
    return result;
  }

private:
  /// sum ((1 - q) / scale)^p with the largest 1 - q as the scale, without which large exponents
  /// underflow.
  struct Distortion
  {
    double scale = 0., sum = 0.;
  };

  Distortion distortion(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state) const
  {
    const MPI_Comm comm = solver.context().communicator();
    const auto     X_of = [&](unsigned int s, unsigned int i) {
      return solver.assemblers()[s]->cell_field(i, state.positions);
    };
    Distortion result;
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      const auto &element = solver.assemblers()[s]->element();
      result.scale        = std::max(result.scale, 1. - element.scaled_jacobian(X_of(s, i)));
    });
    result.scale = dealii::Utilities::MPI::max(result.scale, comm);
    if (result.scale == 0.)
      return result;
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      const auto &element = solver.assemblers()[s]->element();
      result.sum += element.distortion(X_of(s, i), p, result.scale);
    });
    result.sum = dealii::Utilities::MPI::sum(result.sum, comm);
    return result;
  }

  const std::string body; ///< empty: all
  const double      p;
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> least_scaled_jacobian(const ResponseParameters &parameters)
{
  return std::make_unique<LeastScaledJacobian<dim>>(parameters);
}

template std::unique_ptr<Response<2>> least_scaled_jacobian(const ResponseParameters &);
template std::unique_ptr<Response<3>> least_scaled_jacobian(const ResponseParameters &);
} // namespace snug::response
