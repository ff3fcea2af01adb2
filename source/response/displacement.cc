#include <snug/response/measured_faces.h>
#include <snug/response/quantities.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::response {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// Return the load on a face with these Gauss points with forces f(X) such that f . u = int u . e
/// dA.
template <int dim>
elasticity::FaceLoadValues<dim> unit_load(const supports::Component<dim> &component,
                                          const Nodes<dim>               &points)
{
  elasticity::FaceLoadValues<dim> load;
  if (component.is_normal())
    // A pressure acts along the inner normal, so the pressure -1 makes f . u the integral of u . n.
    load.pressure.assign(points.size(), -1.);
  else
    for (const auto &x : points)
      load.traction.push_back(component.direction(x, {}));
  return load;
}

/// int u . e dA and int dA over the whole face, summed over the ranks.
struct Average
{
  double integral = 0., area = 0.;
};

template <int dim>
Average average(const state::StateSolver<dim>  &solver,
                const state::ContactState<dim> &state,
                const ResponseParameters       &parameters)
{
  const auto component = component_of(solver, parameters);
  double     sums[2]   = {0., 0.};
  for (const auto &face : faces_of(solver, parameters))
    {
      const auto &assembler = *solver.assemblers()[face.subdomain];
      const auto  X         = at_face<dim>(face, assembler.cell_field(face.cell, state.positions));
      const auto  u =
        at_face<dim>(face, assembler.cell_values(face.cell, state.u[face.subdomain].column(0)));
      Nodes<dim> f;
      solver.face_load().force(X, unit_load(component, solver.face_load().quadrature_points(X)), f);
      for (unsigned int a = 0; a < u.size(); ++a)
        sums[0] += f[a] * u[a];
      // The integrals int N_a dA add up to the area of the face.
      for (const double area : solver.face_load().areas(X))
        sums[1] += area;
    }
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums, 2),
                              solver.context().communicator(), dealii::ArrayView<double>(sums, 2));
  return {sums[0], sums[1]};
}

template <int dim>
class Displacement : public Response<dim>
{
public:
  explicit Displacement(const ResponseParameters &parameters) : parameters(parameters) {}

  std::vector<std::string> entries() const override
  {
    return {"Body", "Face", "Point", "Component"};
  }

  /// Check the entries. ResponseParameters::check() allows x, y and z only at points.
  void check(const state::StateSolver<dim> &solver) const override
  {
    if (parameters.point.empty())
      component_of(solver, parameters);
    else
      find_point(solver, parameters);
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    if (parameters.point.empty())
      {
        const auto of_face = average(solver, state, parameters);
        return of_face.integral / of_face.area;
      }
    const auto e     = unit_vector<dim>(parameters);
    double     value = 0.;
    for (const auto &place : find_point(solver, parameters))
      {
        const auto u =
          solver.assemblers()[place.subdomain]->cell_values(place.cell,
                                                            state.u[place.subdomain].column(0));
        for (unsigned int a = 0; a < u.size(); ++a)
          value += place.weights[a] * (u[a] * e);
      }
    // The sum is exact, because one rank has the point and all other ranks add 0.
    return dealii::Utilities::MPI::sum(value, solver.context().communicator());
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    return parameters.point.empty() ? partials_on_face(solver, state) : partials_at_point(solver);
  }

  /// Return dJ/du on a face. The result is empty for a point, because its load is
  /// concentrated there.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state) const override
  {
    FieldDerivative<dim> result;
    if (!parameters.point.empty())
      return result;
    const double area = average(solver, state, parameters).area;
    result.boundary   = find_boundary(solver, parameters);
    result.traction =
      [area, component = component_of(solver, parameters)](const dealii::Tensor<1, dim> &normal,
                                                           const dealii::Tensor<1, dim> &x) {
        return component.direction(x, normal) / area;
      };
    return result;
  }

private:
  /// Return the derivatives at a point. The weights depend on the place in the cell, which
  /// the design does not change. Therefore dJ/dX = 0.
  Partials<dim> partials_at_point(const state::StateSolver<dim> &solver) const
  {
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (const auto &assembler : solver.assemblers())
      result.u.emplace_back(assembler->n_dofs());
    for (const auto &place : find_point(solver, parameters))
      {
        Nodes<dim> r;
        for (const double weight : place.weights)
          r.push_back(weight * unit_vector<dim>(parameters));
        solver.assemblers()[place.subdomain]->add_cell_vector(place.cell, 1., r,
                                                              result.u[place.subdomain].column(0));
      }
    return result;
  }

  /// Return the derivatives on a face. With J = I / A, I = int u . e dA and A = int dA, the
  /// derivative is J' = I' / A - J A' / A. I is the work f(X) . u of a unit load, so dI/du = f and
  /// dI/dX is the gradient of that work, with the derivative of e.
  Partials<dim> partials_on_face(const state::StateSolver<dim>  &solver,
                                 const state::ContactState<dim> &state) const
  {
    const auto    component = component_of(solver, parameters);
    const auto    whole     = average(solver, state, parameters);
    const double  J         = whole.integral / whole.area;
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (const auto &assembler : solver.assemblers())
      result.u.emplace_back(assembler->n_dofs());
    for (const auto &face : faces_of(solver, parameters))
      {
        const auto &assembler = *solver.assemblers()[face.subdomain];
        const auto &load      = solver.face_load();
        const auto  cell_X    = assembler.cell_field(face.cell, state.positions);
        const auto  X         = at_face<dim>(face, cell_X);
        const auto  u =
          at_face<dim>(face, assembler.cell_values(face.cell, state.u[face.subdomain].column(0)));
        const auto points = load.quadrature_points(X), u_at = load.quadrature_points(u);
        const auto unit = unit_load(component, points);
        Nodes<dim> f, in_cell(cell_X.size()), gradient(X.size());
        load.force(X, unit, f);
        for (unsigned int a = 0; a < f.size(); ++a)
          // Add the share to the copies of the nodes in the subdomain of the face. The choice
          // of the copy does not matter, because derivatives u' are equal on all copies.
          in_cell[face.places[a]] += f[a] / whole.area;
        assembler.add_cell_vector(face.cell, 1., in_cell, result.u[face.subdomain].column(0));
        load.add_force_gradient(X, unit, u, 1. / whole.area, gradient);
        // A direction e about an axis turns with the Gauss points: add int ((de/dx)' u) . V dA / A.
        elasticity::FaceLoadValues<dim> turning;
        for (unsigned int q = 0; q < points.size(); ++q)
          turning.traction.push_back(transpose(component.derivative(points[q])) * u_at[q]);
        load.force(X, turning, f);
        for (unsigned int a = 0; a < f.size(); ++a)
          gradient[a] += f[a] / whole.area;
        // The area is int dA = int e . e dA with a unit vector e.
        dealii::Tensor<1, dim> e;
        e[0] = 1.;
        load.add_force_gradient(X, {{}, Nodes<dim>(X.size(), e), {}}, Nodes<dim>(X.size(), e),
                                -J / whole.area, gradient);
        const auto &nodes = solver.mesh().boundary_faces()[face.index].nodes;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          // Only the nodes of the face receive a gradient, because the shape functions of all
          // other nodes of the cell vanish on the face.
          result.positions[nodes[a]] += gradient[a];
      }
    return result;
  }

  const ResponseParameters parameters;
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> displacement(const ResponseParameters &parameters)
{
  return std::make_unique<Displacement<dim>>(parameters);
}

template std::unique_ptr<Response<2>> displacement(const ResponseParameters &);
template std::unique_ptr<Response<3>> displacement(const ResponseParameters &);
} // namespace snug::response
