#ifndef snug_app_offsets_h
#define snug_app_offsets_h

#include <snug/app/shape_problem.h>

#include <string>
#include <vector>

namespace snug::app {
/**
 * Return a warning for each body whose shaped faces designs can move as a whole, if such a move
 * displaces a body instead of changing contact: no support holds this body against the motion, and
 * the body has contact on the shaped faces alone. The objective then hardly depends on the offset,
 * or drives the offset to the bounds. Only the components along the normals of the faces count.
 *
 * The motions are the translations along the axes and the rotations about the centre of the faces.
 * There are no lines for tasks other than optimize, for problems with a constraint on the geometry
 * alone, such as the volume, and for more than 300 variables. Collective.
 */
template <int dim>
std::vector<std::string> offset_warnings(const ShapeProblem<dim> &problem);
} // namespace snug::app

#endif
