#ifndef snug_contact_row_derivatives_h
#define snug_contact_row_derivatives_h

#include <snug/contact/row_group.h>
#include <snug/faces/recording.h>

namespace snug::contact {
/// Return the derivatives alone.
std::vector<double> slopes_of(const std::vector<faces::Differential<1>> &numbers);

/// Return the derivatives of coefficients, gap and normal.
template <int dim>
Row<dim> derivative_of(const Row<dim, faces::Differential<1>> &row);

/// Add @p slopes, the derivatives of the scalar of @p recording with respect to the numbers of
/// @p row, to the recording. The slopes must not be empty.
template <int dim>
void add_slopes(const Row<dim, faces::Recorded> &row,
                const RowSlopes<dim>            &slopes,
                faces::Recording                &recording);
} // namespace snug::contact

#endif
