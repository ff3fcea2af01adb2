#ifndef snug_feti_initial_active_set_h
#define snug_feti_initial_active_set_h

#include <snug/feti/loaded_problem.h>

namespace snug::feti {
/**
 * Return the equality rows and the contact rows that are likely to carry a force, as rigid
 * subdomains would predict. Likely rows of a pair have gaps of at most delta more than the minimum
 * gap of the pair. delta is the approach of the bodies if N rows share the force P of the pair,
 * @f[ \delta = c\,P\,\overline{F_{ii}}\,N(\delta)^{-1/2} \text{ in space},\qquad
 *     \delta = c\,P\,\overline{F_{ii}} \text{ in the plane}, @f]
 * because N rows on a patch of the radius a yield by about P/(E a), and a single row of the length
 * h yields by P/(E h). P is the share of the pair in lambda_Im, for which rigid subdomains would be
 * in equilibrium. Held displacements and overlaps let bodies approach as well. Gaps are measured
 * after bodies that only contact holds have moved until the first of them touches. The result is a
 * guess: active sets begin with it, and it tells which gaps are too wide to measure residuals by.
 *
 * @param[in] problem of which only initial_active_set() is not used.
 * @return one flag per owned row. Collective.
 */
qp::RowSet rigid_prediction(const LoadedProblem &problem, const ContactPairs &pairs);
} // namespace snug::feti

#endif
