#ifndef snug_app_designed_face_h
#define snug_app_designed_face_h

#include <snug/cad/write_step.h>
#include <snug/io/spline_surface.h>
#include <snug/io/summary.h>
#include <snug/state/symmetry_planes.h>

namespace snug::app {
/// Return a surface of splines for a file. The parameters are @p lower + fraction @p range.
template <int dim>
cad::SplineFace spline_face(const io::SplineSurface<dim>     &surface,
                            const dealii::Tensor<1, dim - 1> &range,
                            const dealii::Tensor<1, dim - 1> &lower = {});

/// Maximum number of control points of a face.
const unsigned int most_points = 5000;

/**
 * This class describes a shaped boundary in a design, for files and for the log. The design is
 * constant around an axis, or across a direction, if the displacements along the normals depend on
 * one coordinate alone. This is decided by the nodes that do not hang and the samples: those at the
 * same coordinate have the same displacement up to 1e-6 of the maximum one, and displacements at
 * coordinates of single nodes lie between those at the adjacent coordinates up to this part.
 */
template <int dim>
class DesignedFace
{
public:
  using Vector = dealii::Tensor<1, dim>;

  /// @p positions are those of the nodes and samples of the mesh. Collective. The mesh must outlive
  /// this object.
  DesignedFace(const mesh::BodyMesh<dim>    &mesh,
               const shape::BodyNames       &names,
               const shape::ShapeParameters &parameters,
               const mesh::Field<dim>       &positions);

  const std::string name;

  const shape::ShapedFace<dim> &shaped_face() const { return *face; }
  /// Return the positions of the points of the face in the design.
  const std::vector<Vector> &positions() const { return at_points; }

  /// Return the diagonal of the box of the face in the design [length].
  double size() const;

  /// Return numbers by which the surface node with a global number is sorted: by the position along
  /// the axis of an extrusion or a surface of revolution, or along the longer direction of a graph,
  /// then across. Zeros if the face has no coordinates.
  std::array<unsigned int, 2> place(unsigned int global_node) const;

  /**
   * Return a table of at most 9 points along the face with the depths below the highest point
   * before and after the optimization: below the largest radius of a face that is constant around
   * an axis, or along the mean normal. Empty if the face has not moved, depends on two coordinates,
   * or surrounds the body across a direction. @p unit is that of lengths, or empty.
   */
  std::string crown(const std::string                            &unit,
                    const std::vector<state::SymmetryPlane<dim>> &planes) const;

  /// Return the face with B-splines that deviate by at most @p asked [length], or that have at most
  /// most_points control points, and the summary of the face. A design that is constant around an
  /// axis is a revolved curve. @throws InputError if the face has no coordinates.
  std::pair<cad::SplineFace, io::Summary::ProfileFace> splines(double asked) const;

private:
  /// Coordinates with the one of them on which the design depends alone.
  using Section = std::pair<shape::FaceCoordinates<dim>, unsigned int>;

  bool is_interpolated(unsigned int point) const;
  bool depends_on(const shape::FaceCoordinate &coordinate) const;
  void fit_revolved(cad::SplineFace &of_file, io::Summary::ProfileFace &summary) const;

  std::shared_ptr<const shape::ShapedFace<dim>> face;
  std::vector<Vector>                           at_points;
  std::vector<double>                           moves; ///< along the normals
  double                                        largest_move = 0.;
  std::optional<shape::FaceCoordinates<dim>>    coordinates; ///< best ones for splines
  std::optional<Section>                        section;
  std::vector<std::vector<unsigned int>>        ranks; ///< per place, per surface node
};
} // namespace snug::app

#endif
