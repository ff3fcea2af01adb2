#ifndef snug_mesh_file_surface_shapes_h
#define snug_mesh_file_surface_shapes_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/fitted_surface.h>
#include <snug/mesh_file/body_surface.h>

namespace snug::mesh_file {
/**
 * What each part of the surface of a body is, the first of these that applies:
 * - facets, if "Surface" says so;
 * - a plane, if its nodes lie in one;
 * - facets, with a note, if these turn by more than 15 degrees and are not quadratic;
 * - a sphere, cylinder, cone or torus on which all of its nodes lie, to 1e-6 of its size or the
 *   last digit of the file;
 * - of the shape of its elements, if these are quadratic;
 * - smooth.
 * Where "Surface" says smooth, the third and the last but one do not count.
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
    smooth
  };

  static constexpr unsigned int none = static_cast<unsigned int>(-1);

  struct Shape
  {
    Kind         kind        = Kind::facets;
    unsigned int known_index = none; ///< into known()
    Vector       normal;             ///< of a plane
  };

  /// Moves nodes of @p surface onto the spheres and others they belong to, and adds to @p notes
  /// what each boundary is. @throws InputError naming Surface.
  SurfaceShapes(BodySurface<dim>                   &surface,
                const geometry::BodyMeshParameters &parameters,
                const std::vector<std::string>     &boundary_names,
                std::vector<std::string>           &notes);

  const Shape &of_facet(unsigned int facet) const { return shapes[surface.part_of[facet]]; }

  const std::vector<geometry::KnownSurface<dim>> &known() const { return surfaces; }

  /// By boundary; the names of parts of several kinds one after the other.
  const std::map<unsigned int, geometry::BoundaryShape> &of_boundaries() const
  {
    return boundary_shapes;
  }

  /// What a node or an edge of these facets lies on.
  geometry::Guides<dim> guides(const std::vector<unsigned int> &facets) const;

private:
  BodySurface<dim>                               &surface;
  const geometry::BodyMeshParameters             &parameters;
  const std::vector<std::string>                 &names;
  std::vector<std::string>                       &notes;
  double                                          digit; ///< see last_digit()
  std::vector<geometry::KnownSurface<dim>>        surfaces;
  std::vector<Shape>                              shapes; ///< of parts
  std::map<unsigned int, std::string>             wanted; ///< boundary -> facets or smooth
  std::map<unsigned int, geometry::BoundaryShape> boundary_shapes;

  void                         read_entries();
  geometry::SurfaceSample<dim> sample(const std::vector<unsigned int> &facets, bool middles) const;
  Shape                        shape_of(const std::vector<unsigned int> &part);
  bool is_plane(const geometry::SurfaceSample<dim> &sample, double tolerance, Vector &normal) const;
  double largest_kink(const std::vector<unsigned int> &part) const;
  double facet_height(const std::vector<unsigned int> &part) const;
  void   name_boundaries();
  unsigned int
  recognized(const geometry::SurfaceSample<dim> &sample, double tolerance, const std::string &name);
  void move_nodes();
};

/// A unit of the last digit with which the coordinates were written, of the largest of them; 0 if
/// they have all digits, or so few that these may be the design's.
template <int dim>
double last_digit(const std::vector<dealii::Point<dim>> &points);
} // namespace snug::mesh_file

#endif
