#include <snug/elasticity/linear_traction.h>
#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/contact_results.h>

namespace snug::response {
namespace {
/// The friction forces of a pair, or their moment. J = -sum q . v with the virtual motion v = e or
/// v = e x (x - p) of the slave side, on which -q acts. If the scene names the master first, the
/// shares of the rows are negative (row_shares_of_first_side()).
template <int dim>
class FrictionForce : public Response<dim>
{
public:
  FrictionForce(const ResponseParameters &parameters, const bool is_moment)
    : parameters(parameters), is_moment(is_moment)
  {}

  std::vector<std::string> entries() const override
  {
    return is_moment ? std::vector<std::string>{"Pair", "Point", "Component"}
                     : std::vector<std::string>{"Pair", "Component"};
  }

  void check(const state::StateSolver<dim> &solver) const override
  {
    row_shares(solver, parameters.pair, 0);
    if (is_moment)
      axis_of<dim>(parameters);
    else
      unit_vector<dim>(parameters);
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    double sum = 0.;
    for_each_pair(solver, state, [&](const auto &rows, const auto &forces, const auto &v) {
      for (unsigned int i = 0; i < rows.n_rows(); ++i)
        for (const auto &[node, c] : rows.row(i).coefficients)
          sum += forces[i] * (c * v[node]);
    });
    return sum;
  }

  /// J depends on u through the contact forces alone.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> & /*solver*/,
                                        const state::ContactState<dim> & /*state*/) const override
  {
    return {};
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto   &x       = state.surface_positions;
    const auto   &contact = solver.contact(state.load_case);
    const auto    shares  = row_shares_of_first_side(solver, parameters.pair, state.load_case);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    result.forces.resize(contact.n_rows() + contact.tangents().size(), 0.);
    unsigned int p = 0;
    for_each_pair(solver, state, [&](const auto &rows, const auto &forces, const auto &v) {
      for (unsigned int j = 0; j < rows.tangents.size(); ++j)
        if (const unsigned int i = contact.tangents()[j].row; contact.places()[i].pair == p)
          for (const auto &[node, c] : rows.tangents[j].coefficients)
            result.forces[contact.n_rows() + j] -= shares[i] * (c * v[node]);
      auto gradient = contact.coefficient_gradient(x, v, contact.forces(rows.contact, forces));
      if (is_moment)
        add_lever_gradient(solver, state, rows, forces, v, gradient);
      solver.surface().add_owned(gradient, result.positions);
      ++p;
    });
    return result;
  }

private:
  const ResponseParameters parameters;
  const bool               is_moment;

  dealii::Tensor<1, dim> point() const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int c = 0; c < parameters.point.size(); ++c)
      result[c] = parameters.point[c];
    return result;
  }

  /// Call @p use(rows, forces, v) for each pair with the rows of all contacts, minus the tangential
  /// forces of the pair, zero on other rows, and the virtual motion of its slave side.
  template <typename Use>
  void for_each_pair(const state::StateSolver<dim>  &solver,
                     const state::ContactState<dim> &state,
                     const Use                      &use) const
  {
    const auto &contact = solver.contact(state.load_case);
    const auto  shares  = row_shares_of_first_side(solver, parameters.pair, state.load_case);
    const auto  rows    = solver.rows(state.positions, state.load_case);
    const auto  all     = state::contact_row_forces(solver, state);
    const auto &x       = state.surface_positions;
    for (unsigned int p = 0; p < contact.pairs().size(); ++p)
      {
        std::vector<double> forces(all.size(), 0.);
        for (unsigned int j = 0; j < contact.tangents().size(); ++j)
          if (const unsigned int i = contact.tangents()[j].row; contact.places()[i].pair == p)
            forces[contact.n_rows() + j] = -shares[i] * all[contact.n_rows() + j];
        use(rows, forces,
            motion_of_slave<dim>(solver, state.load_case, contact.pairs()[p], x,
                                 [&](const dealii::Tensor<1, dim> &at) {
                                   return is_moment ? elasticity::turned(axis_of<dim>(parameters),
                                                                         at - point())
                                                    : unit_vector<dim>(parameters);
                                 }));
      }
  }

  /// Add the derivative by the places of the nodes in v = e x (x - p): r . (e x dx) = dx . (r x e)
  /// for the force r on each node that moves.
  void add_lever_gradient(const state::StateSolver<dim>            &solver,
                          const state::ContactState<dim>           &state,
                          const state::RowCoefficients<dim>        &rows,
                          const std::vector<double>                &forces,
                          const typename mesh::Surface<dim>::Field &v,
                          typename mesh::Surface<dim>::Field       &gradient) const
  {
    std::vector<unsigned int> body(v.size());
    for (const auto &face : solver.surface().faces())
      for (const unsigned int node : face.nodes)
        body[node] = face.body;
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (const auto &[node, c] : rows.row(i).coefficients)
        if (forces[i] != 0. && v[node].norm_square() > 0.)
          {
            const auto to_space = solver.motion(state.load_case, body[node]);
            gradient[node] -= to_space.vector_back(
              elasticity::turned(axis_of<dim>(parameters), to_space.vector(forces[i] * c)));
          }
  }
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> friction_force(const ResponseParameters &parameters)
{
  return std::make_unique<FrictionForce<dim>>(parameters, false);
}

template <int dim>
std::unique_ptr<Response<dim>> friction_moment(const ResponseParameters &parameters)
{
  return std::make_unique<FrictionForce<dim>>(parameters, true);
}

template std::unique_ptr<Response<2>> friction_force(const ResponseParameters &);
template std::unique_ptr<Response<3>> friction_force(const ResponseParameters &);
template std::unique_ptr<Response<2>> friction_moment(const ResponseParameters &);
template std::unique_ptr<Response<3>> friction_moment(const ResponseParameters &);
} // namespace snug::response
