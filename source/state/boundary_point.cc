#include <snug/base/errors.h>
#include <snug/state/boundary_point.h>

#include <cmath>
#include <sstream>

namespace snug::state {
namespace {
/// Maximum distance of a point from its face, in diagonals of the face.
const double most_distance = 0.1;
} // namespace

template <int dim>
typename contact::NearestFace<dim>::Found face_at(const mesh::Surface<dim>        &surface,
                                                  const contact::NearestFace<dim> &search,
                                                  const dealii::Point<dim>        &x,
                                                  const std::pair<std::string, std::string> &entry)
{
  const auto   found    = search.closest(x);
  const auto  &nodes    = surface.faces()[found.face].nodes;
  const auto  &X        = surface.reference_positions();
  const double size     = (X[nodes.back()] - X[nodes.front()]).norm();
  const double distance = std::sqrt(found.point.squared_distance);
  if (distance > most_distance * size)
    {
      std::ostringstream text;
      text << "the point (" << x << ") must be on the boundary, whose nearest point is ("
           << found.point.position << ")";
      throw bad_entry(entry.first, entry.second, text.str());
    }
  return found;
}

template contact::NearestFace<2>::Found face_at(const mesh::Surface<2> &,
                                                const contact::NearestFace<2> &,
                                                const dealii::Point<2> &,
                                                const std::pair<std::string, std::string> &);
template contact::NearestFace<3>::Found face_at(const mesh::Surface<3> &,
                                                const contact::NearestFace<3> &,
                                                const dealii::Point<3> &,
                                                const std::pair<std::string, std::string> &);
} // namespace snug::state
