#include <snug/geometry/entry_values.h>
#include <snug/geometry/fitted_surface.h>

#include <deal.II/grid/manifold_lib.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

namespace snug::geometry {
namespace {
/// Axis of "cylinder AXIS", dim of a sphere.
/// dim is no axis, so that offset() drops no component.
template <int dim>
unsigned int read_axis(const std::string &boundary, const std::string &value)
{
  const auto word = words(value);
  if (word.size() == 1 && word[0] == "sphere")
    return dim;
  const unsigned int axis = word.size() == 2 && word[0] == "cylinder" ? axis_called(word[1]) : 3;
  if (axis == 3 || (dim == 2 && axis != 2))
    throw bad_entry("Curved faces", boundary + ": " + value,
                    std::string("of a mesh file must be 'sphere' or 'cylinder ") +
                      (dim == 2 ? "z'" : "AXIS'"));
  return axis;
}
} // namespace

template <int dim>
FittedSurface<dim>::FittedSurface(const std::string                     &boundary,
                                  const std::string                     &value,
                                  const std::vector<dealii::Point<dim>> &points)
  : straight_axis(read_axis<dim>(boundary, value))
{
  fit(points);
  double largest = 0.;
  for (const auto &point : points)
    largest = std::max(largest, std::abs(offset(point).norm() - radius));
  // 1e-4: files with 5 or 6 digits pass, nodes on chords or of another face do not. A radius of
  // 1000 distances is a plane up to that: there is no sphere to be found.
  const double allowed = 1e-4, flat = 1e3;
  const double length = points.front().distance(points.back());
  if (!(largest <= allowed * radius && radius < flat * length))
    {
      std::ostringstream text;
      text << "does not fit: nodes of '" << boundary << "' are up to " << largest
           << " off the best one, of radius " << radius;
      throw bad_entry("Curved faces", boundary + ": " + value, text.str());
    }
}

template <int dim>
dealii::Tensor<1, dim> FittedSurface<dim>::offset(const dealii::Point<dim> &point) const
{
  dealii::Tensor<1, dim> result = point - centre;
  if (straight_axis < dim)
    result[straight_axis] = 0.;
  return result;
}

template <int dim>
void FittedSurface<dim>::fit(const std::vector<dealii::Point<dim>> &points)
{
  // Coordinates from the mean in units of the size: the normal equations, of squares of them,
  // stay well conditioned for small surfaces far from the origin.
  dealii::Point<dim> mean;
  for (const auto &point : points)
    mean += point / double(points.size());
  centre      = mean;
  double size = 0.;
  for (const auto &point : points)
    size = std::max(size, offset(point).norm());
  // unknowns: the centre and R^2 - |c|^2; along the straight axis the matrix is empty
  dealii::FullMatrix<double> A(dim + 1, dim + 1);
  dealii::Vector<double>     b(dim + 1), x(dim + 1);
  for (const auto &point : points)
    {
      const dealii::Tensor<1, dim> y = offset(point) / size;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const double left = i < dim ? 2. * y[i] : 1.;
          for (unsigned int j = 0; j <= dim; ++j)
            A(i, j) += left * (j < dim ? 2. * y[j] : 1.);
          b(i) += left * y.norm_square();
        }
    }
  if (straight_axis < dim)
    A(straight_axis, straight_axis) = 1.;
  // Flat boundaries give a singular matrix; the shift makes that a huge radius, which is
  // rejected above.
  for (unsigned int i = 0; i <= dim; ++i)
    A(i, i) *= 1. + 1e-14;
  // A x = b: the normal equations of 2 c.y + (R^2 - |c|^2) = |y|^2 over all points
  A.gauss_jordan();
  A.vmult(x, b);
  // R^2 = (R^2 - |c|^2) + |c|^2
  double square = x(dim);
  for (unsigned int d = 0; d < dim; ++d)
    {
      centre[d] += size * x(d);
      square += x(d) * x(d);
    }
  radius = size * std::sqrt(square);
}

template <int dim>
dealii::Point<dim> FittedSurface<dim>::project(const dealii::Point<dim> &point) const
{
  const auto from = offset(point);
  // the component along the axis of a cylinder stays
  return point + (radius / from.norm() - 1.) * from;
}

/// Circles about the centre, also for "cylinder z".
template <>
BlockMesh<2>::Surface FittedSurface<2>::manifold() const
{
  return std::make_shared<dealii::SphericalManifold<2>>(centre);
}

template <>
BlockMesh<3>::Surface FittedSurface<3>::manifold() const
{
  if (straight_axis == 3)
    return std::make_shared<dealii::SphericalManifold<3>>(centre);
  // the manifold takes a point of the axis and its direction
  dealii::Tensor<1, 3> direction;
  direction[straight_axis] = 1.;
  return std::make_shared<dealii::CylindricalManifold<3>>(direction, centre);
}

template class FittedSurface<2>;
template class FittedSurface<3>;
} // namespace snug::geometry
