#include <snug/faces/closest_point.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::faces {
namespace {
/// phi = 1/2 |x(xi) - p|^2 with its derivatives, and J'J in gauss_newton.
template <int dim>
struct DistanceExpansion
{
  dealii::Tensor<1, dim>     offset; ///< x - p
  double                     phi;
  dealii::Tensor<1, dim - 1> gradient;
  dealii::Tensor<2, dim - 1> hessian, gauss_newton;
};

/// This class is half the squared distance of @p p to the points of a face as a function of their
/// coordinates xi.
template <int dim>
class DistanceToFace
{
public:
  DistanceToFace(const FaceShape<dim>                      &shape,
                 const std::vector<dealii::Tensor<1, dim>> &nodes,
                 const dealii::Tensor<1, dim>              &p)
    : shape(shape), nodes(nodes), p(p)
  {}

  /// Return phi alone.
  double at(const typename FaceShape<dim>::Values &values) const
  {
    dealii::Tensor<1, dim> offset;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      offset += values.value[k] * (nodes[k] - p);
    return 0.5 * offset.norm_square();
  }

  DistanceExpansion<dim> expand(const dealii::Point<dim - 1> &xi) const
  {
    DistanceExpansion<dim>                      result;
    const auto                                  values = shape.at(xi);
    std::array<dealii::Tensor<1, dim>, dim - 1> t;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        // The sum of the shape functions is 1, so p may be subtracted first. This preserves the
        // digits of small distances far from the origin. The same holds for tangents, because the
        // derivatives of the shape functions sum to 0.
        const dealii::Tensor<1, dim> x = nodes[k] - p;
        result.offset += values.value[k] * x;
        for (int i = 0; i < dim - 1; ++i)
          t[i] += values.gradient[k][i] * x;
      }
    result.phi = 0.5 * result.offset.norm_square();
    for (int i = 0; i < dim - 1; ++i)
      {
        result.gradient[i] = t[i] * result.offset;
        for (int j = 0; j < dim - 1; ++j)
          result.gauss_newton[i][j] = t[i] * t[j];
      }
    // phi,_ij = x,_i . x,_j + (x - p) . x,_ij; the second term vanishes only on straight segments
    // and parallelograms.
    result.hessian = result.gauss_newton;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      result.hessian += (result.offset * (nodes[k] - p)) * values.hessian[k];
    return result;
  }

private:
  const FaceShape<dim>                      &shape;
  const std::vector<dealii::Tensor<1, dim>> &nodes;
  const dealii::Tensor<1, dim>              &p;
};

/// Return whether @p m is positive definite. Beyond the centre of curvature of the face, the
/// Hessian is indefinite. The factor 1e-10 also excludes Hessians whose inverse would be round-off.
bool positive_definite(const dealii::Tensor<2, 1> &m)
{
  return m[0][0] > 0.;
}

bool positive_definite(const dealii::Tensor<2, 2> &m)
{
  return m[0][0] > 0. && m[1][1] > 0. && dealii::determinant(m) > 1e-10 * m[0][0] * m[1][1];
}

/// Return whether coordinate @p x is at a bound and a descent step along -@p slope would leave it.
/// Such coordinates are active constraints of the projected Newton method.
bool held(double x, double slope)
{
  return (x <= 0. && slope > 0.) || (x >= 1. && slope < 0.);
}

/// Return the Newton step in the coordinates not held by their bounds, or a diagonally scaled
/// gradient step where the Newton step would leave through a bound.
template <int dim>
dealii::Tensor<1, dim - 1> newton_step(const dealii::Point<dim - 1> &xi,
                                       const DistanceExpansion<dim> &at)
{
  dealii::Tensor<1, dim - 1> slope  = at.gradient;
  dealii::Tensor<2, dim - 1> newton = at.hessian;
  // The first pass uses the Hessian. The second pass uses J'J if the Hessian is not positive
  // definite.
  for (int pass = 0; pass < 2; ++pass)
    {
      for (int i = 0; i < dim - 1; ++i)
        if (held(xi[i], at.gradient[i]))
          {
            for (int j = 0; j < dim - 1; ++j)
              newton[i][j] = newton[j][i] = 0.;
            // A held coordinate gets no step, but its diagonal entry must keep the matrix regular.
            newton[i][i] = at.gauss_newton[i][i];
            slope[i]     = 0.;
          }
      if (positive_definite(newton))
        break;
      newton = at.gauss_newton;
    }
  dealii::Tensor<1, dim - 1> step;
  // The Newton step of a free coordinate may leave through a bound at which the coordinate is, and
  // its projection would be no step at all. The scaled gradient step points inwards there, because
  // `held` has excluded the other coordinates.
  bool bad = !positive_definite(newton);
  if (!bad)
    step = -(dealii::invert(newton) * slope);
  for (int i = 0; i < dim - 1; ++i)
    bad = bad || held(xi[i], -step[i]);
  if (bad)
    for (int i = 0; i < dim - 1; ++i)
      step[i] = -slope[i] / at.gauss_newton[i][i];
  return step;
}

