#include <snug/base/assertions.h>
#include <snug/elasticity/face_load.h>
#include <snug/faces/face_shape.h>


#include <array>

namespace snug::elasticity {
namespace {
/// Return t_i = dx / d xi_i of the positions (or velocities) of a face's nodes.
template <int dim>
std::array<dealii::Tensor<1, dim>, dim - 1> tangents(const mesh::LagrangePoint<dim - 1> &shape,
                                                     const std::vector<dealii::Tensor<1, dim>> &X)
{
  SNUG_ASSERT_EQUAL(X.size(), shape.value.size());
  std::array<dealii::Tensor<1, dim>, dim - 1> t;
  for (unsigned int a = 0; a < X.size(); ++a)
    for (unsigned int i = 0; i < dim - 1; ++i)
      t[i] += shape.gradient[a][i] * X[a];
  return t;
}

/// Return sum_a N_a x_a.
template <int dim>
dealii::Tensor<1, dim> interpolate(const mesh::LagrangePoint<dim - 1>        &shape,
                                   const std::vector<dealii::Tensor<1, dim>> &x)
{
  SNUG_ASSERT_EQUAL(x.size(), shape.value.size());
  dealii::Tensor<1, dim> sum;
  for (unsigned int a = 0; a < x.size(); ++a)
    sum += shape.value[a] * x[a];
  return sum;
}

/// A Gauss point of a face with nodes X.
template <int dim>
struct FacePoint
{
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  FacePoint(const mesh::LagrangePoint<dim - 1> &shape,
            const mesh::Idealization           &idealization,
            const Nodes                        &X)
    : shape(shape)
    , x(interpolate<dim>(shape, X))
    , t(tangents<dim>(shape, X))
    , m(faces::area_vector(t))
    , weight(shape.weight * idealization.weight(x))
    , weight_gradient(shape.weight * idealization.template weight_gradient<dim>())
  {}

  /// Return dA. In sections the weight, thickness or 2 pi r, turns a length into an area.
  double area() const { return weight * m.norm(); }

  /// Return (n dA)' along V.
  dealii::Tensor<1, dim> vector_derivative(const Nodes &V) const
  {
    return weight * faces::area_vector_derivative(t, tangents<dim>(shape, V)) +
           (weight_gradient * interpolate<dim>(shape, V)) * m;
  }

  /// Return dA' along V.
  double area_derivative(const Nodes &V) const { return vector_derivative(V) * m / m.norm(); }

  /// Compute gradient_a += d/dX_a (c . n dA), with c = kappa n for kappa dA.
  void add_vector_gradient(const dealii::Tensor<1, dim> &c, Nodes &gradient) const
  {
    const auto gradient_t = faces::area_vector_transpose(t, c);
    for (unsigned int a = 0; a < gradient.size(); ++a)
      {
        // In axisymmetric models the weight 2 pi r depends on the nodes too.
        gradient[a] += (c * m) * shape.value[a] * weight_gradient;
        for (unsigned int i = 0; i < dim - 1; ++i)
          gradient[a] += weight * shape.gradient[a][i] * gradient_t[i];
      }
  }

