#include <snug/elasticity/linear_traction.h>
#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/contact_results.h>

namespace snug::response {
namespace {
/// Return virtual motions of the nodes of the slave side of a pair, a function of their positions
/// in space, in the frames of the bodies. Other nodes are at rest.
template <int dim>
typename mesh::Surface<dim>::Field
motion_of_slave(const state::StateSolver<dim>            &solver,
                const unsigned int                        load_case,
                const contact::Pair                      &pair,
                const typename mesh::Surface<dim>::Field &positions,
                const std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &)> &motion)
{
  const auto                        &surface = solver.surface();
  typename mesh::Surface<dim>::Field moved(surface.n_nodes());
  for (const auto &face : surface.faces())
    if (contact::is_on(face, pair.slave))
      for (const unsigned int node : face.nodes)
        {
          const auto to_space = solver.motion(load_case, face.body);
          moved[node]         = to_space.vector_back(motion(to_space.point(positions[node])));
        }
  return moved;
}

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
    const auto shares = row_shares(solver, parameters.pair, state.load_case);
    const auto rows =
      solver.contact(state.load_case).rows(solver.surface().gather(state.positions));
    double force = 0.;
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
    const auto  e          = unit_vector<dim>(parameters);
    const auto  x          = solver.surface().gather(state.positions);
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
};

/// The friction forces of a pair, or their moment. J = -sum q . v with the virtual motion v = e or
/// v = e x (x - p) of the slave side, on which -q acts.
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
      moment_axis<dim>(parameters);
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

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto    x       = solver.surface().gather(state.positions);
    const auto   &contact = solver.contact(state.load_case);
    const auto    shares  = row_shares(solver, parameters.pair, state.load_case);
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
    const auto  shares  = row_shares(solver, parameters.pair, state.load_case);
    const auto  rows    = solver.rows(state.positions, state.load_case);
    const auto  all     = state::contact_row_forces(solver, state);
    const auto  x       = solver.surface().gather(state.positions);
    for (unsigned int p = 0; p < contact.pairs().size(); ++p)
      {
        std::vector<double> forces(all.size(), 0.);
        for (unsigned int j = 0; j < contact.tangents().size(); ++j)
          if (const unsigned int i = contact.tangents()[j].row; contact.places()[i].pair == p)
            forces[contact.n_rows() + j] = -shares[i] * all[contact.n_rows() + j];
        use(rows, forces,
            motion_of_slave<dim>(solver, state.load_case, contact.pairs()[p], x,
                                 [&](const dealii::Tensor<1, dim> &at) {
                                   return is_moment
                                            ? elasticity::turned(moment_axis<dim>(parameters),
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
              elasticity::turned(moment_axis<dim>(parameters), to_space.vector(forces[i] * c)));
          }
  }
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> contact_force(const ResponseParameters &parameters)
{
  return std::make_unique<ContactForce<dim>>(parameters);
}

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
template std::unique_ptr<Response<2>> contact_force(const ResponseParameters &);
template std::unique_ptr<Response<3>> contact_force(const ResponseParameters &);
} // namespace snug::response
