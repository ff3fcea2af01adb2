#include <snug/accuracy/surface_layer.h>
#include <snug/elasticity/cell_point.h>
#include <snug/faces/face_shape.h>
#include <snug/mesh/face_nodes.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace snug::accuracy {
namespace {
/// Relative distance off the face below which the way to the true surface counts as along the face.
const double rounding = 1e-10;

/// Return sigma : C^-1 tau. The formula holds in all idealizations, because stresses have all
/// their components.
double energy(const elasticity::Material          &material,
              const dealii::SymmetricTensor<2, 3> &sigma,
              const dealii::SymmetricTensor<2, 3> &tau)
{
  const double nu = material.poissons_ratio;
  return ((1. + nu) * (sigma * tau) - nu * trace(sigma) * trace(tau)) / material.youngs_modulus;
}
} // namespace

template <int dim>
SurfaceLayer<dim>::SurfaceLayer(const state::StateSolver<dim>  &solver,
                                const state::ContactState<dim> &state)
  : solver(solver), state(state), fields(solver, state), applied(solver, state)
{}

template <int dim>
std::vector<typename SurfaceLayer<dim>::Point> SurfaceLayer<dim>::points(const Face &face) const
{
  const auto                   &mesh      = solver.mesh();
  const auto                   &reference = mesh.reference_positions();
  const faces::FaceShape<dim>   shape(mesh.degree());
  const dealii::QGauss<dim - 1> gauss(mesh.degree() + 2);
  std::vector<Point>            result;
  const auto mean = [](const auto &values, const auto &points, const Field &field) {
    dealii::Tensor<1, dim> sum;
    for (unsigned int k = 0; k < points.size(); ++k)
      sum += values.value[k] * field[points[k]];
    return sum;
  };
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const auto at_nodes   = shape.at(gauss.point(q));
      const auto at_samples = shape.samples_at(gauss.point(q));
      const auto place      = mesh::point_on_face<dim>(face.number, gauss.point(q));
      const auto here       = [&](const auto &values, const auto &points, const Field &field) {
        const auto   x = mean(values, points, field);
        const double w = gauss.weight(q) * mesh.idealization().weight(x);
        return FacePoint<dim>{mean(values, points, reference), x,
                              w * faces::area_vector(faces::tangents<dim>(values, points, field))};
      };
      result.push_back({mesh::lagrange_point<dim>(mesh.degree(), place),
                        here(at_nodes, face.nodes, fields.local_positions),
                        here(at_samples, face.samples, state.positions)});
    }
  return result;
}

template <int dim>
bool SurfaceLayer<dim>::is_supported(const Face &face) const
{
  const auto &supports = solver.model().supports;
  return solver.points().moves(face.body, face.boundary) ||
         std::any_of(supports.begin(), supports.end(), [&](const auto &support) {
           return support.body == face.body && support.boundary == face.boundary;
         });
}

/// Return the local values. Total forces, contact forces and support forces, which are given by
/// the stress, are equal on the face and on the true surface, whatever their areas. They act where
/// the normal of the face meets the true surface, because samples may lie off this point where
/// faces are graded.
template <int dim>
std::vector<typename SurfaceLayer<dim>::Local>
SurfaceLayer<dim>::locals(const Face                 &face,
                          const std::vector<Point>   &at,
                          const Loaded               &of,
                          const ContactPressure<dim> *contact) const
{
  std::vector<mesh::LagrangePoint<dim>> shapes;
  for (const auto &point : at)
    shapes.push_back(point.shape);
  const auto         X        = fields.positions(face.cell);
  const auto         v        = fields.at_cell(face.cell, of.displacement);
  const auto         stresses = fields.stresses(face.cell, of.displacement, of.thermal, shapes);
  const auto         fluxes   = fields.fluxes(face.cell, of, shapes);
  std::vector<Local> result;
  for (unsigned int q = 0; q < at.size(); ++q)
    {
      const auto &[shape, on_face, on_surface] = at[q];
      const auto gradient =
        elasticity::CellPoint<dim>(shape, X, solver.mesh().idealization()).gradient(v);
      const auto change = [&](const dealii::Tensor<1, dim> &way) {
        dealii::Tensor<1, dim> sum;
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            sum[c] += gradient[c][d] * way[d];
        return sum;
      };
      const auto normal = on_face.area / on_face.area.norm();
      const auto delta  = on_surface.position - on_face.position;
      Local      local  = {stresses[q],
                           elasticity::value(shape, v),
                           change(delta),
                           change((delta * normal) * normal),
                           {},
                           {},
                           {}};
      if (is_supported(face))
        local.same = traction<dim>(fluxes[q], on_face.area);
      else
        {
          local.same = applied.spread(face, on_face, of);
          if (contact)
            local.same -= contact->value(face, shape.value, on_face.position) * on_face.area;
          local.by_area        = applied.by_area(face, on_face, of);
          local.by_area_beyond = applied.by_area(face, on_surface, of);
        }
      result.push_back(local);
    }
  return result;
}

/// Return the work difference [F . v] of the forces.
template <int dim>
double SurfaceLayer<dim>::work_beyond(const Local &of, const Local &on)
{
  return of.same * on.change_along_normal + of.by_area_beyond * (on.value + on.change) -
         of.by_area * on.value;
}

template <int dim>
std::vector<std::vector<double>> SurfaceLayer<dim>::works(const std::vector<Loaded> &of) const
{
  const auto                                        &mesh = solver.mesh();
  std::vector<std::unique_ptr<ContactPressure<dim>>> contact;
  for (const auto &one : of)
    contact.push_back(solver.contact(state.load_case).n_rows() == 0
                        ? nullptr
                        : std::make_unique<ContactPressure<dim>>(solver,
                                                                 solver.contact(state.load_case),
                                                                 state, one.pressures));
  std::vector<std::vector<double>> result(mesh.cells().size(), std::vector<double>(of.size(), 0.));
  for (const auto &face : mesh.boundary_faces())
    {
      if (face.samples.empty())
        continue;
      const auto at      = points(face);
      const bool is_flat = std::all_of(at.begin(), at.end(), [](const Point &point) {
        const auto delta = point.on_surface.position - point.on_face.position;
        return std::abs(delta * point.on_face.area) <=
               rounding * delta.norm() * point.on_face.area.norm();
      });
      if (is_flat)
        continue;
      std::vector<std::vector<Local>> all;
      for (unsigned int j = 0; j < of.size(); ++j)
        all.push_back(locals(face, at, of[j],
                             contact[j] && contact[j]->is_on(face) ? contact[j].get() : nullptr));
      for (unsigned int j = 0; j < of.size(); ++j)
        for (unsigned int q = 0; q < at.size(); ++q)
          {
            const auto  &u = all[0][q], &v = all[j][q];
            const double volume =
              (at[q].on_surface.position - at[q].on_face.position) * at[q].on_face.area;
            const auto &reference = at[q].on_face.reference;
            const auto &cell      = mesh.cells()[face.cell];
            result[face.cell][j] +=
              volume * (energy(fields.material(face.cell), u.stress, v.stress) -
                        applied.by_volume(cell, reference, of[0]) * v.value -
                        applied.by_volume(cell, reference, of[j]) * u.value) -
              work_beyond(u, v) - work_beyond(v, u);
          }
    }
  return result;
}

template class SurfaceLayer<2>;
template class SurfaceLayer<3>;
} // namespace snug::accuracy
