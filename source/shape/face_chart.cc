#include <snug/base/errors.h>
#include <snug/shape/face_chart.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::shape {
namespace {
/// Cosine of the angle between two chords of the border at which a loop has a corner: 25 degrees.
const double corner_cosine = 0.906;

/// A point may lie outside of all faces of the mesh by this part of an edge, because neighbouring
/// faces interpolate the coordinates of their common edge separately.
const double most_outside = 0.01;

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
FaceChart<dim>::FaceChart(const ShapedFace<dim> &face, const std::vector<FaceCoordinate> &axes)
  : face(face)
{
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      ranges[a] = axes[a].range * axes[a].unit;
      closed[a] = axes[a].closed;
    }
  for (const auto &one : face.surface().faces())
    {
      const bool has_samples = !one.samples.empty();
      Patch      patch;
      patch.points = has_samples ? &one.samples : &one.nodes;
      patch.degree = has_samples ? mesh::surface_degree : face.mesh().degree();
      for (const unsigned int point : *patch.points)
        {
          Flat flat;
          for (unsigned int a = 0; a < dim - 1; ++a)
            {
              flat[a] = axes[a].values[point] * axes[a].unit;
              if (closed[a] && !patch.flat.empty())
                flat[a] -= ranges[a] * std::round((flat[a] - patch.flat.front()[a]) / ranges[a]);
            }
          patch.flat.push_back(flat);
        }
      for (const auto &flat : patch.flat)
        patch.centre += flat / double(patch.flat.size());
      patch.radius = 0.;
      for (const auto &flat : patch.flat)
        patch.radius = std::max(patch.radius, (flat - patch.centre).norm());
      if constexpr (dim == 3)
        for (unsigned int side = 0; side < 4; ++side)
          {
            const auto points = side_points(patch.degree, side);
            for (unsigned int k = 0; k < patch.degree; ++k)
              area += 0.5 * cross(patch.flat[points[k]] - patch.centre,
                                  patch.flat[points[k + 1]] - patch.centre);
          }
      else
        area += patch.flat.back()[0] - patch.flat.front()[0];
      patches.push_back(patch);
    }
}

/// Find the coordinates xi of the target in one face of the mesh by Newton's method. @p outside is
/// the maximum distance of xi from [0,1].
template <int dim>
std::optional<typename FaceChart<dim>::Place>
FaceChart<dim>::find(const Flat &target, const Patch &patch, double &outside) const
{
  Place place{patch.points, patch.degree, {}};
  for (unsigned int a = 0; a < dim - 1; ++a)
    place.xi[a] = 0.5;
  for (unsigned int iteration = 0; iteration < 15; ++iteration)
    {
      const auto                 values   = place.shape();
      Flat                       residual = target;
      dealii::Tensor<2, dim - 1> J;
      for (unsigned int k = 0; k < patch.flat.size(); ++k)
        {
          residual -= values.value[k] * patch.flat[k];
          J += outer_product(patch.flat[k], values.gradient[k]);
        }
      if (!(std::abs(determinant(J)) > 1e-12 * std::pow(patch.radius, dim - 1)))
        return {}; // the target lies at a pole, or far from the face
      const Flat step = invert(J) * residual;
      place.xi += step;
      if (!(step.norm() < 10.))
        return {};
      if (step.norm() < 1e-11)
        {
          outside = 0.;
          for (unsigned int a = 0; a < dim - 1; ++a)
            outside = std::max({outside, -place.xi[a], place.xi[a] - 1.});
          return place;
        }
    }
  return {};
}

template <int dim>
std::optional<typename FaceChart<dim>::Place> FaceChart<dim>::find(const Flat &target) const
{
  std::optional<Place> best;
  double               least = most_outside;
  for (const auto &patch : patches)
    {
      Flat near = target;
      for (unsigned int a = 0; a < dim - 1; ++a)
        if (closed[a])
          near[a] -= ranges[a] * std::round((near[a] - patch.centre[a]) / ranges[a]);
      if ((near - patch.centre).norm() > 1.1 * patch.radius)
        continue;
      double     outside = 0.;
      const auto place   = find(near, patch, outside);
      if (!place || outside >= least)
        continue;
      best  = place;
      least = outside;
      if (outside == 0.)
        break;
    }
  return best;
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
  for (unsigned int f = 0; f < patches.size(); ++f)
    for (unsigned int side = 0; side < 4; ++side)
      {
        const Ends ends = ends_of(f, side);
        ++uses[std::minmax(ends.first, ends.second)];
      }
  Edges result;
  for (unsigned int f = 0; f < patches.size(); ++f)
    for (unsigned int side = 0; side < 4; ++side)
      {
        const Ends ends = ends_of(f, side);
        if (uses[std::minmax(ends.first, ends.second)] > 1 || !face.border()[ends.first] ||
            !face.border()[ends.second])
          continue;
        Piece piece;
        for (const unsigned int k : side_points(patches[f].degree, side))
          piece.push_back(patches[f].flat[k]);
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
