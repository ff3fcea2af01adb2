#ifndef snug_response_measured_place_h
#define snug_response_measured_place_h

#include <snug/response/response_parameters.h>
#include <snug/state/state_solver.h>

#include <utility>
#include <vector>

namespace snug::response {
/// The unit vector of the component x, y or z.
/// @throws InputError for other names.
template <int dim>
dealii::Tensor<1, dim> unit_vector(const ResponseParameters &parameters);

/// (body, boundary) of the face "body.boundary".
/// @throws InputError if there is no such boundary.
template <int dim>
std::pair<unsigned int, unsigned int> find_boundary(const state::StateSolver<dim> &solver,
                                                    const ResponseParameters      &parameters);

/// A point of a cell: sum_a weights_a field_a is the value of a field.
struct CellWeights
{
  unsigned int        subdomain, cell; ///< see Assembler::cells()
  std::vector<double> weights;         ///< per node of the cell
};

/**
 * Where the point lies in the reference geometry: of all cells of the body
 * (if it is empty, of any) that hold it the first one of the lowest rank,
 * so that one rank returns one element and the others none. Collective.
 * @throws InputError if it lies in no body (outside by more than 1e-6 of a
 *   cell), or in several.
 */
template <int dim>
std::vector<CellWeights> find_point(const state::StateSolver<dim> &solver,
                                    const ResponseParameters      &parameters);
} // namespace snug::response

#endif
