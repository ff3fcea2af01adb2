#include <snug/accuracy/surface_layer.h>
#include <snug/elasticity/cell_point.h>
#include <snug/faces/face_shape.h>
#include <snug/mesh/face_nodes.h>

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
  : solver(solver)
  , state(state)
  , fields(solver, state)
  , applied(solver, state)
  , gauss(solver.mesh().degree() + 2)
{
  const unsigned int          degree = solver.mesh().degree();
  const faces::FaceShape<dim> shape(degree);
  for (const auto &point : gauss.get_points())
    {
      at_nodes.push_back(shape.at(point));
      at_samples.push_back(shape.samples_at(point));
      for (unsigned int face = 0; face < 2 * dim; ++face)
        in_cell[face].push_back(
          mesh::lagrange_point<dim>(degree, mesh::point_on_face<dim>(face, point)));
    }
}

template <int dim>
std::vector<typename SurfaceLayer<dim>::Point> SurfaceLayer<dim>::points(const Face &face) const
{
  const auto        &mesh = solver.mesh();
  std::vector<Point> result;
  const auto         mean = [](const auto &values, const auto &points, const Field &field) {
    dealii::Tensor<1, dim> sum;
    for (unsigned int k = 0; k < points.size(); ++k)
      sum += values.value[k] * field[points[k]];
    return sum;
  };
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const auto here = [&](const auto &values, const auto &points, const Field &field) {
        const auto   x = mean(values, points, field);
        const double w = gauss.weight(q) * mesh.idealization().weight(x);
        return FacePoint<dim>{mean(values, points, mesh.reference_positions()), x,
                              w * faces::area_vector(faces::tangents<dim>(values, points, field))};
      };
      result.push_back({here(at_nodes[q], face.nodes, fields.local_positions),
                        here(at_samples[q], face.samples, state.positions)});
    }
  return result;
}

/// Return whether the true surface lies in the plane of the face.
template <int dim>
bool SurfaceLayer<dim>::is_flat(const std::vector<Point> &at) const
{
  return std::all_of(at.begin(), at.end(), [](const Point &point) {
    const auto delta = point.on_surface.position - point.on_face.position;
    return std::abs(delta * point.on_face.area) <=
           rounding * delta.norm() * point.on_face.area.norm();
  });
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

/// Return the local values of each displacement. Total forces, contact forces and support forces,
/// which are given by the stress, are equal on the face and on the true surface, whatever their
/// areas. They act where the normal of the face meets the true surface, because samples may lie off
/// this point where faces are graded.
template <int dim>
std::vector<std::vector<typename SurfaceLayer<dim>::Local>>
SurfaceLayer<dim>::locals(const Face                    &face,
                          const std::vector<Point>      &at,
                          const std::vector<Loaded>     &of,
                          const ContactSides<dim>       *sides,
                          const std::vector<PairValues> &pressures) const
{
  const auto &shapes    = in_cell[face.number];
  const auto  X         = fields.positions(face.cell);
  const auto  stresses  = fields.stresses(face.cell, of, shapes);
  const bool  supported = is_supported(face);
  const auto  fluxes    = supported ? fields.fluxes(face.cell, of, shapes) : stresses;
  std::vector<std::vector<Local>> result(of.size());
  for (unsigned int q = 0; q < at.size(); ++q)
    {
      const auto &[on_face, on_surface] = at[q];
      const auto             normal     = on_face.area / on_face.area.norm();
      const auto             delta      = on_surface.position - on_face.position;
      std::vector<NodeShare> shares;
      if (sides && !supported && sides->is_on(face))
        shares = sides->shares(face, shapes[q].value, on_face.position);
      const elasticity::InverseJacobian<dim> jacobian(shapes[q], X, solver.mesh().idealization());
      for (unsigned int j = 0; j < of.size(); ++j)
        {
          const auto v        = fields.at_cell(face.cell, of[j].displacement);
          const auto gradient = jacobian.gradient(v);
          const auto change   = [&](const dealii::Tensor<1, dim> &way) {
            dealii::Tensor<1, dim> sum;
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                sum[c] += gradient[c][d] * way[d];
            return sum;
          };
          Local local               = {};
          local.stress              = stresses[j][q];
          local.value               = elasticity::value(shapes[q], v);
          local.change              = change(delta);
          local.change_along_normal = change((delta * normal) * normal);
          local.by_volume =
            applied.by_volume(solver.mesh().cells()[face.cell], on_face.reference, of[j]);
          if (supported)
            local.same = traction<dim>(fluxes[j][q], on_face.area);
          else
            {
              local.same = applied.spread(face, on_face, of[j]);
              if (!shares.empty())
                local.same -= value(shares, pressures[j]) * on_face.area;
              local.by_area        = applied.by_area(face, on_face, of[j]);
              local.by_area_beyond = applied.by_area(face, on_surface, of[j]);
            }
          result[j].push_back(local);
        }
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
  const auto                      &mesh    = solver.mesh();
  const auto                      &contact = solver.contact(state.load_case);
  std::optional<ContactSides<dim>> sides;
  std::vector<PairValues>          pressures;
  if (contact.n_rows() > 0)
    {
      sides.emplace(solver, contact, state);
      for (const auto &one : of)
        pressures.push_back(sides->values(one.pressures));
    }
  std::vector<std::vector<double>> result(mesh.cells().size(), std::vector<double>(of.size(), 0.));
  for (const auto &face : mesh.boundary_faces())
    {
      if (face.samples.empty())
        continue;
      const auto at = points(face);
      if (is_flat(at))
        continue;
      const auto all = locals(face, at, of, sides ? &*sides : nullptr, pressures);
      for (unsigned int j = 0; j < of.size(); ++j)
        for (unsigned int q = 0; q < at.size(); ++q)
          {
            const auto  &u = all[0][q], &v = all[j][q];
            const double volume =
              (at[q].on_surface.position - at[q].on_face.position) * at[q].on_face.area;
            result[face.cell][j] +=
              volume * (energy(fields.material(face.cell), u.stress, v.stress) -
                        u.by_volume * v.value - v.by_volume * u.value) -
              work_beyond(u, v) - work_beyond(v, u);
          }
    }
  return result;
}

template class SurfaceLayer<2>;
template class SurfaceLayer<3>;
} // namespace snug::accuracy
