#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::response {
namespace {
/// The scaled Jacobian q as a measure of cell quality. The functions return the maximum 1 - q
/// of a cell, and the sum of ((1 - q) / scale)^p over the points of a cell with its gradient.
template <int dim>
struct Angles
{
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  static double largest(const elasticity::Element<dim> &element, const Nodes &, const Nodes &X)
  {
    return 1. - element.scaled_jacobian(X);
  }
  static double sum(const elasticity::Element<dim> &element,
                    const Nodes &,
                    const Nodes &X,
                    double       p,
                    double       scale)
  {
    return element.distortion(X, p, scale);
  }
  static void add_gradient(const elasticity::Element<dim> &element,
                           const Nodes &,
                           const Nodes &X,
                           double       p,
                           double       scale,
                           double       factor,
                           Nodes       &gradient)
  {
    element.add_distortion_gradient(X, p, scale, factor, gradient);
  }
};

/// The ratio q = det J / det J_0 with J_0 of the reference mesh. Points where the cell has
/// grown are left out.
template <int dim>
struct Sizes
{
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  /// Call @p visit with the shape functions, J and 1 - q of each point where 1 - q is positive.
  template <typename Visit>
  static void for_each_point(const Nodes &X_0, const Nodes &X, const Visit &visit)
  {
    const unsigned int degree = std::lround(std::pow(X.size(), 1. / dim)) - 1;
    for (const auto &points :
         {mesh::lagrange_gauss_points<dim>(degree), mesh::lagrange_nodes<dim>(degree)})
      for (const auto &shape : points)
        {
          const auto   J    = elasticity::jacobian(shape, X);
          const double loss = 1. - determinant(J) / determinant(elasticity::jacobian(shape, X_0));
          if (loss > 0.)
            visit(shape, J, loss);
        }
  }

  static double largest(const elasticity::Element<dim> &, const Nodes &X_0, const Nodes &X)
  {
    double result = 0.;
    for_each_point(X_0, X, [&](const auto &, const auto &, double loss) {
      result = std::max(result, loss);
    });
    return result;
  }
  static double
  sum(const elasticity::Element<dim> &, const Nodes &X_0, const Nodes &X, double p, double scale)
  {
    double result = 0.;
    for_each_point(X_0, X, [&](const auto &, const auto &, double loss) {
      result += std::pow(loss / scale, p);
    });
    return result;
  }
  /// Add the gradient of the sum, with q' = q tr(J^-1 J').
  static void add_gradient(const elasticity::Element<dim> &,
                           const Nodes &X_0,
                           const Nodes &X,
                           double       p,
                           double       scale,
                           double       factor,
                           Nodes       &gradient)
  {
    for_each_point(X_0, X, [&](const auto &shape, const auto &J, double loss) {
      const double weight  = -factor * p * (1. - loss) / scale * std::pow(loss / scale, p - 1.);
      const auto   inverse = invert(J);
      for (unsigned int a = 0; a < X.size(); ++a)
        gradient[a] += weight * (transpose(inverse) * shape.gradient[a]);
    });
  }
};

/// 1 minus the p-norm of 1 - q over the points of the cells, with q of @p Measure.
template <int dim, typename Measure>
class LeastQuality : public Response<dim>
{
public:
  explicit LeastQuality(const ResponseParameters &parameters)
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
    const auto of = distortion(solver, state);
    // J has its maximum 1, where all derivatives are zero.
    if (of.sum == 0.)
      return result;
    // The scale cancels in J and is differentiated as a constant.
    const double factor = -of.scale * std::pow(of.sum, 1. / p - 1.) / p;
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      const auto                         &assembler = *solver.assemblers()[s];
      const auto                          X         = assembler.cell_field(i, state.positions);
      std::vector<dealii::Tensor<1, dim>> values(X.size());
      Measure::add_gradient(assembler.element(),
                            assembler.cell_field(i, solver.mesh().reference_positions()), X, p,
                            of.scale, factor, values);
      state::add_to_cell_nodes(solver, s, i, values, result.positions);
    });
    return result;
  }

private:
  /// Sum of ((1 - q) / scale)^p. The scale is the maximum 1 - q, because otherwise large
  /// exponents underflow.
  struct Distortion
  {
    double scale = 0., sum = 0.;
  };

  Distortion distortion(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state) const
  {
    const MPI_Comm comm      = solver.context().communicator();
    const auto    &reference = solver.mesh().reference_positions();
    Distortion     result;
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      const auto &assembler = *solver.assemblers()[s];
      result.scale =
        std::max(result.scale,
                 Measure::largest(assembler.element(), assembler.cell_field(i, reference),
                                  assembler.cell_field(i, state.positions)));
    });
    result.scale = dealii::Utilities::MPI::max(result.scale, comm);
    if (result.scale == 0.)
      return result;
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      const auto &assembler = *solver.assemblers()[s];
      result.sum += Measure::sum(assembler.element(), assembler.cell_field(i, reference),
                                 assembler.cell_field(i, state.positions), p, result.scale);
    });
    result.sum = dealii::Utilities::MPI::sum(result.sum, comm);
    return result;
  }

  const std::string body; ///< empty: all bodies
  const double      p;
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> least_scaled_jacobian(const ResponseParameters &parameters)
{
  return std::make_unique<LeastQuality<dim, Angles<dim>>>(parameters);
}

template <int dim>
std::unique_ptr<Response<dim>> least_cell_size(const ResponseParameters &parameters)
{
  return std::make_unique<LeastQuality<dim, Sizes<dim>>>(parameters);
}

template std::unique_ptr<Response<2>> least_scaled_jacobian(const ResponseParameters &);
template std::unique_ptr<Response<3>> least_scaled_jacobian(const ResponseParameters &);
template std::unique_ptr<Response<2>> least_cell_size(const ResponseParameters &);
template std::unique_ptr<Response<3>> least_cell_size(const ResponseParameters &);
} // namespace snug::response