  const mesh::LagrangePoint<dim - 1>         &shape;
  dealii::Tensor<1, dim>                      x;
  std::array<dealii::Tensor<1, dim>, dim - 1> t;
  dealii::Tensor<1, dim>                      m;
  double                 weight; ///< weight of the quadrature and of the section
  dealii::Tensor<1, dim> weight_gradient;
};

/// Return the pressure of a load at Gauss point q.
template <int dim>
double pressure(const FaceLoadValues<dim> &load, unsigned int q)
{
  return load.pressure.empty() ? 0. : load.pressure[q];
}

/// Return the traction of a load. It is zero if the load has none, because its list is empty then.
template <int dim>
dealii::Tensor<1, dim> traction(const FaceLoadValues<dim> &load, unsigned int q)
{
  return load.traction.empty() ? dealii::Tensor<1, dim>() : load.traction[q];
}
} // namespace

template <int dim>
dealii::Tensor<1, dim>
ConcentratedForce<dim>::vector(const std::vector<dealii::Tensor<1, dim>> &X) const
{
  dealii::Tensor<1, dim> vector;
  for (unsigned int a = 0; a < X.size(); ++a)
    vector += (*piece * shape.gradient[a]) * X[a];
  return vector;
}

/// Use degree + 1 Gauss points per direction.
template <int dim>
FaceLoad<dim>::FaceLoad(const unsigned int degree, const mesh::Idealization &idealization)
  : idealization(idealization), gauss(mesh::lagrange_gauss_points<dim - 1>(degree))
{
  SNUG_ASSERT(degree == 1 || degree == 2, "faces have degree 1 or 2");
}

template <int dim>
typename FaceLoad<dim>::Nodes FaceLoad<dim>::quadrature_points(const Nodes &X) const
{
  Nodes points;
  for (const auto &shape : gauss)
    points.push_back(interpolate<dim>(shape, X));
  return points;
}

/// Compute the force. A positive pressure acts into the body: the force is -q n dA with n outwards.
template <int dim>
void FaceLoad<dim>::force(const Nodes &X, const FaceLoadValues<dim> &load, Nodes &f) const
{
  f.assign(X.size(), {});
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const FacePoint<dim> point(gauss[q], idealization, X);
      const auto           force = point.area() * (traction(load, q) + load.linear.value(point.x)) -
                         pressure(load, q) * point.weight * point.m;
      for (unsigned int a = 0; a < X.size(); ++a)
        f[a] += gauss[q].value[a] * force;
    }
  for (const auto &at : load.concentrated)
    for (unsigned int a = 0; a < X.size(); ++a)
      f[a] += at.shape.value[a] * at.total(X);
}

template <int dim>
void FaceLoad<dim>::force_derivative(const Nodes               &X,
                                     const Nodes               &V,
                                     const FaceLoadValues<dim> &load,
                                     const LinearTraction<dim> &linear,
                                     Nodes                     &f) const
{
  f.assign(X.size(), {});
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const FacePoint<dim> point(gauss[q], idealization, X);
      // The derivative is (a + w x (x - c))' with x' = V. The traction moves with the resultant,
      // and its a, w and c change.
      const auto linear_derivative =
        linear.uniform + turned(linear.spin, point.x - load.linear.centre) +
        turned(load.linear.spin, interpolate<dim>(gauss[q], V) - linear.centre);
      const auto force_derivative =
        point.area_derivative(V) * (traction(load, q) + load.linear.value(point.x)) +
        point.area() * linear_derivative - pressure(load, q) * point.vector_derivative(V);
      for (unsigned int a = 0; a < X.size(); ++a)
        f[a] += gauss[q].value[a] * force_derivative;
    }
  for (const auto &at : load.concentrated)
    if (at.piece)
      {
        const auto   vector = at.vector(X);
        const double length = vector * at.vector(V) / vector.norm();
        for (unsigned int a = 0; a < X.size(); ++a)
          f[a] += at.shape.value[a] * length * at.force;
      }
}

/// Compute the gradient without the linear traction of a resultant. That traction depends on the
/// whole loaded face, see add_resultant_gradient().
template <int dim>
void FaceLoad<dim>::add_force_gradient(const Nodes               &X,
                                       const FaceLoadValues<dim> &load,
                                       const Nodes               &u,
                                       const double               factor,
                                       Nodes                     &gradient) const
{
  SNUG_ASSERT_EQUAL(u.size(), X.size());
  SNUG_ASSERT_EQUAL(gradient.size(), X.size());
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const FacePoint<dim> point(gauss[q], idealization, X);
      const auto           displacement = interpolate<dim>(gauss[q], u);
      // Traction acts on |m|, whose derivative is (m/|m|) . m'. Pressure acts on -m itself.
      point.add_vector_gradient(factor *
                                  ((displacement * traction(load, q)) / point.m.norm() * point.m -
                                   pressure(load, q) * displacement),
                                gradient);
    }
  for (const auto &at : load.concentrated)
    if (at.piece)
      {
        const auto   vector = at.vector(X);
        const double work   = factor * (interpolate<dim>(at.shape, u) * at.force) / vector.norm();
        for (unsigned int a = 0; a < X.size(); ++a)
          gradient[a] += work * (*at.piece * at.shape.gradient[a]) * vector;
      }
}

