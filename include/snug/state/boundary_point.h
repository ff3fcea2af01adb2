#ifndef snug_state_boundary_point_h
#define snug_state_boundary_point_h

#include <snug/contact/nearest_face.h>

namespace snug::state {
/// Return the face at the reference position @p x, which may be off the faces of a curved boundary
/// by a tenth of a face. The error names the path and the value @p entry.
/// @throws InputError if the point is not on the boundary whose faces @p search contains.
template <int dim>
typename contact::NearestFace<dim>::Found face_at(const mesh::Surface<dim>        &surface,
                                                  const contact::NearestFace<dim> &search,
                                                  const dealii::Point<dim>        &x,
                                                  const std::pair<std::string, std::string> &entry);
} // namespace snug::state

#endif
