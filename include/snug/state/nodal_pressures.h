#ifndef snug_state_nodal_pressures_h
#define snug_state_nodal_pressures_h

#include <snug/contact/contact.h>

#include <vector>

namespace snug::state {
/**
 * Return the pressures at the slave nodes of all rows of @p contact from the @p means r_i = force_i
 * / area_i, for faces of degree 2. There the means alternate between the ends and the middles of
 * lines of three nodes: by the second moments of their functions, -h^2 / 10 at an end and h^2 / 20
 * at a middle, and by the solution itself. Half of the alternation at an end is
 * @f[ a = (r_{-2} - 4 r_{-1} + 6 r_0 - 4 r_1 + r_2) / 16. @f]
 * It is taken out in the ratio of the moments: the pressure is r_0 - 4/3 a at an end and r_1 + 2/3
 * of the mean a of both ends at a middle, along each direction of the face. Where a mesh ends, a is
 * that of the other end of the line. Nodes without a positive mean, hanging nodes, lines of
 * unlike lengths and quadratic triangles take no part.
 */
template <int dim>
std::vector<double> nodal_pressures(const mesh::Surface<dim>    &surface,
                                    const contact::Contact<dim> &contact,
                                    const std::vector<double>   &means);
} // namespace snug::state

#endif
