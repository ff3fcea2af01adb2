#ifndef snug_accuracy_jumps_h
#define snug_accuracy_jumps_h

#include <snug/accuracy/local_errors.h>

namespace snug::accuracy {
/// Return the jump at each node between its copies in column @p j [length]: the square root of the
/// sum of the squares of the changes from @p torn to @p continuous. The jump does not depend on
/// the number of ranks. Collective.
template <int dim>
mesh::Field<dim> jump(const state::StateSolver<dim> &solver,
                      const feti::PrimalVectors     &torn,
                      const feti::PrimalVectors     &continuous,
                      unsigned int                   j);

/// Return a bound of the norm of the local errors of a jump(), see LocalErrors, at a fraction of
/// their cost: its energy norm times a factor that grows with the ratio of the stiffnesses of cells
/// and with the aspect ratios of cells. Collective.
template <int dim>
double bound_of_errors(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state,
                       const mesh::Field<dim>         &jump);

/// Return the norm of the local errors of a jump(), or bound_of_errors() if it is at most
/// @p allowed. Local problems of a stiff cell beside a soft one, or of a nearly incompressible
/// cell, turn jumps into errors of stress or pressure that are much larger than the energy of the
/// jumps. Collective.
template <int dim>
double error_of_jump(const LocalErrors<dim>         &local,
                     const state::StateSolver<dim>  &solver,
                     const state::ContactState<dim> &state,
                     const mesh::Field<dim>         &jump,
                     double                          allowed);
} // namespace snug::accuracy

#endif
