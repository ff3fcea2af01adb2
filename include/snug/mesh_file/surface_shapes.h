#ifndef snug_mesh_file_surface_shapes_h
#define snug_mesh_file_surface_shapes_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/fitted_surface.h>
#include <snug/mesh_file/body_surface.h>
#include <snug/mesh_file/exact_faces.h>

namespace snug::mesh_file {
/**
 * This class determines the shape of each part of the surface of a body, which is the first of
 * these that applies:
 * - the surface of an exact face, which is a sphere, cylinder, cone or torus also if all nodes lie
 * on one;
 * - facets, if the entry "Surface" requires facets;
 * - a plane, if all nodes lie in a plane;
 * - a sphere, cylinder, cone or torus on which all nodes lie, with a tolerance of 1e-6 of the size
 * of the part or the last digit of the file;
 * - facets, with a note, if facets meet at more than 15 degrees and are not quadratic;
 * - the shape of the elements, if these are quadratic;
 * - a smooth surface.
 * Where "Surface" requires a smooth surface, facets with a note and the shape of the elements do
 * not apply.
 */
template <int dim>
class SurfaceShapes
{
public:
  using Corners = std::vector<unsigned int>;
  using Point   = dealii::Point<dim>;
  using Vector  = dealii::Tensor<1, dim>;

  enum class Kind
  {
    facets,
    plane,
    known,
    quadratic,
    smooth,
    exact ///< a surface that is known by its projection only
  };

  static constexpr unsigned int none = static_cast<unsigned int>(-1);

  struct Shape
  {
    Kind                                             kind        = Kind::facets;
    unsigned int                                     known_index = none; ///< index into known()
    Vector                                           normal;             ///< normal of a plane
    std::shared_ptr<const geometry::Projection<dim>> projection = {};    ///< of an exact face
  };

  /// Move nodes of @p surface onto their spheres, cylinders, cones and tori, and add the shapes of
  /// the boundaries to @p notes. @p exact may be null. @throws InputError with the entry Surface.
  SurfaceShapes(BodySurface<dim>                   &surface,
                const geometry::BodyMeshParameters &parameters,
                const std::vector<std::string>     &boundary_names,
                std::vector<std::string>           &notes,
                const ExactFaces<dim>              *exact);

  const Shape &of_facet(unsigned int facet) const { return shapes[surface.part_of[facet]]; }

  const std::vector<geometry::KnownSurface<dim>> &known() const { return surfaces; }

  /// Return the shapes by boundary. The name of a boundary with parts of several kinds lists the
  /// kinds.
  const std::map<unsigned int, geometry::BoundaryShape> &of_boundaries() const
  {
    return boundary_shapes;
  }

  /// Return the surfaces and planes on which a node or an edge of these facets lies.
  geometry::GeometryConstraints<dim> constraints(const std::vector<unsigned int> &facets) const;

  /// Return the curve or surface of exact faces on which the edge of these facets with the middle
  /// @p middle lies; null if constraints() determine the edge.
  std::shared_ptr<const geometry::Projection<dim>>
  projection(const std::vector<unsigned int> &facets, const Point &middle) const;

private:
  BodySurface<dim>                               &surface;
  const geometry::BodyMeshParameters             &parameters;
  const std::vector<std::string>                 &names;
  std::vector<std::string>                       &notes;
  const ExactFaces<dim>                          *exact;
  double                                          digit; ///< see last_digit()
  std::vector<geometry::KnownSurface<dim>>        surfaces;
  std::vector<Shape>                              shapes; ///< shapes of the parts
  std::map<unsigned int, std::string>             wanted; ///< boundary -> facets or smooth
  std::map<unsigned int, geometry::BoundaryShape> boundary_shapes;

  void                         read_entries();
  geometry::SurfaceSample<dim> sample(const std::vector<unsigned int> &facets, bool middles) const;
  Shape                        shape_of(const std::vector<unsigned int> &part);
  Shape                        exact_shape(const std::vector<unsigned int> &part);
  unsigned int matching(const geometry::SurfaceSample<dim> &sample, double tolerance) const;
  bool is_plane(const geometry::SurfaceSample<dim> &sample, double tolerance, Vector &normal) const;
  double       largest_kink(const std::vector<unsigned int> &part) const;
  double       facet_height(const std::vector<unsigned int> &part) const;
  void         name_boundaries();
  unsigned int recognized(const geometry::SurfaceSample<dim> &sample,
                          double                              tolerance,
                          const std::string                  &name,
                          double                              kink);
  void         move_nodes();
};

/// Return a unit of the last written digit of the largest coordinate. Return 0 if the coordinates
/// have all digits, or so few that they may be exact.
template <int dim>
double last_digit(const std::vector<dealii::Point<dim>> &points);
} // namespace snug::mesh_file

#endif
