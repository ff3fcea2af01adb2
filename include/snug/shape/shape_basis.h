#ifndef snug_shape_shape_basis_h
#define snug_shape_shape_basis_h

#include <snug/base/choice.h>
#include <snug/mesh/body_mesh.h>

#include <memory>
#include <string>
#include <vector>

namespace snug
{
  namespace shape
  {
    /// Entries of `subsection Shape`.
    struct ShapeParameters
    {
      std::string               basis = "none"; ///< none | Bezier patch
      std::string               face;           ///< "body.boundary"
      std::vector<unsigned int> control_points; ///< per tangent direction
      std::vector<double>       direction;      ///< of the heights
      std::vector<double>       bounds;         ///< lower, upper [length]
      std::vector<double>       initial;        ///< [length], default 0
    };

    /**
     * A linear operator V from design variables to node displacements,
     * x = reference + V alpha. Column i is the velocity dX/dalpha_i.
     */
    template <int dim>
    class ShapeBasis
    {
    public:
      using Field = typename mesh::BodyMesh<dim>::Field;

      virtual ~ShapeBasis() = default;

      virtual unsigned int
      n_variables() const = 0;

      /// V alpha on the local nodes [length].
      virtual Field
      apply(const std::vector<double> &alpha) const = 0;

      /// V' gradient summed over ranks: node gradient -> dJ/dalpha, where
      /// @p gradient adds up to the whole over ranks. Collective.
      virtual std::vector<double>
      transpose(const Field &gradient) const = 0;

      /// Column i on the local nodes.
      virtual Field
      column(unsigned int i) const = 0;

      /// Positions of the control points at alpha, for export.
      virtual std::vector<dealii::Point<dim>>
      control_points(const std::vector<double> &alpha) const = 0;
    };

    /// Names of the bodies in the order of the mesh, for "body.boundary".
    struct BodyNames
    {
      std::vector<std::string> names;
    };

    /// Rows "none" (no variables) and "Bezier patch".
    template <int dim>
    const ChoiceTable<
      std::unique_ptr<ShapeBasis<dim>>(const mesh::BodyMesh<dim> &,
                                       const BodyNames &,
                                       const ShapeParameters &)> &
    shape_basis_table();
  } // namespace shape
} // namespace snug

#endif
