#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

namespace snug::response {
namespace {
template <int dim>
class BodyIntegral : public Response<dim>
{
public:
  BodyIntegral(const ResponseParameters &parameters, const bool mass)
    : body(parameters.body), mass(mass)
  {}

  std::vector<std::string> entries() const override { return {"Body"}; }

  /// Return false: a volume constraint can be evaluated and differentiated without a solved state.
  bool needs_solution() const override { return false; }

  bool needs_density() const override { return mass; }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    double     integral = 0.;
    const auto add      = [&](unsigned int s, unsigned int i) {
      const auto &assembler = *solver.assemblers()[s];
      integral += weight_of(assembler.material(i)) *
                  assembler.element().volume(assembler.cell_field(i, state.positions));
    };
    state::for_each_cell<dim>(solver, body, add);
    // The sum over ranks counts each cell once, because each cell is on one rank.
    return dealii::Utilities::MPI::sum(integral, solver.context().communicator());
  }

  /// Return the derivatives. The members u and forces stay empty, which stands for zero.
  /// J does not depend on u.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> & /*solver*/,
                                        const state::ContactState<dim> & /*state*/) const override
  {
    return {};
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    const auto add = [&](unsigned int s, unsigned int i) {
      const auto                         &assembler = *solver.assemblers()[s];
      const auto                          X         = assembler.cell_field(i, state.positions);
      std::vector<dealii::Tensor<1, dim>> values(X.size());
      // The gradient d/dX int dV includes det J and, in axisymmetric models, the radius.
      assembler.element().add_volume_gradient(X, weight_of(assembler.material(i)), values);
      state::add_to_cell_nodes(solver, s, i, values, result.positions);
    };
    state::for_each_cell<dim>(solver, body, add);
    return result;
  }

private:
  /// Return the integrand. The density is a constant of the region: it moves with the cell
  /// and has no derivative.
  double weight_of(const elasticity::Material &material) const
  {
    return mass ? material.density : 1.;
  }

  const std::string body; ///< empty: all bodies
  const bool        mass; ///< mass, else volume
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> body_integral(const ResponseParameters &parameters, bool mass)
{
  return std::make_unique<BodyIntegral<dim>>(parameters, mass);
}

template std::unique_ptr<Response<2>> body_integral(const ResponseParameters &, bool);
template std::unique_ptr<Response<3>> body_integral(const ResponseParameters &, bool);
} // namespace snug::response
