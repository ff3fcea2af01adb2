#include <snug/base/errors.h>
#include <snug/contact/normal_projection.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

namespace snug::contact {
namespace {
/// Coordinates of foot points that are this close to those of a node are set to the node's, because
/// matching meshes of files differ by the rounding of their digits.
const double on_node = 1e-9;

/// A foot point that is farther off its face than this fraction of the face is lost, because the
/// polynomials of the face have no meaning there.
const double lost = 1.;

/// Return sum_k values_k field_k.
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> mean(const std::vector<double>            &values,
                                    const std::vector<unsigned int>      &points,
                                    const faces::PointField<dim, Number> &field)
{
  dealii::Tensor<1, dim, Number> sum;
  for (unsigned int k = 0; k < points.size(); ++k)
    sum += values[k] * field[points[k]];
  return sum;
}

/// Return the derivatives of the solution of F = 0, where @p F is evaluated at the solution without
/// its derivatives and @p jacobian is the derivative of F with respect to the solution. The value
/// of the result is 0.
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> implicit_derivative(const dealii::Tensor<2, dim>         &jacobian,
                                                   const dealii::Tensor<1, dim, Number> &F)
{
  dealii::Tensor<1, dim, Number> step = -(dealii::invert(jacobian) * F);
  for (int d = 0; d < dim; ++d)
    step[d] -= Number(faces::value_of(step[d]));
  return step;
}

/// Return shape function @p k with its derivatives along @p dxi, whose last component does not
/// count.
template <int dim, typename Number>
Number shape_function(const typename faces::FaceShape<dim>::Values &values,
                      const unsigned int                            k,
                      const dealii::Tensor<1, dim, Number>         &dxi)
{
  Number result = values.value[k];
  for (int a = 0; a < dim - 1; ++a)
    result += values.gradient[k][a] * dxi[a];
  return result;
}
} // namespace

template <int dim>
NormalProjection<dim>::NormalProjection(const mesh::Surface<dim>                &surface,
                                        const faces::FaceShape<dim>             &shape,
                                        const Projection<dim>                   &projection,
                                        const Field                             &positions,
                                        const typename PairNormals<dim>::Fields &normals)
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
      reduced.fixed[a]     = !projection.is_normal || std::abs(start[a] - nearest) < on_node;
      if (reduced.fixed[a])
        start[a] = nearest;
      any_fixed = any_fixed || reduced.fixed[a];
      follows   = follows || !reduced.fixed[a];
    }
  if (follows && any_fixed)
    reduced.rows = transpose(equations(positions, normals.master, normals.slave[projection.slave])
                               .at(start, positions[projection.slave])
                               .slope);
  for (unsigned int k = 0; k < face.nodes.size(); ++k)
    {
      bool on_lines = true;
      for (int a = 0; a < dim - 1; ++a)
        on_lines = on_lines && (!reduced.fixed[a] || shape.node(k)[a] == start[a]);
      // The other nodes have zero weight for all values of the free coordinates, so rows must not
      // couple to these nodes.
      if (on_lines)
        taking_part.push_back(k);
    }
}

/// Return the largest distance of @p xi off [0,1].
template <int dim>
double NormalProjection<dim>::off_face(const dealii::Point<dim - 1> &xi) const
{
  double off = 0.;
  for (int a = 0; a < dim - 1; ++a)
    off = std::max({off, -xi[a], xi[a] - 1.});
  return off;
}

template <int dim>
typename ProjectionEquations<dim>::Point
NormalProjection<dim>::solve(const Field &positions, const Equations &equations) const
{
  const auto point = equations.solve(positions[paired.slave], start, reduced);
  if (point && off_face(point->values.point) <= lost)
    return *point;
  std::ostringstream message;
  message << "the slave node at (" << positions[paired.slave]
          << ") has moved far off the master face it is paired with";
  throw TangledMesh(message.str());
}

template <int dim>
template <typename Number>
typename NormalProjection<dim>::template Value<Number>
NormalProjection<dim>::at(const faces::PointField<dim, Number> &x,
                          const NormalFields<dim, Number>      &n) const
{
  auto                           result = weights(x, n);
  dealii::Tensor<1, dim, Number> v;
  for (const auto &[node, weight] : result.masters)
    v -= weight * n.master[node];
  if (n.slave.values()[paired.slave].norm_square() > 0.)
    v += n.slave[paired.slave];
  result.normal = unit_normal(v);
  return result;
}

/// Differentiate implicitly, first the foot point, then the point where v meets the true surface.
template <int dim>
template <typename Number>
typename NormalProjection<dim>::template Value<Number>
NormalProjection<dim>::weights(const faces::PointField<dim, Number> &x,
                               const NormalFields<dim, Number>      &n) const
{
  const bool                     differentiate = !std::is_same<Number, double>::value;
  dealii::Tensor<1, dim, Number> dxi, dzeta, x_of_xi, v_of_xi;
  Value<Number>                  result;
  if (!follows)
    {
      result.masters.assign(paired.masters.begin(), paired.masters.end());
      result.surface.assign(paired.surface.begin(), paired.surface.end());
      return result;
    }
  const auto &of_slave = n.slave.values()[paired.slave];
  const auto  here     = equations(x.values(), n.master.values(), of_slave);
  const auto  point    = solve(x.values(), here);
  result.off_face      = off_face(point.values.point);
  if (differentiate)
    {
      x_of_xi = mean(point.values.value, face.nodes, x);
      v_of_xi = mean(point.values.value, face.nodes, n.master);
      if (of_slave.norm_square() > 0.)
        v_of_xi -= n.slave[paired.slave];
      dxi = implicit_derivative(reduced.matrix(point.slope),
                                reduced.residual(x_of_xi + point.t * v_of_xi - x[paired.slave]));
      // Only coordinates count from here on.
      dxi[dim - 1] = 0.;
    }
  for (const unsigned int k : taking_part)
    result.masters.emplace_back(face.nodes[k], shape_function<dim>(point.values, k, dxi));
  result.surface = result.masters;
  if (face.samples.empty())
    return result;
  const auto meets = here.intersection(point.values.point);
  if (differentiate)
    dzeta = implicit_derivative(meets.slope, mean(meets.values.value, face.samples, x) - x_of_xi -
                                               meets.s * v_of_xi - meets.point_slope * dxi);
  result.surface.clear();
  for (unsigned int k = 0; k < face.samples.size(); ++k)
    result.surface.emplace_back(face.samples[k], shape_function<dim>(meets.values, k, dzeta));
  return result;
}

#define SNUG_INSTANTIATE_NUMBER(dim, Number)                               \
  template NormalProjection<dim>::Value<Number> NormalProjection<dim>::at( \
    const faces::PointField<dim, Number> &, const NormalFields<dim, Number> &) const;
#define SNUG_INSTANTIATE(dim)                          \
  template class NormalProjection<dim>;                \
  SNUG_INSTANTIATE_NUMBER(dim, double)                 \
  SNUG_INSTANTIATE_NUMBER(dim, faces::Differential<1>) \
  SNUG_INSTANTIATE_NUMBER(dim, faces::Recorded)
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
#undef SNUG_INSTANTIATE_NUMBER
} // namespace snug::contact
