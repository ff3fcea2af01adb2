#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/contact_results.h>

namespace snug::response {
namespace {
/// Return d/dX of sum_i (p_i n_i + q_i) . e over the rows of one pair, for the normal forces p_i
/// and the tangential forces q_i. The coefficients of a row on the slave side add up to n_i, or to
/// the tangent. The sum is therefore the energy of the rows with u = e on the slave side, minus the
/// energy of the rows with u = 0.
template <int dim>
typename mesh::Surface<dim>::Field
force_gradient(const state::StateSolver<dim>            &solver,
               const unsigned int                        load_case,
               const contact::Pair                      &pair,
               const typename mesh::Surface<dim>::Field &positions,
               const contact::ContactForces<dim>        &forces,
               const dealii::Tensor<1, dim>             &e)
{
  const auto moved =
    motion_of_slave<dim>(solver, load_case, pair, positions, [&](const auto &) { return e; });
  return solver.contact(load_case).coefficient_gradient(positions, moved, forces);
}

template <int dim>
class ContactForce : public Response<dim>
{
public:
  explicit ContactForce(const ResponseParameters &parameters) : parameters(parameters) {}

  std::vector<std::string> entries() const override { return {"Pair", "Component"}; }

  void check(const state::StateSolver<dim> &solver) const override
  {
    // Both functions throw for names that do not exist.
    row_shares(solver, parameters.pair, 0);
    if (parameters.component != Component::normal)
      unit_vector<dim>(parameters);
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto shares = shares_of(solver, state.load_case);
    const auto rows   = solver.contact(state.load_case).rows(state.surface_positions);
    double     force  = 0.;
    for (unsigned int i = 0; i < rows.size(); ++i)
      if (shares[i] != 0.)
        {
          const auto &point = state.contact[i];
          if (parameters.component == Component::normal)
            force += shares[i] * point.force;
          else
            {
              // p_i n_i and the shear push the slave side in the opposite direction.
              const auto e = unit_vector<dim>(parameters);
              force -= shares[i] * point.force * (rows[i].normal * e);
              for (int d = 0; d < dim; ++d)
                force -= shares[i] * point.shear[d] * e[d];
            }
        }
    return force;
  }

  /// Return the sum of the forces given at other places.
  std::optional<double> measured(const state::StateSolver<dim>   &solver,
                                 const unsigned int               load_case,
                                 const std::vector<PressureRows> &of_pairs) const override
  {
    if (parameters.component != Component::normal)
      return {};
    const auto chosen = chosen_pairs(solver, parameters.pair, load_case);
    double     force  = 0.;
    for (unsigned int p = 0; p < chosen.size(); ++p)
      if (chosen[p])
        for (const double of_row : of_pairs[p].force)
          force += of_row;
    return force;
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
    const auto    shares = shares_of(solver, state.load_case);
    Partials<dim> result;
    // J is linear in the forces, so its derivatives are the factors of value().
    result.forces = shares;
    result.positions.resize(solver.mesh().n_points());
    if (parameters.component == Component::normal)
      return result;
    const auto  e          = unit_vector<dim>(parameters);
    const auto &x          = state.surface_positions;
    const auto &contact    = solver.contact(state.load_case);
    const auto  rows       = contact.rows(x);
    const auto  directions = contact.tangent_directions(rows);
    for (unsigned int i = 0; i < rows.size(); ++i)
      result.forces[i] *= -(rows[i].normal * e);
    for (unsigned int i = 0; i < directions.size(); ++i)
      result.forces.push_back(-shares[contact.tangents()[i].row] * (directions[i] * e));
    // Differentiate pair by pair, because a boundary may be the slave of one pair and the master of
    // another. If it moved in both pairs at once, the coefficients of both sides would add up.
    const auto &pairs = contact.pairs();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        auto forces = state::contact_row_forces(solver, state);
        for (unsigned int i = 0; i < forces.size(); ++i)
          {
            const auto row = i < rows.size() ? i : contact.tangents()[i - rows.size()].row;
            forces[i] *= contact.places()[row].pair == p ? -shares[row] : 0.;
          }
        solver.surface().add_owned(force_gradient(solver, state.load_case, pairs[p], x,
                                                  contact.forces(rows, forces), e),
                                   result.positions);
      }
    return result;
  }

private:
  const ResponseParameters parameters;

  /// Components have the sign of the force on the side named first.
  std::vector<double> shares_of(const state::StateSolver<dim> &solver,
                                const unsigned int             load_case) const
  {
    return parameters.component == Component::normal
             ? row_shares(solver, parameters.pair, load_case)
             : row_shares_of_first_side(solver, parameters.pair, load_case);
  }
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> contact_force(const ResponseParameters &parameters)
{
  return std::make_unique<ContactForce<dim>>(parameters);
}

template std::unique_ptr<Response<2>> contact_force(const ResponseParameters &);
template std::unique_ptr<Response<3>> contact_force(const ResponseParameters &);
} // namespace snug::response
