#include <snug/elasticity/linear_traction.h>
#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::response {
namespace {
/**
 * The force or the moment that the supports and springs of a boundary apply to its nodes. The nodal
 * forces r = K u - f + B_c' lambda, with the contact rows B_c, are zero at free nodes. With the
 * virtual motion v of the nodes, v = P e or v = P (e x (x - p)), and v = 0 at all other nodes,
 * J = v . r = a(u, v) - f(v) + sum_i lambda_i c_i . v. P projects to the directions that the
 * supports of this boundary hold (DirichletConstraints::reaction_directions()), because nodes at an
 * edge are also held by those of other boundaries. It is the identity on boundaries with springs.
 */
template <int dim>
class SupportReaction : public Response<dim>
{
public:
  SupportReaction(const ResponseParameters &parameters, const bool is_moment)
    : parameters(parameters), is_moment(is_moment)
  {}

  std::vector<std::string> entries() const override
  {
    return is_moment ? std::vector<std::string>{"Face", "Point", "Component"}
                     : std::vector<std::string>{"Face", "Component"};
  }

  void check(const state::StateSolver<dim> &solver) const override
  {
    find_boundary(solver, parameters);
    if (is_moment)
      axis_of<dim>(parameters);
    else if (component_of(solver, parameters).is_normal())
      unit_vector<dim>(parameters); // throws
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto r   = nodal_forces(solver, state);
    const auto v   = nodal_motion(solver, state);
    double     sum = 0.;
    for (unsigned int node = 0; node < r.size(); ++node)
      sum += v[node] * r[node];
    return dealii::Utilities::MPI::sum(sum, solver.context().communicator());
  }