/// Add the share of one face. kappa and k contain the derivatives of A, c and I over the whole
/// face through U and y, so each face adds its share alone.
template <int dim>
void FaceLoad<dim>::add_resultant_gradient(const Nodes              &X,
                                           const ResultantWork<dim> &work,
                                           const Nodes              &u,
                                           const double              factor,
                                           Nodes                    &gradient) const
{
  const auto &w = work.traction.spin;
  const auto &y = work.rotation;
  // Symbols are those of the header: a = F/A and w of the traction, U and y of the work.
  const double yw = y * w;
  // u x w = -(w x u)
  const auto shift = -1. / work.area * turned(w, work.displacement);
  for (const auto &shape : gauss)
    {
      const FacePoint<dim>   point(shape, idealization, X);
      const auto             displacement = interpolate<dim>(shape, u);
      const auto             r            = point.x - work.traction.centre;
      dealii::Tensor<1, dim> in_plane_w, in_plane_y;
      // In the plane w and y have only the out-of-plane component, and no component along r.
      for (unsigned int c = 0; c < dim; ++c)
        {
          in_plane_w[c] = w[c];
          in_plane_y[c] = y[c];
        }
      const double wr = in_plane_w * r, yr = in_plane_y * r;
      const double kappa = displacement * work.traction.value(point.x) -
                           work.traction.uniform * work.displacement / work.area - shift * r -
                           r.norm_square() * yw + yr * wr;
      const auto k =
        -1. * turned(w, displacement) - shift - 2. * yw * r + wr * in_plane_y + yr * in_plane_w;
      point.add_vector_gradient(factor * kappa / point.m.norm() * point.m, gradient);
      for (unsigned int a = 0; a < X.size(); ++a)
        gradient[a] += factor * point.area() * shape.value[a] * k;
    }
}

/// Return the moments of one face. The moments of a boundary are the sum over its faces on all
/// ranks.
template <int dim>
AreaMoments<dim> FaceLoad<dim>::moments(const Nodes &X, const dealii::Tensor<1, dim> &origin) const
{
  AreaMoments<dim> result;
  for (const auto &shape : gauss)
    {
      const FacePoint<dim> point(shape, idealization, X);
      const auto           x = point.x - origin;
      result.area += point.area();
      result.first += point.area() * x;
      // Use a given origin, because the centroid is known only after these sums.
      result.second += point.area() * outer_product(x, x);
    }
  return result;
}

template <int dim>
AreaMoments<dim> FaceLoad<dim>::moment_derivatives(const Nodes                  &X,
                                                   const Nodes                  &V,
                                                   const dealii::Tensor<1, dim> &origin) const
{
  AreaMoments<dim> result;
  for (const auto &shape : gauss)
    {
      const FacePoint<dim> point(shape, idealization, X);
      const auto           x      = point.x - origin;
      const auto           v      = interpolate<dim>(shape, V);
      const double         change = point.area_derivative(V);
      result.area += change;
      result.first += change * x + point.area() * v;
      result.second +=
        change * outer_product(x, x) + point.area() * (outer_product(v, x) + outer_product(x, v));
    }
  return result;
}

/// Return the moments that give the work of a linear traction: int t . u dA = a . force
/// + w . moment.
template <int dim>
Resultant<dim> FaceLoad<dim>::displacement_moments(const Nodes                  &X,
                                                   const Nodes                  &u,
                                                   const dealii::Tensor<1, dim> &centre) const
{
  Resultant<dim> result;
  for (const auto &shape : gauss)
    {
      const FacePoint<dim> point(shape, idealization, X);
      const auto           displacement = point.area() * interpolate<dim>(shape, u);
      result.force += displacement;
      result.moment += moment_of(point.x - centre, displacement);
    }
  return result;
}

template <int dim>
std::vector<double> FaceLoad<dim>::areas(const Nodes &X) const
{
  std::vector<double> areas(X.size());
  for (const auto &shape : gauss)
    {
      const double dA = FacePoint<dim>(shape, idealization, X).area();
      for (unsigned int a = 0; a < X.size(); ++a)
        areas[a] += shape.value[a] * dA;
    }
  return areas;
}

template struct ConcentratedForce<2>;
template struct ConcentratedForce<3>;
template class FaceLoad<2>;
template class FaceLoad<3>;
} // namespace snug::elasticity
