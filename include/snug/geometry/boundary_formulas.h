#ifndef snug_geometry_boundary_formulas_h
#define snug_geometry_boundary_formulas_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/**
 * Return @p geometry with the boundaries of the boundary formulas in addition to its own ones. A
 * face of the mesh before refinement belongs to the first new boundary of its own boundary whose
 * formula is positive at all of its vertices; the other faces keep their boundary. Vertices on the
 * edge of a new boundary may have either sign, so that formulas are evaluated 1e-9 of the way from
 * the vertices to the centre of the face. Return @p geometry itself if there are no formulas.
 * @throws InputError naming Boundary formulas: a boundary that does not exist, a name that exists,
 *   a new boundary without faces, and faces with vertices of both signs, with their number and the
 *   place where the formula changes its sign on an edge of the first of them.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>>
with_boundary_formulas(std::unique_ptr<BodyGeometry<dim>> geometry,
                       const BodyMeshParameters          &parameters);

/// Return whether boundary formulas make @p boundary a part of a boundary of the mesh.
bool is_part(const BodyMeshParameters &parameters, const std::string &boundary);
} // namespace snug::geometry

#endif
