#ifndef snug_state_expected_contacts_h
#define snug_state_expected_contacts_h

#include <snug/feti/total_feti.h>

namespace snug::state {
/**
 * Equality rows and the contact rows that are likely to carry: of each pair those with gaps of at
 * most delta more than its least one, where delta is how far N rows that share the force P of the
 * pair let the bodies approach,
 * @f[ \delta = c\,P\,\overline{F_{ii}}\,N(\delta)^{-1/2} \text{ in space},\qquad
 *     \delta = c\,P\,\overline{F_{ii}} \text{ in the plane}, @f]
 * as N rows on a patch of the radius a yield by about P/(E a) and a single one of the length h by
 * P/(E h). P is what the pair takes of lambda_Im, by which rigid subdomains would be in
 * equilibrium. Held displacements and overlaps let bodies approach as well. Gaps are those after
 * bodies that nothing but contact holds have fallen until the first of them touches. A guess: where
 * active sets begin, and which gaps are too wide to measure residuals by.
 *
 * @param[in] feti with its loads set.
 * @param[in] pair_of_row of each owned row, n_pairs for equality rows.
 * @return one flag per owned row. Collective.
 */
qp::RowSet expected_contacts(const feti::TotalFeti           &feti,
                             const std::vector<unsigned int> &pair_of_row,
                             unsigned int                     n_pairs,
                             unsigned int                     dim);
} // namespace snug::state

#endif
