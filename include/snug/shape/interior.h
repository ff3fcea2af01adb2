#ifndef snug_shape_interior_h
#define snug_shape_interior_h

#include <snug/base/choice.h>
#include <snug/shape/shaped_face.h>

#include <memory>

namespace snug::shape {
/**
 * How a body's nodes follow its shaped face: a linear operator from the
 * displacements of the face's nodes to those of all nodes, which keeps the
 * former. Hanging nodes follow their masters.
 */
template <int dim>
class Interior
{
public:
  using Field     = typename mesh::BodyMesh<dim>::Field;
  using FaceField = typename ShapedFace<dim>::Field;

  virtual ~Interior() = default;

  /// Displacement of the local nodes; @p moves is the same on all ranks.
  /// Collective.
  virtual Field extend(const FaceField &moves) const = 0;

  /// Transpose of extend(), summed over ranks; @p gradient adds up to the
  /// whole over ranks. Collective.
  virtual FaceField transpose(const Field &gradient) const = 0;
};

/// Collective. @throws InputError. The face must outlive the interior.
template <int dim>
using MakeInterior = std::unique_ptr<Interior<dim>>(const ShapedFace<dim> &,
                                                    const ShapeParameters &);

/// Rows "linear blending", "Laplace" and "elasticity".
template <int dim>
const ChoiceTable<MakeInterior<dim>> &interior_table();
} // namespace snug::shape

#endif
