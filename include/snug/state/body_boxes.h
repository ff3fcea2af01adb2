#ifndef snug_state_body_boxes_h
#define snug_state_body_boxes_h

#include <snug/mesh/body_mesh.h>

namespace snug::state {
/// Bounding box of a body in the reference geometry.
template <int dim>
struct BodyBox
{
  dealii::Tensor<1, dim> centre;
  double                 length; ///< half of the diagonal
};

/// Return the boxes of all bodies. Collective.
template <int dim>
std::vector<BodyBox<dim>> body_boxes(const mesh::BodyMesh<dim> &mesh);
} // namespace snug::state

#endif
