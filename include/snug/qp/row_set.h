#ifndef snug_qp_row_set_h
#define snug_qp_row_set_h

#include <snug/qp/dual_problem.h>

#include <cstdint>

namespace snug::qp {
/// True if @p mine is on any rank. Collective.
bool any(bool mine, MPI_Comm comm);

/// What hashes are made of: the finalizer of the SplitMix64 generator (Steele, Lea, Flood, OOPSLA
/// 2014), one to one.
std::uint64_t scramble(std::uint64_t x);

/// A number that tells sets apart (a hash), equal on all ranks for the
/// same distribution of rows. Collective.
std::uint64_t fingerprint(const RowSet &rows, MPI_Comm comm);

/// @p from with the one change towards @p to that has the largest row
/// number (Bland's rule), rows being numbered rank after rank. Collective.
RowSet with_one_change(const RowSet &from, const RowSet &to, MPI_Comm comm);

/// The rows that are not in @p rows.
RowSet complement(const RowSet &rows);

/// The equality rows and those with lambda_i > 0 (one column).
RowSet loaded_rows(const RowSet &bounded, const MultiVector &lambda);

/// lambda_i < 0 on a bounded row of this rank.
bool has_negative(const RowSet &bounded, const MultiVector &lambda);

/// Set entries on bounded rows to zero that are not larger than
/// @p rounding, one number per row.
void clip_rounding(const RowSet &bounded, const std::vector<double> &rounding, MultiVector &lambda);
} // namespace snug::qp

#endif
