#include <snug/base/errors.h>
#include <snug/faces/face_map.h>
#include <snug/mesh/lagrange.h>

namespace snug::faces {
namespace {
/// Return x with A x = b. A has plain numbers even where b carries derivatives: one Newton step
/// with the derivative at the solution gives the derivatives of the solution exactly, independently
/// of the derivatives of A.
template <typename Number>
std::array<Number, 1> solve(const std::array<std::array<double, 1>, 1> &A,
                            const std::array<Number, 1>                &b)
{
  return {{b[0] * (1. / A[0][0])}};
}

template <typename Number>
std::array<Number, 2> solve(const std::array<std::array<double, 2>, 2> &A,
                            const std::array<Number, 2>                &b)
{
  const double d = 1. / (A[0][0] * A[1][1] - A[0][1] * A[1][0]);
  return {{(b[0] * A[1][1] - b[1] * A[0][1]) * d, (b[1] * A[0][0] - b[0] * A[1][0]) * d}};
}

/// Residual y - sum_k N_k(xi) y_k, and the derivative of the sum.
template <int dim, typename Number>
struct Residual
{
  FaceCoordinates<dim, Number>                     value;
  std::array<std::array<double, dim - 1>, dim - 1> jacobian{};

  Residual(unsigned int                                     degree,
           const std::vector<FaceCoordinates<dim, Number>> &nodes,
           const FaceCoordinates<dim, Number>              &y,
           const FaceCoordinates<dim, double>              &xi)
    : value(y)
  {
    const FaceValues<dim, double> shape(degree, xi);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (int i = 0; i < dim - 1; ++i)
        {
          value[i] -= nodes[k][i] * shape.value[k];
          for (int j = 0; j < dim - 1; ++j)
            jacobian[i][j] += value_of(nodes[k][i]) * shape.gradient[k][j];
        }
  }
};

/// Return the numbers without their derivatives.
template <int dim, typename Number>
FaceCoordinates<dim, double> values_of(const FaceCoordinates<dim, Number> &x)
{
  FaceCoordinates<dim, double> result;
  for (int i = 0; i < dim - 1; ++i)
    result[i] = value_of(x[i]);
  return result;
}
} // namespace

template <int dim, typename Number, unsigned int max_degree>
FaceValues<dim, Number, max_degree>::FaceValues(unsigned int                        degree,
                                                const FaceCoordinates<dim, Number> &xi)
  : n_nodes(dim == 2 ? degree + 1 : (degree + 1) * (degree + 1))
{
  std::array<std::array<std::array<Number, 2>, max_degree + 1>, dim - 1> along;
  for (int axis = 0; axis < dim - 1; ++axis)
    for (unsigned int i = 0; i <= degree; ++i)
      along[axis][i] = mesh::lagrange<1>(degree, i, xi[axis]);
  for (unsigned int k = 0; k < n_nodes; ++k)
    {
      const auto i = mesh::node_indices<dim - 1>(degree, k);
      value[k]     = along[0][i[0]][0];
      for (int t = 0; t < dim - 1; ++t)
        gradient[k][t] = along[0][i[0]][t == 0];
      for (int axis = 1; axis < dim - 1; ++axis)
        {
          value[k] = value[k] * along[axis][i[axis]][0];
          for (int t = 0; t < dim - 1; ++t)
            gradient[k][t] = gradient[k][t] * along[axis][i[axis]][t == axis];
        }
    }
}

template <int dim, typename Number>
PlaneFace<dim, Number>::PlaneFace(unsigned int degree, const std::vector<Point> &nodes)
  : degree(degree), points(nodes)
{
  for (const auto &node : nodes)
    values.push_back(values_of<dim>(node));
}

template <int dim, typename Number>
FaceCoordinates<dim, Number> PlaneFace<dim, Number>::coordinates(const Point &y) const
{
  const double       round_off = 1e-14, converged = 1e-10;
  const unsigned int max_iterations = 50;
  const auto         wanted         = values_of<dim>(y);

  FaceCoordinates<dim, double> xi;
  // Start from the centre, because the map of a convex face is nearly linear.
  xi.fill(0.5);
  double move = 1., last_move = 2.;
  for (unsigned int i = 0; i < max_iterations && move > round_off; ++i)
    {
      const Residual<dim, double> at(degree, values, wanted, xi);
      const auto                  step = solve(at.jacobian, at.value);
      last_move                        = move;
      move                             = 0.;
      for (int a = 0; a < dim - 1; ++a)
        {
          xi[a] += step[a];
          move += std::abs(step[a]);
        }
      // Steps that do not shrink are round-off, on faces where round-off is above round_off.
      if (move < converged && move >= last_move)
        break;
    }
  if (!(move < converged))
    throw TangledMesh("a contact face is folded: a point opposite to it "
                      "has no coordinates in it");
  // One step whose values vanish up to round-off gives xi' = J^-1 (y' - sum_k N_k y_k').
  const Residual<dim, Number> at(degree, points, y, xi);
  Point                       result = solve(at.jacobian, at.value);
  for (int a = 0; a < dim - 1; ++a)
    result[a] += xi[a];
  return result;
}

#define SNUG_INSTANTIATE(dim, Number)      \
  template struct FaceValues<dim, Number>; \
  template class PlaneFace<dim, Number>;
template struct FaceValues<2, double, 4>;
template struct FaceValues<3, double, 4>;
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, Differential<1>)
SNUG_INSTANTIATE(2, Recorded)
SNUG_INSTANTIATE(3, double)
SNUG_INSTANTIATE(3, Differential<1>)
SNUG_INSTANTIATE(3, Recorded)
#undef SNUG_INSTANTIATE
} // namespace snug::faces