  FieldDerivative<dim> field_derivative(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state) const override
  {
    FieldDerivative<dim> result;
    result.motion = torn(solver, nodal_motion(solver, state));
    return result;
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto   &surface    = solver.surface();
    const auto   &contact    = solver.contact(state.load_case);
    const auto    v          = nodal_motion(solver, state);
    const auto    v_torn     = torn(solver, v);
    const auto    on_surface = surface.gather(v);
    const auto   &x          = state.surface_positions;
    const auto    rows       = solver.rows(state.positions, state.load_case);
    const auto    forces     = row_forces(solver, state);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (unsigned int s = 0; s < v_torn.size(); ++s)
      {
        result.u.emplace_back(v_torn[s].n_rows());
        solver.feti(state).linearization().subdomains()[s].K.multiply_add(1., v_torn[s],
                                                                          result.u[s]);
      }
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      {
        result.forces.push_back(0.);
        for (const auto &[node, c] : rows.row(i).coefficients)
          result.forces.back() += c * on_surface[node];
      }
    state::add_stiffness_gradient(solver, state, v_torn, 1., result.positions);
    state::add_load_gradient(solver, state, v_torn, -1., result.positions);
    surface.add_owned(contact.coefficient_gradient(x, on_surface,
                                                   contact.forces(rows.contact, forces.contact)),
                      result.positions);
    surface.add_owned(solver.ties().energy_gradient(x, on_surface, forces.ties), result.positions);
    add_motion_gradient(solver, state, result.positions);
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

  /// Return the virtual motion of a node of the boundary at @p x in the frame of its body. Forces
  /// along x, y, z, axes and points of moments are given in space. The axis of the body moves with
  /// it.
  dealii::Tensor<1, dim> motion_at(const state::StateSolver<dim>    &solver,
                                   const geometry::RigidMotion<dim> &to_space,
                                   const dealii::Tensor<1, dim>     &x) const
  {
    if (is_moment)
      return to_space.vector_back(
        elasticity::turned(axis_of<dim>(parameters), to_space.point(x) - point()));
    const auto e = component_of(solver, parameters).direction(x, {});
    return parameters.component > Component::z ? e : to_space.vector_back(e);
  }

  /// Return P of the local nodes.
  std::vector<dealii::Tensor<2, dim>> directions(const state::StateSolver<dim> &solver) const
  {
    const auto               boundary = find_boundary(solver, parameters);
    const mesh::Surface<dim> surface(solver.mesh(), {boundary});
    std::vector<bool>        on_faces(surface.n_nodes(), false);
    const bool               has_springs =
      std::any_of(solver.model().springs.begin(), solver.model().springs.end(),
                  [&](const auto &spring) {
                    return std::make_pair(spring.body, spring.boundary) == boundary;
                  });
    std::vector<dealii::Tensor<2, dim>> result(solver.mesh().n_local_nodes());
    for (const auto &face : surface.faces())
      for (const unsigned int node : face.nodes)
        {
          on_faces[node] = true;
          // A virtual motion of a hanging node is that of its masters.
          for (const auto &master : surface.masters(node))
            on_faces[master.first] = true;
        }
    for (unsigned int node = 0; node < solver.mesh().n_local_nodes(); ++node)
      {
        const unsigned int found = surface.find(solver.mesh().global_node(node));
        if (found == surface.n_nodes() || !on_faces[found])
          continue;
        if (has_springs)
          result[node] = dealii::unit_symmetric_tensor<dim>();
        else
          result[node] =
            solver.held().reaction_directions(solver.mesh().global_node(node), boundary);
      }
    return result;
  }

  /// Return v at the local nodes.
  mesh::Field<dim> nodal_motion(const state::StateSolver<dim>  &solver,
                                const state::ContactState<dim> &state) const
  {
    const auto       P        = directions(solver);
    const auto       to_space = motion_of_body(solver, state);
    mesh::Field<dim> v(P.size());
    for (unsigned int node = 0; node < v.size(); ++node)
      v[node] = P[node] * motion_at(solver, to_space, state.positions[node]);
    return v;
  }

  geometry::RigidMotion<dim> motion_of_body(const state::StateSolver<dim>  &solver,
                                            const state::ContactState<dim> &state) const
  {
    return solver.motion(state.load_case, find_boundary(solver, parameters).first);
  }

  /// Return a field of the local nodes on the nodes of the subdomains.
  static feti::PrimalVectors torn(const state::StateSolver<dim> &solver,
                                  const mesh::Field<dim>        &field)
  {
    const auto         &all = solver.tearing().subdomains;
    feti::PrimalVectors result;
    for (unsigned int s = 0; s < all.size(); ++s)
      {
        result.emplace_back(solver.assemblers()[s]->n_dofs());
        for (unsigned int a = 0; a < all[s].nodes.size(); ++a)
          for (unsigned int c = 0; c < dim; ++c)
            result[s](dim * a + c) = field[all[s].nodes[a]][c];
      }
    return result;
  }

  static typename state::Gluing<dim>::RowForces row_forces(const state::StateSolver<dim>  &solver,
                                                           const state::ContactState<dim> &state)
  {
    return solver.gluing(state.load_case).row_forces(state.dual.lambda).front();
  }

  /// Return r at the local nodes, as shares that add up over ranks. The gluing forces of the copies
  /// of a node cancel.
  static mesh::Field<dim> nodal_forces(const state::StateSolver<dim>  &solver,
                                       const state::ContactState<dim> &state)
  {
    const auto      &feti = solver.feti(state);
    const auto      &all  = solver.tearing().subdomains;
    mesh::Field<dim> r(solver.mesh().n_local_nodes());
    for (unsigned int s = 0; s < all.size(); ++s)
      {
        qp::MultiVector torn(solver.assemblers()[s]->n_dofs());
        feti.linearization().subdomains()[s].K.multiply_add(1., state.u[s], torn);
        torn.add(-1., feti.loads()[s]);
        for (unsigned int a = 0; a < all[s].nodes.size(); ++a)
          for (unsigned int c = 0; c < dim; ++c)
            r[all[s].nodes[a]][c] += torn(dim * a + c);
      }
    const auto                        &surface = solver.surface();
    typename mesh::Surface<dim>::Field of_rows(surface.n_nodes());
    const auto                         rows   = solver.rows(state.positions, state.load_case);
    const auto                         forces = row_forces(solver, state).all;
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (const auto &[node, c] : rows.row(i).coefficients)
        of_rows[node] += forces[i] * c;
    surface.add_owned(of_rows, r);
    return r;
  }

  /// Add the derivative by the places of the nodes in v = e x (x - p): r . (e x dx) = dx . (r x e),
  /// or in the direction v = e(x).
  void add_motion_gradient(const state::StateSolver<dim>  &solver,
                           const state::ContactState<dim> &state,
                           mesh::Field<dim>               &gradient) const
  {
    const auto P        = directions(solver);
    const auto to_space = motion_of_body(solver, state);
    const auto r        = nodal_forces(solver, state);
    for (unsigned int node = 0; node < r.size(); ++node)
      if (is_moment)
        gradient[node] -= to_space.vector_back(
          elasticity::turned(axis_of<dim>(parameters), to_space.vector(P[node] * r[node])));
      else
        gradient[node] +=
          transpose(component_of(solver, parameters).derivative(state.positions[node])) *
          (P[node] * r[node]);
  }
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> reaction(const ResponseParameters &parameters)
{
  return std::make_unique<SupportReaction<dim>>(parameters, false);
}

template <int dim>
std::unique_ptr<Response<dim>> reaction_moment(const ResponseParameters &parameters)
{
  return std::make_unique<SupportReaction<dim>>(parameters, true);
}

template std::unique_ptr<Response<2>> reaction(const ResponseParameters &);
template std::unique_ptr<Response<3>> reaction(const ResponseParameters &);
template std::unique_ptr<Response<2>> reaction_moment(const ResponseParameters &);
template std::unique_ptr<Response<3>> reaction_moment(const ResponseParameters &);
} // namespace snug::response
