#ifndef snug_cad_face_samples_h
#define snug_cad_face_samples_h

#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>

#include <utility>
#include <vector>

namespace snug::cad {
/// This class stores the edges of a face as polygons in the plane of the parameters (u, v), with
/// about 100 sides for each curved edge.
class FaceBorder
{
public:
  explicit FaceBorder(const TopoDS_Face &face);

  /// Return the ascending v at which the line of a constant u crosses the edges.
  std::vector<double> crossings(double u) const;

  /// Return whether a point of such a line lies within the edges.
  bool encloses(double v, const std::vector<double> &crossings) const;

private:
  std::vector<std::pair<gp_Pnt2d, gp_Pnt2d>> segments;
};

/**
 * Return those parameters (u, v) of a regular grid with @p n intervals of u and @p m intervals of v
 * that lie on a face within its edges, see FaceBorder. The grid fills the range of the parameters
 * of the face.
 */
std::vector<gp_Pnt2d> samples_inside(const TopoDS_Face &face, unsigned int n, unsigned int m);
} // namespace snug::cad

#endif
