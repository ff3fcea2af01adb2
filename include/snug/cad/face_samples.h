#ifndef snug_cad_face_samples_h
#define snug_cad_face_samples_h

#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>

#include <vector>

namespace snug::cad {
/**
 * Return those parameters (u, v) of a regular grid with @p n intervals of u and @p m intervals of v
 * that lie on a face within its edges. The grid fills the range of the parameters of the face. The
 * edges are polygons with about 100 sides each, so that parameters closer to a curved edge may
 * count as inside or outside.
 */
std::vector<gp_Pnt2d> samples_inside(const TopoDS_Face &face, unsigned int n, unsigned int m);
} // namespace snug::cad

#endif
