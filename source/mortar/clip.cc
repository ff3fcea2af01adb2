#include <snug/mortar/clip.h>

namespace snug::mortar {
namespace {
/// Points that are nearer to a clipping line than this, relative to a slave face of size 1, count
/// as points on the line. Otherwise round-off would make slivers where edges of the two sides
/// coincide.
const double on_boundary = 1e-11;

/// Return (b - a) x (c - a).
template <typename Number>
Number cross(const std::array<Number, 2> &a,
             const std::array<Number, 2> &b,
             const std::array<Number, 2> &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Return a point without its derivatives, because decisions are made by values, never by slopes.
template <std::size_t d, typename Number>
std::array<double, d> values(const std::array<Number, d> &point)
{
  std::array<double, d> result;
  for (std::size_t i = 0; i < d; ++i)
    result[i] = faces::value_of(point[i]);
  return result;
}

/// Take each end from the cell that bounds the overlap, with the derivatives of that cell. Where
/// both ends coincide, take the end of the subject, because it follows the slave face, as the
/// quadrature does.
template <typename Number>
ConvexCell<1, Number> intersect(const ConvexCell<1, Number> &subject,
                                const ConvexCell<1, Number> &clip)
{
  ConvexCell<1, Number> result = subject;
  if (faces::value_of(clip[0][0]) > faces::value_of(subject[0][0]) + on_boundary)
    result[0] = clip[0];
  if (faces::value_of(clip[1][0]) < faces::value_of(subject[1][0]) - on_boundary)
    result[1] = clip[1];
  if (signed_measure<1>(result) <= on_boundary)
    result.clear();
  return result;
}

/// Return the part of @p cell to the left of the line from @p a to @p b.
template <typename Number>
ConvexCell<2, Number> left_part(const ConvexCell<2, Number> &cell,
                                const std::array<Number, 2> &a,
                                const std::array<Number, 2> &b)
{
  const double        edge = std::hypot(faces::value_of(b[0]) - faces::value_of(a[0]),
                                        faces::value_of(b[1]) - faces::value_of(a[1]));
  std::vector<double> height;
  for (const auto &vertex : cell)
    height.push_back(cross(values<2>(a), values<2>(b), values<2>(vertex)) / edge);
  ConvexCell<2, Number> result;
  for (unsigned int i = 0; i < cell.size(); ++i)
    {
      const unsigned int j = (i + 1) % cell.size();
      if (height[i] >= -on_boundary)
        result.push_back(cell[i]);
      if ((height[i] > on_boundary && height[j] < -on_boundary) ||
          (height[i] < -on_boundary && height[j] > on_boundary))
        {
          const Number h_i = cross(a, b, cell[i]);
          const Number h_j = cross(a, b, cell[j]);
          const Number t   = h_i / (h_i - h_j);
          result.push_back({{cell[i][0] + t * (cell[j][0] - cell[i][0]),
                             cell[i][1] + t * (cell[j][1] - cell[i][1])}});
        }
    }
  return result;
}

/// Clip by one edge after the other (Sutherland and Hodgman, Commun. ACM 17, 1974).
template <typename Number>
ConvexCell<2, Number> intersect(const ConvexCell<2, Number> &subject,
                                const ConvexCell<2, Number> &clip)
{
  ConvexCell<2, Number> result = subject;
  for (unsigned int i = 0; i < clip.size() && result.size() > 2; ++i)
    result = left_part(result, clip[i], clip[(i + 1) % clip.size()]);
  if (result.size() < 3 || signed_measure<2>(result) <= on_boundary)
    result.clear();
  return result;
}
} // namespace

template <std::size_t d, typename Number>
ConvexCell<d, Number> intersection(const ConvexCell<d, Number> &subject,
                                   const ConvexCell<d, Number> &clip)
{
  return intersect(subject, clip);
}

template <std::size_t d, typename Number>
double signed_measure(const ConvexCell<d, Number> &cell)
{
  double measure = 0.;
  if (d == 1)
    return faces::value_of(cell[1][0]) - faces::value_of(cell[0][0]);
  for (unsigned int i = 2; i < cell.size(); ++i)
    {
      const auto a = values<d>(cell[0]), b = values<d>(cell[i - 1]), c = values<d>(cell[i]);
      measure +=
        ((b[0] - a[0]) * (c[d - 1] - a[d - 1]) - (b[d - 1] - a[d - 1]) * (c[0] - a[0])) / 2;
    }
  return measure;
}

// Build a fan about vertex 0. The zero-initialized arrays already contain the index of vertex 0.
template <std::size_t d>
std::vector<std::array<unsigned int, d + 1>> simplices(unsigned int n_vertices)
{
  std::vector<std::array<unsigned int, d + 1>> result;
  for (unsigned int last = d; last < n_vertices; ++last)
    {
      std::array<unsigned int, d + 1> simplex{};
      simplex[d - 1] = last - 1;
      simplex[d]     = last;
      result.push_back(simplex);
    }
  return result;
}

#define SNUG_INSTANTIATE(d, Number)                                           \
  template ConvexCell<d, Number> intersection(const ConvexCell<d, Number> &,  \
                                              const ConvexCell<d, Number> &); \
  template double                signed_measure(const ConvexCell<d, Number> &);
SNUG_INSTANTIATE(1, double)
SNUG_INSTANTIATE(1, faces::Differential<1>)
SNUG_INSTANTIATE(1, faces::Recorded)
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, faces::Differential<1>)
SNUG_INSTANTIATE(2, faces::Recorded)
#undef SNUG_INSTANTIATE
template std::vector<std::array<unsigned int, 2>> simplices<1>(unsigned int);
template std::vector<std::array<unsigned int, 3>> simplices<2>(unsigned int);
} // namespace snug::mortar
