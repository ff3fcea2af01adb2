#include <snug/accuracy/contact_pressure.h>
#include <snug/accuracy/local_errors.h>
#include <snug/elasticity/cell_point.h>
#include <snug/mesh/shared_nodes.h>

namespace snug::accuracy {
template <int dim>
LocalErrors<dim>::LocalErrors(const state::StateSolver<dim>  &solver,
                              const state::ContactState<dim> &state)
  : solver(solver)
  , state(state)
  , mesh(solver.mesh())
  , positions(mesh::owners_values(mesh, state.positions))
  , held(mesh.cells().size())
{
  const unsigned int p = mesh.degree();
  for (const auto &body : solver.model().bodies)
    {
      elements.emplace_back(p, mesh.idealization(), body.formulation);
      local.emplace_back(p, mesh.idealization(), body.formulation);
    }
  for (unsigned int face = 0; face < 2 * dim; ++face)
    for (const auto &on_face : mesh::lagrange_gauss_points<dim - 1>(p + 1))
      {
        dealii::Point<dim> point;
        for (unsigned int axis = 0, at = 0; axis < dim; ++axis)
          point[axis] = axis == face / 2 ? face % 2 : on_face.point[at++];
        face_points[face].push_back(mesh::lagrange_point<dim>(p, point));
        face_points[face].back().weight = on_face.weight;
      }
  find_held();
}

template <int dim>
const elasticity::Material &
LocalErrors<dim>::material(const typename mesh::BodyMesh<dim>::Cell &cell) const
{
  return solver.model().bodies[cell.body].material(cell);
}

template <int dim>
typename LocalErrors<dim>::Nodes LocalErrors<dim>::at_cell(const unsigned int cell,
                                                           const Field       &field) const
{
  Nodes result;
  for (const unsigned int node : mesh.known_cell(cell).nodes)
    result.push_back(field[node]);
  return result;
}

/// n dA out of the cell: det J J^-T times that of the reference cell, by the weight of the section.
template <int dim>
dealii::Tensor<1, dim> LocalErrors<dim>::area_vector(const mesh::LagrangePoint<dim> &shape,
                                                     const unsigned int              face,
                                                     const Nodes                    &X) const
{
  const auto             J = elasticity::jacobian(shape, X);
  dealii::Tensor<1, dim> n = dealii::Tensor<2, dim>(invert(J))[face / 2];
  return (face % 2 == 0 ? -1. : 1.) * determinant(J) * shape.weight *
         mesh.idealization().weight(elasticity::value(shape, X)) * n;
}

/// Normals of a face at its centre; the axis of revolution holds the radius.
template <int dim>
void LocalErrors<dim>::find_held()
{
  for (const auto &face : mesh.boundary_faces())
    {
      auto      &directions = held[face.cell][face.number];
      const auto X          = at_cell(face.cell, positions);
      const auto hold       = [&](dealii::Tensor<1, dim> v) {
        for (const auto &other : directions)
          v -= (v * other) * other;
        if (v.norm() > 1e-6)
          directions.push_back(v / v.norm());
      };
      for (const auto &support : solver.model().supports)
        if (support.body == face.body && support.boundary == face.boundary)
          {
            dealii::Tensor<1, dim> v;
            if (support.component == supports::Support<dim>::normal)
              for (const auto &shape : face_points[face.number])
                v += area_vector(shape, face.number, X);
            else
              v[support.component] = 1.;
            hold(v / v.norm());
          }
      bool on_axis = mesh.idealization().is_axisymmetric();
      for (const unsigned int node : face.nodes)
        on_axis = on_axis && positions[node][0] == 0.;
      if (on_axis)
        hold(dealii::Point<dim>::unit_vector(0));
    }
}

template <int dim>
void LocalErrors<dim>::add_cells(const LoadedDisplacement<dim> &of, std::vector<Residual> &r) const
{
  const auto &bodies = solver.model().load_cases[state.load_case].bodies;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    {
      const auto &the_cell = mesh.cells()[cell];
      const auto &loads    = bodies[the_cell.body];
      const auto &problem  = local[the_cell.body];
      Nodes       b;
      if (of.has_loads && (loads.body_force || loads.gravity.norm() > 0.))
        for (const auto &x : problem.quadrature_points(at_cell(cell, mesh.reference_positions())))
          {
            b.push_back(material(the_cell).density * loads.gravity);
            if (loads.body_force)
              b.back() += loads.body_force(dealii::Point<dim>(x));
          }
      problem.add_residual(at_cell(cell, positions), material(the_cell),
                           at_cell(cell, of.displacement), b, r[cell].data());
    }
}

/// The mean of both stresses, so that what one cell gets the other gives.
template <int dim>
void LocalErrors<dim>::add_interior_faces(const Field &displacement, std::vector<Residual> &r) const
{
  const unsigned int n_owned = mesh.cells().size();
  for (const auto &face : mesh.interior_faces())
    {
      const auto                           &points = face_points[face.face];
      std::vector<mesh::LagrangePoint<dim>> beyond;
      for (const auto &shape : points)
        beyond.push_back(mesh::lagrange_point<dim>(mesh.degree(), face.in_neighbour(shape.point)));
      const auto X      = at_cell(face.cell, positions);
      const auto stress = [&](const unsigned int cell, const auto &at) {
        const auto &the_cell = mesh.known_cell(cell);
        return elements[the_cell.body].stresses(at_cell(cell, positions), material(the_cell),
                                                at_cell(cell, displacement), at);
      };
      const auto here  = stress(face.cell, points);
      const auto there = stress(face.neighbour, beyond);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto             area = area_vector(points[q], face.face, X);
          const auto             mean = 0.5 * (here[q] + there[q]);
          dealii::Tensor<1, dim> force;
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              force[c] += mean[c][d] * area[d];
          const unsigned int body = mesh.known_cell(face.cell).body;
          if (face.cell < n_owned)
            local[body].add_force(points[q].point, force, r[face.cell].data());
          if (face.neighbour < n_owned)
            local[body].add_force(beyond[q].point, -force, r[face.neighbour].data());
        }
    }
}

