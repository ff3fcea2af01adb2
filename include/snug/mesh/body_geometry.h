#ifndef snug_mesh_body_geometry_h
#define snug_mesh_body_geometry_h

#include <snug/base/choice.h>

#include <deal.II/base/point.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace snug
{
  namespace mesh
  {
    /**
     * Mesh entries of `subsection Body NAME`. Faces of a box are called left,
     * right (x-, x+), front, back (y-, y+), bottom, top (z-, z+); in 2D left,
     * right (x-, x+), bottom, top (y-, y+).
     */
    struct BodyMeshParameters
    {
      std::string               source = "box";
      std::vector<double>       corner; ///< [length], default 0
      std::vector<double>       size;   ///< [length], default 1
      std::vector<unsigned int> cells;  ///< per axis
      /// per axis: size of the last cell over the size of the first, cells
      /// between in geometric progression; default 1
      std::vector<double> grading;
      /// per axis: half of the cells are equal and fill this much from the
      /// lower end, the rest grow from there [length]; 0: not; default 0
      std::vector<double> fine_length;
      /// face name -> "sphere R" | "cylinder x R" | formula of x, y, z giving
      /// the outward displacement of the face [length]. The curved face
      /// touches the flat one at its centre; R > 0 is convex. In 2D a
      /// cylinder's axis is z.
      std::map<std::string, std::string> curved_faces;
      unsigned int                       refinements = 0;
      /// cells are refined where this formula of x, y, z is positive
      std::string  refine_where;
      unsigned int local_refinements = 0;
    };

    /**
     * The reference geometry of one body: a coarse mesh in logical
     * coordinates and the map from logical coordinates to positions, which is
     * evaluated anew on every mesh.
     */
    template <int dim>
    class BodyGeometry
    {
    public:
      virtual ~BodyGeometry() = default;

      /// Coarse mesh in logical coordinates; boundary faces get the index of
      /// their name in boundary_names().
      struct CoarseMesh
      {
        std::vector<dealii::Point<dim>>        vertices;
        std::vector<std::vector<unsigned int>> cells; ///< deal.II vertex order
        /// face vertices (in the order of the cell) and boundary index
        std::vector<std::pair<std::vector<unsigned int>, unsigned int>>
          boundary_faces;
      };

      virtual CoarseMesh
      coarse_mesh() const = 0;

      virtual const std::vector<std::string> &
      boundary_names() const = 0;

      /// Reference position of the point with logical coordinates @p logical.
      /// @throws InputError where the formula of a face is not finite.
      virtual dealii::Point<dim>
      position(const dealii::Point<dim> &logical) const = 0;

      /**
       * Fraction in [0,1]^dim of the body's box at @p logical: the frame of
       * Bézier patches. For face 2d+s, coordinate d is the distance from the
       * opposite side.
       */
      virtual dealii::Point<dim>
      box_fraction(const dealii::Point<dim> &logical) const = 0;

      /// The point at @p fraction of the body's box, faces not yet curved.
      virtual dealii::Point<dim>
      box_position(const dealii::Point<dim> &fraction) const = 0;
    };

    /**
     * Rows "box". @throws InputError naming the entry: Box corner, Box size,
     * Box cells, Box grading or Curved faces.
     */
    template <int dim>
    const ChoiceTable<
      std::unique_ptr<BodyGeometry<dim>>(const BodyMeshParameters &)> &
    body_geometry_table();

    /// Index of @p name in the boundary names. @throws InputError listing them.
    template <int dim>
    unsigned int
    boundary_index(const BodyGeometry<dim> &geometry, const std::string &name);
  } // namespace mesh
} // namespace snug

#endif
