#include <snug/elasticity/linear_traction.h>
#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>

#include <deal.II/base/mpi.h>

namespace snug::response {
namespace {
/**
 * The force or the moment that supports apply to the nodes of a boundary. Nodal forces
 * r = K u - f + B_c' lambda of the contact rows B_c are zero at free nodes. With the virtual motion
 * v of the nodes, v = e or v = e x (x - p), and v = 0 at all other nodes,
 * J = v . r = a(u, v) - f(v) + sum_i lambda_i c_i . v.
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
    axis();
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto  v    = motion(solver, state);
    const auto &feti = solver.feti(state);
    double      sum  = 0.;
    for (unsigned int s = 0; s < v.size(); ++s)
      {
        qp::MultiVector r(v[s].n_rows());
        feti.linearization().subdomains()[s].K.multiply_add(1., state.u[s], r);
        r.add(-1., feti.loads()[s]);
        for (unsigned int i = 0; i < r.n_rows(); ++i)
          sum += r(i) * v[s](i);
      }
    sum            = dealii::Utilities::MPI::sum(sum, solver.context().communicator());
    const auto c_v = of_rows(solver, state, v);
    for (unsigned int i = 0; i < c_v.size(); ++i)
      sum += state.contact[i].force * c_v[i];
    return sum;
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto    v    = motion(solver, state);
    const auto   &feti = solver.feti(state);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (unsigned int s = 0; s < v.size(); ++s)
      {
        result.u.emplace_back(v[s].n_rows());
        feti.linearization().subdomains()[s].K.multiply_add(1., v[s], result.u[s]);
      }
    result.forces = of_rows(solver, state, v);
    state::add_stiffness_gradient(solver, state, v, 1., result.positions);
    state::add_load_gradient(solver, state, v, -1., result.positions);
    add_row_gradient(solver, state, v, result.positions);
    if (is_moment)
      add_lever_gradient(solver, state, result.positions);
    return result;
  }

private:
  const ResponseParameters parameters;
  const bool               is_moment;

  /// Return the axis of a moment or the direction of a force.
  dealii::Tensor<1, 3> axis() const
  {
    dealii::Tensor<1, 3> e;
    if (is_moment && (parameters.component == Component::normal ||
                      (dim == 2 && parameters.component != Component::z)))
      throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                      dim == 2 ? "must be z, the axis of the moment"
                               : "must be x, y or z, the axis of the moment");
    if (is_moment)
      e[static_cast<unsigned int>(parameters.component) - static_cast<unsigned int>(Component::x)] =
        1.;
    else
      for (unsigned int c = 0; c < dim; ++c)
        e[c] = unit_vector<dim>(parameters)[c];
    return e;
  }

  dealii::Tensor<1, dim> point() const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int c = 0; c < parameters.point.size(); ++c)
      result[c] = parameters.point[c];
    return result;
  }

  /// Return the virtual motion of a node of the boundary at @p x in the frame of its body. Forces,
  /// axis and point are given in space.
  dealii::Tensor<1, dim> motion_at(const geometry::RigidMotion<dim> &to_space,
                                   const dealii::Tensor<1, dim>     &x) const
  {
    if (is_moment)
      return to_space.vector_back(elasticity::turned(axis(), to_space.point(x) - point()));
    return to_space.vector_back(unit_vector<dim>(parameters));
  }

  /// Return which local nodes lie on the boundary.
  std::vector<bool> on_boundary(const state::StateSolver<dim> &solver) const
  {
    const auto               boundary = find_boundary(solver, parameters);
    const mesh::Surface<dim> surface(solver.mesh(), {boundary});
    const auto               bodies = surface.bodies_of_points();
    std::vector<bool>        on_faces(surface.n_nodes(), false), result;
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
        result.push_back(found < surface.n_nodes() && on_faces[found]);
      }
    return result;
  }

  feti::PrimalVectors motion(const state::StateSolver<dim>  &solver,
                             const state::ContactState<dim> &state) const
  {
    const auto          on_face = on_boundary(solver);
    const auto          body    = find_boundary(solver, parameters).first;
    const auto          moved   = solver.motion(state.load_case, body);
    const auto         &all     = solver.tearing().subdomains;
    feti::PrimalVectors v;
    for (unsigned int s = 0; s < all.size(); ++s)
      {
        v.emplace_back(solver.assemblers()[s]->n_dofs());
        for (unsigned int a = 0; a < all[s].nodes.size(); ++a)
          if (const unsigned int node = all[s].nodes[a]; on_face[node])
            {
              const auto at = motion_at(moved, state.positions[node]);
              for (unsigned int c = 0; c < dim; ++c)
                v[s](dim * a + c) = at[c];
            }
      }
    return v;
  }

  /// Return c_i . v of all contact rows.
  std::vector<double> of_rows(const state::StateSolver<dim>  &solver,
                              const state::ContactState<dim> &state,
                              const feti::PrimalVectors      &v) const
  {
    const auto &surface = solver.surface();
    const auto  at      = surface.gather(state::nodal_values(solver, v, 0));
    const auto  rows    = solver.contact(state.load_case).rows(surface.gather(state.positions));
    std::vector<double> result;
    for (const auto &row : rows)
      {
        result.push_back(0.);
        for (const auto &[node, c] : row.coefficients)
          result.back() += c * at[node];
      }
    return result;
  }

  /// Add d/dX sum_i force_i c_i . v at fixed v.
  void add_row_gradient(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state,
                        const feti::PrimalVectors      &v,
                        mesh::Field<dim>               &gradient) const
  {
    const auto         &surface = solver.surface();
    const auto         &contact = solver.contact(state.load_case);
    const auto          x       = surface.gather(state.positions);
    const auto          at      = surface.gather(state::nodal_values(solver, v, 0));
    std::vector<double> forces;
    for (const auto &row : state.contact)
      forces.push_back(row.force);
    // energy_gradient() contains the gaps, which do not depend on the displacement.
    auto       of_v = contact.energy_gradient(x, at, forces);
    const auto of_gaps =
      contact.energy_gradient(x, typename mesh::Surface<dim>::Field(at.size()), forces);
    for (unsigned int point = 0; point < of_v.size(); ++point)
      of_v[point] -= of_gaps[point];
    surface.add_owned(of_v, gradient);
  }

  /// Add the derivative by the places of the nodes in v = e x (x - p): r . (e x dx) = dx . (r x e).
  void add_lever_gradient(const state::StateSolver<dim>  &solver,
                          const state::ContactState<dim> &state,
                          mesh::Field<dim>               &gradient) const
  {
    const auto  on_face = on_boundary(solver);
    const auto  body    = find_boundary(solver, parameters).first;
    const auto  moved   = solver.motion(state.load_case, body);
    const auto &feti    = solver.feti(state);
    const auto &all     = solver.tearing().subdomains;
    for (unsigned int s = 0; s < all.size(); ++s)
      {
        qp::MultiVector r(solver.assemblers()[s]->n_dofs());
        feti.linearization().subdomains()[s].K.multiply_add(1., state.u[s], r);
        r.add(-1., feti.loads()[s]);
        for (unsigned int a = 0; a < all[s].nodes.size(); ++a)
          if (const unsigned int node = all[s].nodes[a]; on_face[node])
            {
              dealii::Tensor<1, dim> force;
              for (unsigned int c = 0; c < dim; ++c)
                force[c] = r(dim * a + c);
              gradient[node] -= moved.vector_back(elasticity::turned(axis(), moved.vector(force)));
            }
      }
    const auto &surface = solver.surface();
    const auto  rows    = solver.contact(state.load_case).rows(surface.gather(state.positions));
    typename mesh::Surface<dim>::Field of_rows(surface.n_points());
    std::vector<double>                is_on(solver.mesh().n_local_nodes());
    mesh::Field<dim>                   flags(solver.mesh().n_local_nodes());
    for (unsigned int node = 0; node < flags.size(); ++node)
      flags[node][0] = on_face[node] ? 1. : 0.;
    const auto on_surface = surface.gather(flags);
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (const auto &[node, c] : rows[i].coefficients)
        if (on_surface[node][0] != 0.)
          of_rows[node] -=
            state.contact[i].force * moved.vector_back(elasticity::turned(axis(), moved.vector(c)));
    surface.add_owned(of_rows, gradient);
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
