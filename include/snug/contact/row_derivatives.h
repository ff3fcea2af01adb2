#ifndef snug_contact_row_derivatives_h
#define snug_contact_row_derivatives_h

#include <snug/contact/row_group.h>
#include <snug/faces/recording.h>

namespace snug::contact {
/// Return the derivatives of coefficients, gap and normal.
template <int dim>
Row<dim> derivative_of(const Row<dim, faces::Differential<1>> &row);

/// Add the derivatives of force (sum_a c_a . u_a - gap) with respect to the numbers of the row to
/// the scalar of @p recording.
template <int dim>
void add_energy_derivatives(const Row<dim, faces::Recorded>          &row,
                            const typename mesh::Surface<dim>::Field &displacement,
                            double                                    force,
                            faces::Recording                         &recording);
} // namespace snug::contact

#endif