/// Return the samples of phi on a grid that have no closer neighbour.
template <int dim>
std::vector<dealii::Point<dim - 1>> starting_points(const FaceShape<dim> &shape,
                                                    DistanceToFace<dim>  &distance)
{
  const int           n    = 2 * shape.degree() + 1;
  const int           rows = dim == 2 ? 1 : n;
  std::vector<double> phi;
  phi.reserve(n * rows);
  for (const auto &values : shape.grid())
    phi.push_back(distance.at(values));
  std::vector<dealii::Point<dim - 1>> starts;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < n; ++i)
      {
        // Equal neighbours are both kept, because descents from both find the same point.
        bool least = true;
        for (int b = std::max(0, j - 1); b <= std::min(rows - 1, j + 1); ++b)
          for (int a = std::max(0, i - 1); a <= std::min(n - 1, i + 1); ++a)
            least = least && phi[a + n * b] >= phi[i + n * j];
        if (least)
          starts.push_back(shape.grid()[i + n * j].point);
      }
  return starts;
}

/// Iterate from @p xi with the projected Newton method.
template <int dim>
ClosestPoint<dim> descend(DistanceToFace<dim> &distance, dealii::Point<dim - 1> xi)
{
  // Round-off of phi relative to phi, and round-off of xi.
  const double           phi_noise = 1e-15, converged = 1e-15;
  const unsigned int     max_iterations = 100;
  DistanceExpansion<dim> at             = distance.expand(xi);
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      const dealii::Tensor<1, dim - 1> step = newton_step<dim>(xi, at);
      double                           move = 0.;
      // Backtrack along the path that is projected onto the bounds.
      for (double length = 1.; length > 1e-10; length *= 0.5)
        {
          dealii::Point<dim - 1>     trial = xi + length * step;
          dealii::Tensor<1, dim - 1> moved;
          for (int i = 0; i < dim - 1; ++i)
            {
              trial[i] = std::min(1., std::max(0., trial[i]));
              moved[i] = trial[i] - xi[i];
            }
          const DistanceExpansion<dim> next = distance.expand(trial);
          // Check Armijo's condition for the step as projected onto the bounds. Close to the
          // minimum, the decrease is below the round-off of phi. Without the noise term the last
          // digits of xi would not be found.
          if (next.phi <= at.phi * (1. + phi_noise) + 1e-4 * (at.gradient * moved))
            {
              move = moved.norm();
              xi   = trial;
              at   = next;
              break;
            }
        }
      if (move <= converged)
        break;
    }
  return {xi, at.offset, at.offset.norm_square()};
}
} // namespace

template <int dim>
ClosestPoint<dim> closest_point(const FaceShape<dim>                      &shape,
                                const std::vector<dealii::Tensor<1, dim>> &nodes,
                                const dealii::Tensor<1, dim>              &p)
{
  DistanceToFace<dim> distance(shape, nodes, p);
  ClosestPoint<dim>   best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  for (const auto &start : starting_points<dim>(shape, distance))
    {
      const ClosestPoint<dim> found = descend<dim>(distance, start);
      // Different starts may end in different minima. Take the closest one, and the first of equal
      // ones.
      if (found.squared_distance < best.squared_distance)
        best = found;
    }
  best.position += p;
  return best;
}

template ClosestPoint<2> closest_point(const FaceShape<2> &,
                                       const std::vector<dealii::Tensor<1, 2>> &,
                                       const dealii::Tensor<1, 2> &);
template ClosestPoint<3> closest_point(const FaceShape<3> &,
                                       const std::vector<dealii::Tensor<1, 3>> &,
                                       const dealii::Tensor<1, 3> &);
} // namespace snug::faces
