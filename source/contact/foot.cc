#include <snug/base/errors.h>
#include <snug/contact/foot.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::contact {
namespace {
/// Coordinates of feet that are this close to those of a node are set to the node's, because
/// matching meshes of files differ by the rounding of their digits.
const double on_node = 1e-9;

/// A foot that is farther off its face than this fraction of the face is lost, because the
/// polynomials of the face have no meaning there.
const double lost = 1.;

/// Return sum_k values_k field_k.
template <int dim>
dealii::Tensor<1, dim> mean(const std::vector<double>                &values,
                            const std::vector<unsigned int>          &points,
                            const typename mesh::Surface<dim>::Field &field)
{
  dealii::Tensor<1, dim> sum;
  for (unsigned int k = 0; k < points.size(); ++k)
    sum += values[k] * field[points[k]];
  return sum;
}

/// Apply the transpose of mean(): field_k += values_k g.
template <int dim>
void spread(const std::vector<double>          &values,
            const std::vector<unsigned int>    &points,
            const dealii::Tensor<1, dim>       &g,
            typename mesh::Surface<dim>::Field &field)
{
  for (unsigned int k = 0; k < points.size(); ++k)
    field[points[k]] += values[k] * g;
}

/// Return a vector of face coordinates extended by a length to dim components. The component of the
/// length is 0, because only coordinates count.
template <int dim>
dealii::Tensor<1, dim> with_length(const dealii::Tensor<1, dim - 1> &of_coordinates)
{
  dealii::Tensor<1, dim> result;
  for (int a = 0; a < dim - 1; ++a)
    result[a] = of_coordinates[a];
  return result;
}
} // namespace

template <int dim>
Foot<dim>::Foot(const mesh::Surface<dim>    &surface,
                const faces::FaceShape<dim> &shape,
                const Projection<dim>       &projection,
                const Field                 &positions,
                const Field                 &normals)
  : paired(projection)
  , face(surface.faces()[projection.face])
  , shape(shape)
  , start(projection.xi)
  , follows(false)
{
  bool any_fixed = false;
  for (int a = 0; a < dim - 1; ++a)
    {
      const double nearest = std::round(start[a] * shape.degree()) / shape.degree();
      equations.fixed[a]   = !projection.is_ray || std::abs(start[a] - nearest) < on_node;
      if (equations.fixed[a])
        start[a] = nearest;
      any_fixed = any_fixed || equations.fixed[a];
      follows   = follows || !equations.fixed[a];
    }
  if (follows && any_fixed)
    equations.rows =
      transpose(rays(positions, normals).at(start, positions[projection.slave]).slope);
  for (unsigned int k = 0; k < face.nodes.size(); ++k)
    {
      bool on_lines = true;
      for (int a = 0; a < dim - 1; ++a)
        on_lines = on_lines && (!equations.fixed[a] || shape.node(k)[a] == start[a]);
      // The other nodes have zero weight for all values of the free coordinates, so rows must not
      // couple to these nodes.
      if (on_lines)
        taking_part.push_back(k);
    }
}

template <int dim>
typename Foot<dim>::Place Foot<dim>::at(const Field &positions, const Field &normals) const
{
  Place result(*this);
  result.masters = paired.masters;
  result.surface = paired.surface;
  if (!follows)
    return result;
  const auto of    = rays(positions, normals);
  const auto point = of.to(positions[paired.slave], start, equations);
  double     off   = 0.;
  for (int a = 0; a < dim - 1 && point; ++a)
    off = std::max({off, -point->values.point[a], point->values.point[a] - 1.});
  if (!point || off > lost)
    {
      std::ostringstream message;
      message << "the slave node at (" << positions[paired.slave]
              << ") has moved far off the master face it is paired with";
      throw TangledMesh(message.str());
    }
  result.off_face = off;
  result.point    = *point;
  result.masters.clear();
  for (const unsigned int k : taking_part)
    result.masters.emplace_back(face.nodes[k], point->values.value[k]);
  result.surface = result.masters;
  if (face.samples.empty())
    return result;
  result.hit = of.on_surface(point->values.point);
  result.surface.clear();
  for (unsigned int k = 0; k < face.samples.size(); ++k)
    result.surface.emplace_back(face.samples[k], result.hit.values.value[k]);
  return result;
}

/// Differentiate implicitly, first the foot, then the point where its ray meets the true surface.
template <int dim>
typename Foot<dim>::Slopes Foot<dim>::Place::slopes(const Field &velocity,
                                                    const Field &normal_velocity) const
{
  Slopes result{masters, {}};
  for (auto &weight : result.masters)
    weight.second = 0.;
  if (!foot->follows)
    return result;
  const auto &face = foot->face;
  const auto  dx   = mean<dim>(point.values.value, face.nodes, velocity);
  const auto  dv   = mean<dim>(point.values.value, face.nodes, normal_velocity);
  const auto  dF   = dx + point.t * dv - velocity[foot->paired.slave];
  auto        dxi  = -(inverse() * foot->equations.residual(dF));
  dxi[dim - 1]     = 0.;
  for (unsigned int i = 0; i < masters.size(); ++i)
    result.masters[i].second = with_length<dim>(point.values.gradient[foot->taking_part[i]]) * dxi;
  result.surface = result.masters;
  if (face.samples.empty())
    return result;
  const auto dy =
    mean<dim>(hit.values.value, face.samples, velocity) - dx - hit.s * dv - hit.foot_slope * dxi;
  const auto dzeta = -(dealii::invert(hit.slope) * dy);
  result.surface   = surface;
  for (unsigned int j = 0; j < surface.size(); ++j)
    result.surface[j].second = with_length<dim>(hit.values.gradient[j]) * dzeta;
  return result;
}

/// Apply the transposes of the steps of slopes() in reverse order.
template <int dim>
void Foot<dim>::Place::add_transpose(const std::vector<double> &by_masters,
                                     const std::vector<double> &by_surface,
                                     Field                     &gradient,
                                     Field                     &normal_gradient) const
{
  if (!foot->follows)
    return;
  const auto            &face = foot->face;
  dealii::Tensor<1, dim> by_xi, by_zeta;
  for (unsigned int i = 0; i < masters.size(); ++i)
    {
      const double by_weight = by_masters[i] + (face.samples.empty() ? by_surface[i] : 0.);
      by_xi += by_weight * with_length<dim>(point.values.gradient[foot->taking_part[i]]);
    }
  if (!face.samples.empty())
    {
      for (unsigned int j = 0; j < surface.size(); ++j)
        by_zeta += by_surface[j] * with_length<dim>(hit.values.gradient[j]);
      const auto by_y = -(by_zeta * dealii::invert(hit.slope));
      spread<dim>(hit.values.value, face.samples, by_y, gradient);
      spread<dim>(point.values.value, face.nodes, -by_y, gradient);
      spread<dim>(point.values.value, face.nodes, -hit.s * by_y, normal_gradient);
      by_xi -= by_y * hit.foot_slope;
      by_xi[dim - 1] = 0.;
    }
  const auto by_F = foot->equations.residual_transpose(-(by_xi * inverse()));
  spread<dim>(point.values.value, face.nodes, by_F, gradient);
  spread<dim>(point.values.value, face.nodes, point.t * by_F, normal_gradient);
  gradient[foot->paired.slave] -= by_F;
}

template class Foot<2>;
template class Foot<3>;
} // namespace snug::contact
