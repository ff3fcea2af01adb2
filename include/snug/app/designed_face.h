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
 * This class is the motion of a plane curve that makes a face: a rotation about an axis, or a
 * translation. In 2D the motion is that from the section to the solid.
 */
class Sweep
{
public:
  using Vector = dealii::Tensor<1, 3>;

  /// @p lower is the angle about the axis [radian], or the position along it [length], at which
  /// the face begins; @p extent is that of the face.
  Sweep(bool rotates, const shape::Axis &axis, double lower, double extent);

  /// Return the point of the curve that passes through @p x: the distance from the axis and the
  /// position along it, or two components across the direction.
  dealii::Tensor<1, 2> section(const Vector &x) const;

  /// Return the swept face of a curve of such points.
  cad::SplineFace face(const io::SplineSurface<2> &curve, const dealii::Tensor<1, 1> &range) const;

  const bool        rotates;
  const shape::Axis axis;

private:
  const double lower, extent;
  Vector       across[2]; ///< unit vectors at right angles to the axis
};

/**
 * This class describes a shaped boundary in a design, for files and for the log. If the
 * displacements from the reference geometry along the normals depend on one coordinate alone, and
 * the reference geometry is an extrusion or a surface of revolution along the other one, the face
 * is a curve that is swept. This is decided by the nodes that do not hang and the samples: those at
 * the same coordinate have the same displacement up to 1e-6 of the maximum one, and displacements
 * at coordinates of single nodes lie between those at the adjacent coordinates up to this part.
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
   * Return a table of at most 9 equidistant positions along the face with the depths below the
   * highest point before and after the optimization: along the radius of a face that is constant
   * around an axis, or along the mean normal. Empty if the face has not moved, depends on two
   * coordinates, or is closed. @p unit is that of lengths, or empty.
   */
  std::string crown(const std::string                            &unit,
                    const std::vector<state::SymmetryPlane<dim>> &planes) const;

  /// Return the face with B-splines that deviate by at most @p asked [length], or that have at most
  /// most_points control points, and the summary of the face. @throws InputError if the face has
  /// no coordinates.
  std::pair<cad::SplineFace, io::Summary::ProfileFace> splines(double asked) const;

private:
  /// Coordinates of which one is swept: the axes in the order of SplineFace.
  struct Swept
  {
    Sweep                              sweep;
    std::vector<shape::FaceCoordinate> axes;
    unsigned int                       curve; ///< axis of the curve
    std::string                        along; ///< name of the coordinate of the curve
  };

  void add_sweep(const shape::FaceCoordinates<dim> &of);
  bool is_interpolated(unsigned int point) const;
  bool depends_on(const shape::FaceCoordinate &coordinate) const;
  std::optional<typename shape::FaceChart<dim>::Place>
  on_curve(const shape::FaceChart<dim> &chart, double s, const std::vector<double> &across) const;
  io::SplineSurface<2> fitted_curve(const shape::FaceChart<dim> &chart, double tolerance) const;

  std::shared_ptr<const shape::ShapedFace<dim>> face;
  std::vector<Vector>                           at_points;
  std::vector<double>                           moves; ///< along the normals
  double                                        largest_move = 0.;
  std::optional<shape::FaceCoordinates<dim>>    coordinates; ///< best ones for splines
  std::optional<Swept>                          swept;
  std::vector<std::vector<unsigned int>>        ranks; ///< per place, per surface node
};
} // namespace snug::app

#endif