template <int dim>
void LocalErrors<dim>::add_loads(std::vector<Residual> &r) const
{
  const auto &bodies    = solver.model().load_cases[state.load_case].bodies;
  const auto  tractions = solver.resultants().tractions(state.positions);
  for (const auto &face : mesh.boundary_faces())
    {
      const auto found  = bodies[face.body].boundaries.find(face.boundary);
      const auto linear = tractions[state.load_case].find({face.body, face.boundary});
      if (found == bodies[face.body].boundaries.end())
        continue;
      const auto &load      = found->second;
      const auto  X         = at_cell(face.cell, positions);
      const auto  reference = at_cell(face.cell, mesh.reference_positions());
      for (const auto &shape : face_points[face.number])
        {
          const auto             area = area_vector(shape, face.number, X);
          const auto             at   = dealii::Point<dim>(elasticity::value(shape, reference));
          dealii::Tensor<1, dim> force;
          if (load.pressure)
            force -= load.pressure(at) * area;
          if (load.traction)
            force += area.norm() * load.traction(at);
          if (linear != tractions[state.load_case].end())
            force += area.norm() * linear->second.value(elasticity::value(shape, X));
          local[face.body].add_force(shape.point, force, r[face.cell].data());
        }
    }
}

template <int dim>
void LocalErrors<dim>::add_contact(const std::vector<double> &pressures,
                                   std::vector<Residual>     &r) const
{
  const ContactPressure<dim> contact(solver, state.positions, pressures);
  for (const auto &face : mesh.boundary_faces())
    if (contact.is_on(face))
      {
        const auto X = at_cell(face.cell, positions);
        for (const auto &shape : face_points[face.number])
          {
            const double p = contact.value(face, shape.value, elasticity::value(shape, X));
            if (p != 0.)
              local[face.body].add_force(shape.point, -p * area_vector(shape, face.number, X),
                                         r[face.cell].data());
          }
      }
}

template <int dim>
std::vector<std::vector<double>>
LocalErrors<dim>::products(const std::vector<LoadedDisplacement<dim>> &of) const
{
  const unsigned int                 n_cells = mesh.cells().size(), n = of.size();
  std::vector<std::vector<Residual>> residuals; // [displacement][cell]
  for (const auto &one : of)
    {
      residuals.emplace_back(n_cells);
      for (unsigned int cell = 0; cell < n_cells; ++cell)
        residuals.back()[cell].assign(local[mesh.cells()[cell].body].size(), 0.);
      LoadedDisplacement<dim> everywhere = one;
      everywhere.displacement            = mesh::owners_values(mesh, one.displacement);
      add_cells(everywhere, residuals.back());
      add_interior_faces(everywhere.displacement, residuals.back());
      if (one.has_loads)
        add_loads(residuals.back());
      if (solver.contact().n_rows() > 0)
        add_contact(one.pressures, residuals.back());
    }
  std::vector<std::vector<double>> result(n_cells, std::vector<double>(n * n, 0.));
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    {
      const auto           &the_cell = mesh.cells()[cell];
      std::vector<Residual> errors;
      for (const auto &r : residuals)
        errors.push_back(r[cell]);
      local[the_cell.body].solve(at_cell(cell, positions), material(the_cell), held[cell], errors);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          // a(e_i, e_j) = r_i(e_j)
          for (unsigned int k = 0; k < errors[j].size(); ++k)
            result[cell][i * n + j] += residuals[i][cell][k] * errors[j][k];
    }
  return result;
}

template class LocalErrors<2>;
template class LocalErrors<3>;
} // namespace snug::accuracy
