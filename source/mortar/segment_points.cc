#include <snug/mortar/clip.h>
#include <snug/mortar/segment_points.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <type_traits>

namespace snug::mortar {
namespace {
template <int dim, typename Number>
using Vectors = std::array<std::array<Number, dim>, dim - 1>;

/// Return the tangents x,_1 (and x,_2) of a face.
template <int dim, typename Number, typename ShapeNumber>
Vectors<dim, Number> tangents(const faces::FaceValues<dim, ShapeNumber> &shape,
                              const FaceNodes<dim, Number>              &nodes)
{
  Vectors<dim, Number> t{};
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (int a = 0; a < dim - 1; ++a)
      for (int i = 0; i < dim; ++i)
        t[a][i] += nodes[k][i] * shape.gradient[k][a];
  return t;
}

template <typename Number>
Number area(const Vectors<2, Number> &t)
{
  using std::sqrt;
  return sqrt(faces::dot(t[0], t[0]));
}

template <typename Number>
Number area(const Vectors<3, Number> &t)
{
  using std::sqrt;
  const Number mixed = faces::dot(t[0], t[1]);
  return sqrt(faces::dot(t[0], t[0]) * faces::dot(t[1], t[1]) - mixed * mixed);
}

/// Return sum_k values_k points_k.
template <typename Values, typename Points>
auto combined(const Values &values, const Points &points)
{
  std::decay_t<decltype(points[0])> sum{};
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += points[k][i] * values[k];
  return sum;
}

/// Return Idealization::weight(), which is linear, at @p x.
template <typename Number, std::size_t dim>
Number section_weight(const mesh::Idealization &idealization, const std::array<Number, dim> &x)
{
  dealii::Tensor<1, dim> at;
  for (std::size_t i = 0; i < dim; ++i)
    at[i] = faces::value_of(x[i]);
  const auto slope  = idealization.weight_gradient<dim>();
  Number     weight = idealization.weight(at);
  for (std::size_t i = 0; i < dim; ++i)
    weight += slope[i] * (x[i] - at[i]);
  return weight;
}

template <typename Number>
std::array<Number, 3> cross(const std::array<Number, 3> &a, const std::array<Number, 3> &b)
{
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// Coordinates in the plane of a slave face, with the centre at 0 and size 1.
template <int dim, typename Number>
class FacePlane
{
public:
  // t.(x - c) alone would depend on units and on the angle of the tangents. With the factor
  // (t.t)^-1 the face has size 1 for any shape, and tolerances are fractions of the face.
  FacePlane(unsigned int degree, const MortarFace<dim, Number> &face)
  {
    faces::FaceCoordinates<dim, double> middle;
    middle.fill(0.5);
    const faces::FaceValues<dim, double> shape(degree, middle);
    centre       = combined(shape.value, face.nodes);
    const auto t = tangents<dim>(shape, face.nodes);
    if (face.direction)
      set_dual(t, *face.direction);
    else
      set_dual(t);
  }

  faces::FaceCoordinates<dim, Number> project(const std::array<Number, dim> &x) const
  {
    std::array<Number, dim> offset = x;
    for (int i = 0; i < dim; ++i)
      offset[i] -= centre[i];
    faces::FaceCoordinates<dim, Number> y;
    for (int a = 0; a < dim - 1; ++a)
      y[a] = faces::dot(dual[a], offset);
    return y;
  }

private:
  std::array<Number, dim> centre;
  Vectors<dim, Number>    dual; ///< (t.t)^-1 t, or the rows for t and 0 of the inverse of (t, n_0)

  void set_dual(const Vectors<2, Number> &t)
  {
    const Number square = faces::dot(t[0], t[0]);
    for (int i = 0; i < 2; ++i)
      dual[0][i] = t[0][i] / square;
  }

  void set_dual(const Vectors<3, Number> &t)
  {
    const Number g00 = faces::dot(t[0], t[0]), g01 = faces::dot(t[0], t[1]),
                 g11 = faces::dot(t[1], t[1]), det = g00 * g11 - g01 * g01;
    for (int i = 0; i < 3; ++i)
      {
        dual[0][i] = (g11 * t[0][i] - g01 * t[1][i]) / det;
        dual[1][i] = (g00 * t[1][i] - g01 * t[0][i]) / det;
      }
  }

  void set_dual(const Vectors<2, Number> &t, const std::array<Number, 2> &n)
  {
    const Number det = t[0][0] * n[1] - t[0][1] * n[0];
    dual[0]          = {{n[1] / det, -n[0] / det}};
  }

  void set_dual(const Vectors<3, Number> &t, const std::array<Number, 3> &n)
  {
    const auto   by_t0 = cross(t[1], n), by_t1 = cross(n, t[0]);
    const Number det = faces::dot(t[0], by_t0);
    for (int i = 0; i < 3; ++i)
      {
        dual[0][i] = by_t0[i] / det;
        dual[1][i] = by_t1[i] / det;
      }
  }
};

/// Return a face projected along the direction of @p plane.
template <int dim, typename Number>
faces::PlaneFace<dim, Number> projected(unsigned int                  degree,
                                        const FacePlane<dim, Number> &plane,
                                        const FaceNodes<dim, Number> &face)
{
  std::vector<faces::FaceCoordinates<dim, Number>> nodes;
  for (const auto &node : face)
    nodes.push_back(plane.project(node));
  return {degree, nodes};
}

/// Return the cells between neighbouring nodes with positive orientation; other cells are left out.
/// A quadratic face has curved edges in the plane. The convex cells between its nodes replace the
/// face in the intersection only. A master faces the other way, so its cells are @p reversed.
template <int dim, typename Number>
std::vector<ConvexCell<dim - 1, Number>>
cells(unsigned int degree, const faces::PlaneFace<dim, Number> &face, bool reversed)
{
  std::vector<ConvexCell<dim - 1, Number>> result;
  const unsigned int                       n_rows = dim == 2 ? 1 : degree;
  for (unsigned int row = 0; row < n_rows; ++row)
    for (unsigned int i = 0; i < degree; ++i)
      {
        const unsigned int          first = row * (degree + 1) + i;
        ConvexCell<dim - 1, Number> cell  = {face.nodes()[first], face.nodes()[first + 1]};
        if (dim == 3)
          {
            cell.push_back(face.nodes()[first + degree + 2]);
            cell.push_back(face.nodes()[first + degree + 1]);
          }
        if (reversed)
          std::reverse(cell.begin(), cell.end());
        if (signed_measure<dim - 1>(cell) > 0.)
          result.push_back(cell);
      }
  return result;
}

/// Return twice (2D) or once (1D) the signed size of a simplex.
template <typename Number>
Number determinant(const std::array<std::array<Number, 1>, 2> &simplex)
{
  return simplex[1][0] - simplex[0][0];
}

template <typename Number>
Number determinant(const std::array<std::array<Number, 2>, 3> &simplex)
{
  return (simplex[1][0] - simplex[0][0]) * (simplex[2][1] - simplex[0][1]) -
         (simplex[1][1] - simplex[0][1]) * (simplex[2][0] - simplex[0][0]);
}
} // namespace

template <int dim>
SegmentQuadrature<dim>::SegmentQuadrature(unsigned int              degree,
                                          const mesh::Idealization &idealization)
  : degree(degree), idealization(idealization)
{
  // Use Gauss points of a square, one side of which shrinks to a corner. With n points per
  // direction they are exact for polynomials of degree 2 n - 2.
  const dealii::QGauss<dim - 1> gauss(degree + 2);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      Point        point;
      const double x       = gauss.point(q)[0];
      const double y       = dim == 3 ? gauss.point(q)[dim - 2] : 0.;
      point.barycentric[0] = (1. - x) * (dim == 3 ? 1. - y : 1.);
      point.barycentric[1] = x * (dim == 3 ? 1. - y : 1.);
      if (dim == 3)
        point.barycentric[dim - 1] = y;
      point.weight = gauss.weight(q) * (dim == 3 ? 1. - y : 1.);
      rule.push_back(point);
    }
}

template <int dim>
template <typename Number>
void SegmentQuadrature<dim>::for_each_point(
  const MortarFace<dim, Number>                                                 &slave,
  const MortarFace<dim, Number>                                                 &master,
  const std::function<void(const std::function<SegmentPoint<dim, Number>()> &)> &visit) const
{
  const FacePlane<dim, Number> plane(degree, slave);
  const auto                   on_slave     = projected<dim>(degree, plane, slave.nodes);
  const auto                   on_master    = projected<dim>(degree, plane, master.nodes);
  const auto                   master_cells = cells<dim>(degree, on_master, true);
  for (const auto &slave_cell : cells<dim>(degree, on_slave, false))
    for (const auto &master_cell : master_cells)
      {
        // Clip in the plane and integrate on the slave face, because the pieces must cover the
        // slave face without a gap.
        auto piece = intersection<dim - 1>(slave_cell, master_cell);
        for (auto &vertex : piece)
          vertex = on_slave.coordinates(vertex);
        for (const auto &corners : simplices<dim - 1>(piece.size()))
          {
            std::array<faces::FaceCoordinates<dim, Number>, dim> simplex;
            for (int v = 0; v < dim; ++v)
              simplex[v] = piece[corners[v]];
            const Number size = determinant(simplex);
            for (const Point &q : rule)
              visit([&]() {
                const faces::FaceCoordinates<dim, Number> xi = combined(q.barycentric, simplex);
                SegmentPoint<dim, Number>                 point{0., xi, {}, {degree, xi}};
                const auto                               &shape = point.slave_shape;
                point.weight = size * area(tangents<dim>(shape, slave.nodes)) *
                               section_weight(idealization, combined(shape.value, slave.nodes)) *
                               q.weight;
                // Project along n_0 and not to the closest point: n_0 is the same for all points of
                // a slave face.
                point.master = on_master.coordinates(combined(shape.value, on_slave.nodes()));
                return point;
              });
          }
      }
}

template <int dim>
void SegmentQuadrature<dim>::add_cover(const MortarFace<dim, double> &slave,
                                       const MortarFace<dim, double> &master,
                                       CoverBox<dim>                 &box) const
{
  const FacePlane<dim, double> plane(degree, slave);
  const auto                   on_slave = projected<dim>(degree, plane, slave.nodes);
  const auto master_cells = cells<dim>(degree, projected<dim>(degree, plane, master.nodes), true);
  for (const auto &slave_cell : cells<dim>(degree, on_slave, false))
    for (const auto &master_cell : master_cells)
      for (const auto &vertex : intersection<dim - 1>(slave_cell, master_cell))
        {
          const auto xi = on_slave.coordinates(vertex);
          for (int a = 0; a < dim - 1; ++a)
            {
              box.lower[a] = std::min(box.lower[a], xi[a]);
              box.upper[a] = std::max(box.upper[a], xi[a]);
            }
        }
}

template <int dim>
bool SegmentQuadrature<dim>::overlap(const MortarFace<dim, double> &slave,
                                     const MortarFace<dim, double> &master,
                                     double                         margin) const
{
  const FacePlane<dim, double> plane(degree, slave);
  auto                         nodes = projected<dim>(degree, plane, slave.nodes).nodes();
  for (auto &node : nodes)
    for (double &coordinate : node)
      // Scale about the origin of the plane, which is the centre of the face.
      coordinate *= 1. + 2. * margin;
  const auto master_cells = cells<dim>(degree, projected<dim>(degree, plane, master.nodes), true);
  for (const auto &slave_cell :
       cells<dim>(degree, faces::PlaneFace<dim, double>(degree, nodes), false))
    for (const auto &master_cell : master_cells)
      if (!intersection<dim - 1>(slave_cell, master_cell).empty())
        return true;
  return false;
}

template class SegmentQuadrature<2>;
template class SegmentQuadrature<3>;
#define SNUG_INSTANTIATE(dim, Number)                                                       \
  template void SegmentQuadrature<dim>::for_each_point(                                     \
    const MortarFace<dim, Number> &, const MortarFace<dim, Number> &,                       \
    const std::function<void(const std::function<SegmentPoint<dim, Number>()> &)> &) const; \
  template faces::FaceValues<dim, Number> SegmentQuadrature<dim>::shape(                    \
    const faces::FaceCoordinates<dim, Number> &) const;
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, faces::Differential<1>)
SNUG_INSTANTIATE(2, faces::Recorded)
SNUG_INSTANTIATE(3, double)
SNUG_INSTANTIATE(3, faces::Differential<1>)
SNUG_INSTANTIATE(3, faces::Recorded)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
