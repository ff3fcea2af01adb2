#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>

namespace snug::response {
namespace {
/// Return d/dX of sum_i forces_i n_i . e over the rows of one pair. The coefficients of a row
/// on the slave side add up to n_i. The sum is therefore the energy of the rows with u = e on
/// the slave side, minus the energy of the rows with u = 0.
template <int dim>
typename mesh::Surface<dim>::Field
normal_gradient(const state::StateSolver<dim>            &solver,
                const unsigned int                        load_case,
                const contact::Pair                      &pair,
                const typename mesh::Surface<dim>::Field &positions,
                const std::vector<double>                &forces,
                const dealii::Tensor<1, dim>             &e)
{
  const auto                        &surface = solver.surface();
  typename mesh::Surface<dim>::Field moved(surface.n_nodes());
  for (const auto &face : surface.faces())
    if (contact::is_on(face, pair.slave))
      for (const unsigned int node : face.nodes)
        moved[node] = solver.motion(load_case, face.body).vector_back(e);
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
    const auto shares = row_shares(solver, parameters.pair, state.load_case);
    const auto rows =
      solver.contact(state.load_case).rows(solver.surface().gather(state.positions));
    double force = 0.;
    for (unsigned int i = 0; i < rows.size(); ++i)
      if (shares[i] != 0.)
        force -=
          shares[i] * state.contact[i].force *
          // p_i pushes the slave side along -n_i: -p_i n_i . e along e, p_i along -n_i itself.
          (parameters.component == Component::normal
             ? -1.
             : rows[i].normal * unit_vector<dim>(parameters));
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

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto    shares = row_shares(solver, parameters.pair, state.load_case);
    Partials<dim> result;
    // J is linear in the forces, so its derivatives are the factors of value().
    result.forces = shares;
    result.positions.resize(solver.mesh().n_points());
    if (parameters.component == Component::normal)
      return result;
    const auto e    = unit_vector<dim>(parameters);
    const auto x    = solver.surface().gather(state.positions);
    const auto rows = solver.contact(state.load_case).rows(x);
    for (unsigned int i = 0; i < rows.size(); ++i)
      result.forces[i] *= -(rows[i].normal * e);
    // Differentiate pair by pair, because a boundary may be the slave of one pair and the master of
    // another. If it moved in both pairs at once, the coefficients of both sides would add up.
    const auto &pairs = solver.contact(state.load_case).pairs();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        std::vector<double> forces(rows.size(), 0.);
        for (unsigned int i = 0; i < rows.size(); ++i)
          if (solver.contact(state.load_case).places()[i].pair == p)
            forces[i] = -shares[i] * state.contact[i].force;
        solver.surface().add_owned(normal_gradient(solver, state.load_case, pairs[p], x, forces, e),
                                   result.positions);
      }
    return result;
  }

private:
  const ResponseParameters parameters;
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
