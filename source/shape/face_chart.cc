#include <snug/base/errors.h>
#include <snug/shape/face_chart.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::shape {
namespace {
/// Cosine of the angle between two chords of the border at which a loop has a corner: 25 degrees.
const double corner_cosine = 0.906;

/// A point may lie outside of all faces of the mesh by this part of a face, because neighbouring
/// faces interpolate the coordinates of their common edge separately.
const double most_outside = 1e-6;

/// Return coordinates without the last component of the vectors of FacePlaces, which is zero.
dealii::Tensor<1, 2> flat(const dealii::Tensor<1, 3> &x)
{
  dealii::Tensor<1, 2> result;
  result[0] = x[0];
  result[1] = x[1];
  return result;
}

double cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// Return the local indices of the points along the side @p side of a face of degree @p p,
/// counterclockwise in xi. The sides are xi_2 = 0, xi_1 = 1, xi_2 = 1, xi_1 = 0.
std::vector<unsigned int> side_points(const unsigned int p, const unsigned int side)
{
  std::vector<unsigned int> result;
  for (unsigned int k = 0; k <= p; ++k)
    result.push_back(side == 0   ? k
                     : side == 1 ? p + k * (p + 1)
                     : side == 2 ? p * (p + 1) + p - k
                                 : (p - k) * (p + 1));
  return result;
}

/// Return the signed area within a loop.
template <typename Loop>
double area_of(const Loop &loop)
{
  double area = 0.;
  for (const auto &piece : loop)
    for (unsigned int k = 0; k + 1 < piece.size(); ++k)
      area += 0.5 * cross(piece[k], piece[k + 1]);
  return area;
}

/// Return the loop cut at its corners. @p points is closed: the first point is repeated at the end.
std::vector<std::vector<dealii::Tensor<1, 2>>>
smooth_pieces(const std::vector<dealii::Tensor<1, 2>> &points)
{
  const unsigned int        n = points.size() - 1;
  std::vector<unsigned int> corners;
  for (unsigned int k = 0; k < n; ++k)
    {
      const auto before = points[k] - points[(k + n - 1) % n], after = points[k + 1] - points[k];
      if (before * after < corner_cosine * before.norm() * after.norm())
        corners.push_back(k);
    }
  if (corners.empty())
    return {points};
  std::vector<std::vector<dealii::Tensor<1, 2>>> pieces;
  for (unsigned int c = 0; c < corners.size(); ++c)
    {
      const unsigned int last = c + 1 < corners.size() ? corners[c + 1] : corners[0] + n;
      pieces.emplace_back();
      for (unsigned int k = corners[c]; k <= last; ++k)
        pieces.back().push_back(points[k % n]);
    }
  return pieces;
}
} // namespace

template <int dim>
FaceChart<dim>::FaceChart(const ShapedFace<dim> &face, const FaceCoordinates<dim> &coordinates)
  : face(face), places(face, coordinates.as_lengths(), coordinates.periods())
{
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      ranges[a] = coordinates.axis(a).range * coordinates.axis(a).unit;
      closed[a] = coordinates.axis(a).closed;
    }
  for (const auto &patch : places.patches())
    if constexpr (dim == 3)
      for (unsigned int side = 0; side < 4; ++side)
        {
          const auto points = side_points(patch.middle.degree, side);
          for (unsigned int k = 0; k < patch.middle.degree; ++k)
            area += 0.5 * cross(flat(patch.values[points[k]] - patch.values[0]),
                                flat(patch.values[points[k + 1]] - patch.values[0]));
        }
    else
      area += patch.values.back()[0] - patch.values.front()[0];
}

template <int dim>
std::optional<typename FaceChart<dim>::Place> FaceChart<dim>::find(const Flat &target) const
{
  dealii::Tensor<1, dim> at;
  for (unsigned int a = 0; a < dim - 1; ++a)
    at[a] = target[a];
  return places.closest(at, most_outside);
}

template <int dim>
bool FaceChart<dim>::fills_rectangle() const
{
  double             whole    = 1.;
  const unsigned int n_closed = std::count(closed.begin(), closed.end(), true);
  for (unsigned int a = 0; a < dim - 1; ++a)
    whole *= ranges[a];
  if (std::abs(std::abs(area) - whole) > 1e-3 * whole)
    return false;
  return dim == 2 || loops().size() == (n_closed == dim - 1 ? 0 : 1 + n_closed);
}

/// Return the edges at the border: first node -> last node and the points from one to the other.
/// Edges of the border belong to one face of the mesh, and other boundaries share their nodes. The
/// second condition excludes edges with hanging nodes.
template <int dim>
typename FaceChart<dim>::Edges FaceChart<dim>::border_edges() const
{
  using Ends = std::pair<unsigned int, unsigned int>; // nodes
  std::map<Ends, unsigned int> uses;
  const auto                   ends_of = [&](const unsigned int f, const unsigned int side) {
    const auto &nodes  = face.surface().faces()[f].nodes;
    const auto  points = side_points(face.mesh().degree(), side);
    return Ends(nodes[points.front()], nodes[points.back()]);
  };
  for (unsigned int f = 0; f < places.patches().size(); ++f)
    for (unsigned int side = 0; side < 4; ++side)
      {
        const Ends ends = ends_of(f, side);
        ++uses[std::minmax(ends.first, ends.second)];
      }
  Edges result;
  for (unsigned int f = 0; f < places.patches().size(); ++f)
    for (unsigned int side = 0; side < 4; ++side)
      {
        const Ends ends = ends_of(f, side);
        if (uses[std::minmax(ends.first, ends.second)] > 1 || !face.border()[ends.first] ||
            !face.border()[ends.second])
          continue;
        Piece piece;
        if constexpr (dim == 3)
          for (const unsigned int k : side_points(places.patches()[f].middle.degree, side))
            piece.push_back(flat(places.patches()[f].values[k]));
        result[ends.first] = {ends.second, piece};
      }
  return result;
}

template <int dim>
std::vector<typename FaceChart<dim>::Loop> FaceChart<dim>::loops() const
{
  std::vector<Loop> result;
  if constexpr (dim == 3)
    {
      auto next = border_edges();
      while (!next.empty())
        {
          const unsigned int first = next.begin()->first;
          Piece              points;
          for (unsigned int node = first; points.empty() || node != first;)
            {
              const auto found = next.find(node);
              if (found == next.end())
                throw InputError(
                  "the edges of the mesh along the border of the face do not form closed loops");
              const auto &piece = found->second.second;
              points.insert(points.end(), piece.begin(), piece.end() - 1);
              node = found->second.first;
              next.erase(found);
            }
          points.push_back(points.front());
          result.push_back(smooth_pieces(points));
        }
      std::sort(result.begin(), result.end(), [](const Loop &a, const Loop &b) {
        return std::abs(area_of(a)) > std::abs(area_of(b));
      });
      for (unsigned int l = 0; l < result.size(); ++l)
        if ((area_of(result[l]) > 0.) != (l == 0))
          {
            std::reverse(result[l].begin(), result[l].end());
            for (auto &piece : result[l])
              std::reverse(piece.begin(), piece.end());
          }
    }
  return result;
}

template class FaceChart<2>;
template class FaceChart<3>;
} // namespace snug::shape
