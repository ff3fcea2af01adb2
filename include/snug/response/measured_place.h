#ifndef snug_response_measured_place_h
#define snug_response_measured_place_h

#include <snug/response/response_parameters.h>
#include <snug/state/state_solver.h>
#include <snug/supports/component.h>

#include <utility>
#include <vector>

namespace snug::response {
/// Return the unit vector of the component x, y or z.
/// @throws InputError for other names.
template <int dim>
dealii::Tensor<1, dim> unit_vector(const ResponseParameters &parameters);

/// Return 'Component' on the body of 'Face', in the frame of the body.
/// @throws InputError for components that the model does not have.
template <int dim>
supports::Component<dim> component_of(const state::StateSolver<dim> &solver,
                                      const ResponseParameters      &parameters);

/// Return the axis x, y or z of a moment or a rotation; in the plane it is z.
/// @throws InputError for other names.
template <int dim>
dealii::Tensor<1, 3> axis_of(const ResponseParameters &parameters);

/// Return (body, boundary) of the face "body.boundary".
/// @throws InputError if there is no such boundary.
template <int dim>
std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &solver,
                                                    const ResponseParameters      &parameters);

/// A point of a cell: the value of a field at the point is sum_a weights_a field_a.
struct CellWeights
{
  unsigned int        subdomain, cell; ///< see Assembler::cells()
  std::vector<double> weights;         ///< per node of the cell
};

/**
 * Find the cell that contains the point in the reference geometry. The search covers the
 * cells of the body, or of all bodies if the name of the body is empty. Several cells may
 * contain the point. The function returns the first such cell of the lowest rank, so that one
 * rank returns one element and all other ranks return none. Collective.
 * @throws InputError if the point lies in no body (outside by more than 1e-6 of a cell), or
 * in several bodies.
 */
template <int dim>
std::vector<CellWeights> find_point(const state::StateSolver<dim> &solver,
                                    const ResponseParameters      &parameters);
} // namespace snug::response

#endif
