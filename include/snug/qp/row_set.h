#ifndef snug_qp_row_set_h
#define snug_qp_row_set_h

#include <snug/qp/dual_problem.h>

#include <cstdint>

namespace snug::qp {
/// Return whether @p mine is true on any rank. Collective.
bool any(bool mine, MPI_Comm comm);

/// Return the hash of a number by the finalizer of the SplitMix64 generator (Steele, Lea, Flood,
/// OOPSLA 2014), which is one to one.
std::uint64_t scramble(std::uint64_t x);

/// Return a hash that distinguishes sets, equal on all ranks for the same distribution of rows.
/// Collective.
std::uint64_t fingerprint(const RowSet &rows, MPI_Comm comm);

/// Return @p from with one change towards @p to: the change of the row with the largest number
/// (Bland's rule). Rows are numbered rank after rank. Collective.
RowSet with_one_change(const RowSet &from, const RowSet &to, MPI_Comm comm);

/// Return the rows that are not in @p rows.
RowSet complement(const RowSet &rows);

/// Return the equality rows and the rows with lambda_i > 0 (one column).
RowSet loaded_rows(const RowSet &bounded, const MultiVector &lambda);

/// Return whether lambda_i < 0 on a bounded row of this rank.
bool has_negative(const RowSet &bounded, const MultiVector &lambda);

/// Set entries on bounded rows to zero that do not exceed their number in @p rounding, which has
/// one number per row.
void clip_rounding(const RowSet &bounded, const std::vector<double> &rounding, MultiVector &lambda);
} // namespace snug::qp

#endif
