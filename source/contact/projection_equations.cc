#include <snug/base/errors.h>
#include <snug/contact/projection_equations.h>

#include <cmath>
#include <limits>

namespace snug::contact {
namespace {
const unsigned int max_iterations = 30;

/// This class detects the convergence of Newton's method: a step is below 1e-15, or it is below
/// 1e-12 and at least half of the previous step.
class Convergence
{
public:
  bool reached(const double move)
  {
    const bool is_reached = move <= 1e-15 || (move < 1e-12 && move >= 0.5 * before);
    before                = move;
    return is_reached;
  }

private:
  double before = std::numeric_limits<double>::max();
};

/// Add @p step to xi. @return the length of the step in face coordinates.
template <int dim>
double advance(dealii::Point<dim - 1> &xi, const dealii::Tensor<1, dim> &step)
{
  double move = 0.;
  for (int a = 0; a < dim - 1; ++a)
    {
      xi[a] += step[a];
      move += std::abs(step[a]);
    }
  return move;
}

/// Newton's method stops without a result if a step is longer than this number of faces.
const double wild = 10.;
} // namespace

template <int dim>
dealii::Tensor<2, dim> ReducedEquations<dim>::matrix(const dealii::Tensor<2, dim> &slope) const
{
  dealii::Tensor<2, dim> result = rows * slope;
  for (int a = 0; a < dim - 1; ++a)
    if (fixed[a])
      {
        result[a]    = dealii::Tensor<1, dim>();
        result[a][a] = 1.;
      }
  return result;
}

template <int dim>
typename ProjectionEquations<dim>::Point
ProjectionEquations<dim>::at(const Xi                     &xi,
                             const dealii::Tensor<1, dim> &origin,
                             std::optional<double>         t) const
{
  Point point;
  point.values = shape.at(xi);
  for (unsigned int k = 0; k < face.nodes.size(); ++k)
    {
      point.x += point.values.value[k] * (positions[face.nodes[k]] - origin);
      point.v += point.values.value[k] * normals[face.nodes[k]];
    }
  point.v -= of_slave;
  point.t       = t ? *t : -(point.x * point.v) / point.v.norm_square();
  const auto tx = faces::tangents<dim>(point.values, face.nodes, positions);
  const auto tv = faces::tangents<dim>(point.values, face.nodes, normals);
  for (int d = 0; d < dim; ++d)
    {
      for (int a = 0; a < dim - 1; ++a)
        point.slope[d][a] = tx[a][d] + point.t * tv[a][d];
      point.slope[d][dim - 1] = point.v[d];
    }
  return point;
}

template <int dim>
std::optional<typename ProjectionEquations<dim>::Point>
ProjectionEquations<dim>::solve(const dealii::Tensor<1, dim> &p,
                                const Xi                     &start,
                                const ReducedEquations<dim>  &equations) const
{
  Xi          xi    = start;
  Point       point = at(xi, p);
  Convergence convergence;
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      const auto matrix = equations.matrix(point.slope);
      if (!(std::abs(dealii::determinant(matrix)) > 0.))
        return {};
      const auto step = -(dealii::invert(matrix) * equations.residual(point.x + point.t * point.v));
      const double move = advance<dim>(xi, step);
      if (!(move < wild))
        return {};
      point = at(xi, p, point.t + step[dim - 1]);
      if (convergence.reached(move))
        return point;
    }
  return {};
}

template <int dim>
typename ProjectionEquations<dim>::Intersection
ProjectionEquations<dim>::intersection(const Xi &xi) const
{
  // Positions are relative to the face, because round-off far off the origin of the scene would
  // prevent convergence.
  const auto   origin = positions[face.nodes[0]];
  const auto   point  = at(xi, origin, 0.);
  Xi           zeta   = xi;
  Intersection result;
  Convergence  convergence;
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      result.values            = shape.samples_at(zeta);
      dealii::Tensor<1, dim> y = -(point.x + result.s * point.v);
      for (unsigned int k = 0; k < face.samples.size(); ++k)
        y += result.values.value[k] * (positions[face.samples[k]] - origin);
      const auto ty = faces::tangents<dim>(result.values, face.samples, positions);
      for (int d = 0; d < dim; ++d)
        {
          for (int a = 0; a < dim - 1; ++a)
            result.slope[d][a] = ty[a][d];
          result.slope[d][dim - 1] = -point.v[d];
        }
      if (!(std::abs(dealii::determinant(result.slope)) > 0.))
        break;
      const auto   step = -(dealii::invert(result.slope) * y);
      const double move = advance<dim>(zeta, step);
      result.s += step[dim - 1];
      if (!(move < wild))
        break;
      if (convergence.reached(move))
        {
          result.point_slope = at(xi, origin, result.s).slope;
          return result;
        }
    }
  throw TangledMesh("a contact face is folded: the normal at one of its points does not meet its "
                    "true surface");
}

#define SNUG_INSTANTIATE(dim)            \
  template struct ReducedEquations<dim>; \
  template class ProjectionEquations<dim>;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
