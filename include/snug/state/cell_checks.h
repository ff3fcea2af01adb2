#ifndef snug_state_cell_checks_h
#define snug_state_cell_checks_h

#include <snug/state/model.h>

namespace snug::state {
/// Return the flaw of a cell of @p body at @p x with this quality (Element::quality()) and scaled
/// Jacobian, or an empty text if there is none.
template <int dim>
std::string flaw_of_cell(const std::string            &body,
                         const dealii::Tensor<1, dim> &x,
                         double                        quality,
                         double                        jacobian,
                         double                        least_jacobian);

/// Check the cells of this rank in the reference mesh, for the @p elements of the bodies.
/// @throws InputError for a flaw, because no design has moved this mesh.
template <int dim>
void check_cells(const mesh::BodyMesh<dim>                   &mesh,
                 const Model<dim>                            &model,
                 const std::vector<elasticity::Element<dim>> &elements);
} // namespace snug::state

#endif
