#include <snug/mesh/lagrange.h>
#include <snug/shape/profile.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace snug::shape {
namespace {
using Vector = dealii::Tensor<1, 3>;

/// Maximum of the root mean square of the sine of the angle by which normals deviate from those of
/// a surface of revolution or extrusion. The normals at the ends of a face lean by half of the
/// angle of a facet.
const double largest_deviation = 0.1;

} // namespace

Vector reference_direction(const Vector &axis)
{
  Vector result;
  result[std::abs(axis[0]) > std::sqrt(0.5) ? 1 : 0] = 1.;
  result -= (result * axis) * axis;
  return result / result.norm();
}

template <int dim>
FacePoints face_points(const ShapedFace<dim> &face)
{
  FacePoints result;
  result.areas = face.areas();
  for (unsigned int point = 0; point < face.positions().size(); ++point)
    {
      Vector x, n;
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[d] = face.positions()[point][d];
          n[d] = face.free_normals()[point][d];
        }
      result.positions.push_back(x);
      result.normals.push_back(n);
    }
  const auto add_grid = [&result](const std::vector<unsigned int> &points, const unsigned int p) {
    for (unsigned int k = 0; k < points.size(); ++k)
      {
        if (k % (p + 1) < p)
          result.edges.emplace_back(points[k], points[k + 1]);
        if (dim == 3 && k / (p + 1) < p)
          result.edges.emplace_back(points[k], points[k + p + 1]);
      }
  };
  for (const auto &one : face.surface().faces())
    {
      add_grid(one.nodes, face.mesh().degree());
      add_grid(one.samples, mesh::surface_degree);
      // Faces share nodes but no samples. Samples are linked at all corners, because angles lack at
      // corners on the axis.
      const unsigned int p = face.mesh().degree(), q = mesh::surface_degree;
      for (unsigned int corner = 0; corner < (one.samples.empty() ? 0 : 1u << (dim - 1)); ++corner)
        result.edges.emplace_back(one.nodes[p * (corner % 2 + (p + 1) * (corner / 2))],
                                  one.samples[q * (corner % 2 + (q + 1) * (corner / 2))]);
    }
  return result;
}

std::optional<Axis>
revolution_axis(const FacePoints &face, const Vector &direction, const std::optional<Vector> &point)
{
  // In the plane at right angles to the axis, the lines along the normals meet at the centre: with
  // w at right angles to the normal, sum A w w' c = sum A w (w . x).
  const Vector e1 = reference_direction(direction), e2 = cross_product_3d(direction, e1);
  double       M[2][2] = {{0., 0.}, {0., 0.}}, b[2] = {0., 0.}, area = 0.;
  for (unsigned int i = 0; i < face.positions.size(); ++i)
    {
      const auto  &x = face.positions[i], &n = face.normals[i];
      const double w[2] = {-(n * e2), n * e1};
      area += face.areas[i];
      for (unsigned int r = 0; r < 2; ++r)
        {
          b[r] += face.areas[i] * w[r] * (w[0] * (x * e1) + w[1] * (x * e2));
          for (unsigned int c = 0; c < 2; ++c)
            M[r][c] += face.areas[i] * w[r] * w[c];
        }
    }
  Axis         result{point.value_or(Vector()), direction};
  const double trace = M[0][0] + M[1][1], det = M[0][0] * M[1][1] - M[0][1] * M[1][0];
  if (!point)
    {
      if (trace < 1e-6 * area || det < 1e-6 * trace * trace)
        return {};
      result.point =
        ((M[1][1] * b[0] - M[0][1] * b[1]) * e1 + (M[0][0] * b[1] - M[1][0] * b[0]) * e2) / det;
    }
  double sum = 0.;
  for (unsigned int i = 0; i < face.positions.size(); ++i)
    {
      const Vector along = cross_product_3d(direction, face.positions[i] - result.point);
      if (along.norm() > 0.)
        sum += face.areas[i] * std::pow(face.normals[i] * along / along.norm(), 2);
    }
  if (sum > largest_deviation * largest_deviation * area)
    return {};
  return result;
}

bool is_extrusion(const FacePoints &face, const Vector &direction)
{
  double sum = 0., area = 0.;
  for (unsigned int i = 0; i < face.positions.size(); ++i)
    {
      sum += face.areas[i] * std::pow(face.normals[i] * direction, 2);
      area += face.areas[i];
    }
  return sum <= largest_deviation * largest_deviation * area;
}

std::optional<Vector> extrusion_direction(const FacePoints &face)
{
  dealii::SymmetricTensor<2, 3> M;
  for (unsigned int i = 0; i < face.positions.size(); ++i)
    M += face.areas[i] * symmetrize(outer_product(face.normals[i], face.normals[i]));
  // The eigenvalues descend.
  const auto pairs  = eigenvectors(M, dealii::SymmetricTensorEigenvectorMethod::jacobi);
  Vector     result = pairs[2].second;
  if (pairs[1].first < 1e-9 * trace(M))
    {
      const Vector &normal = pairs[0].second;
      unsigned int  across = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(normal[d]) > std::abs(normal[across]) - 1e-9)
          across = d;
      result                      = 0.;
      result[across == 2 ? 1 : 2] = 1.;
      result -= (result * normal) * normal;
      result /= result.norm();
    }
  unsigned int longest = 0;
  for (unsigned int d = 1; d < 3; ++d)
    if (std::abs(result[d]) > std::abs(result[longest]) + 1e-9)
      longest = d;
  if (result[longest] < 0.)
    result *= -1.;
  return is_extrusion(face, result) ? std::optional<Vector>(result) : std::nullopt;
}

template FacePoints face_points(const ShapedFace<2> &);
template FacePoints face_points(const ShapedFace<3> &);
} // namespace snug::shape
