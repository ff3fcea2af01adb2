#ifndef snug_feti_row_layout_h
#define snug_feti_row_layout_h

#include <snug/base/narrow.h>
#include <snug/base/petsc_handle.h>
#include <snug/qp/dual_problem.h>

namespace snug::feti {
/**
 * Where the rows of B live. Each row is owned by one rank; a rank's local
 * rows are those its subdomains touch. Rows that share an unknown (one
 * copy of it in one subdomain) must have one owner, so that
 * @f$B D^{-1} B^T@f$ is block diagonal over ranks.
 */
class RowLayout
{
public:
  /// Entry of B in a subdomain: global row (rank offset + index), unknown.
  struct Entry
  {
    unsigned int global_row;
    unsigned int dof;
  };

  /**
   * Collective.
   * @param[in] bounded flag of each owned row: contact.
   * @param[in] entries of each subdomain of this rank.
   * @param[in] first_subdomain global id of the first one.
   */
  RowLayout(MPI_Comm                               communicator,
            const qp::RowSet                      &bounded,
            const std::vector<std::vector<Entry>> &entries,
            unsigned int                           first_subdomain);

  MPI_Comm          communicator() const { return comm; }
  unsigned int      n_owned() const { return narrow<unsigned int>(is_bounded.size()); }
  unsigned int      n_local() const { return narrow<unsigned int>(local_rows.size()); }
  const qp::RowSet &bounded() const { return is_bounded; }
  /// Global row of an owned one.
  unsigned int global_row(unsigned int owned_row) const { return first_owned + owned_row; }
  unsigned int global_row_of_local(unsigned int local_row) const { return local_rows[local_row]; }
  /// Local row of a global row this rank touches.
  unsigned int local_row(unsigned int global_row) const;

  /// Owned values -> local rows. Collective.
  qp::MultiVector to_local(const qp::MultiVector &owned) const;
  /// Sum of local rows -> owned values. Collective.
  qp::MultiVector to_owned(const qp::MultiVector &local) const;

  /**
   * Send @p width numbers per entry of B (subdomain by subdomain, in the
   * order given to the constructor) to the row's owner, which receives
   * them row by row, sorted by subdomain and unknown. Collective.
   */
  std::vector<double> gather_entries(unsigned int width, const std::vector<double> &values) const;
  /// First gathered entry of each owned row; n_owned + 1.
  const std::vector<unsigned int> &entry_start() const { return start; }
  /// Global subdomain and unknown of each gathered entry.
  const std::vector<std::pair<unsigned int, unsigned int>> &entry_unknowns() const;

private:
  std::vector<double> gather_unsorted(unsigned int width, const std::vector<double> &values) const;

  MPI_Comm                                           comm;
  qp::RowSet                                         is_bounded;
  unsigned int                                       first_owned; ///< as global row
  std::vector<unsigned int>                          local_rows;  ///< ascending global rows
  petsc::StarForest                                  row_forest, entry_forest;
  std::vector<unsigned int>                          start;
  std::vector<unsigned int>                          order; ///< of gathered entries
  std::vector<std::pair<unsigned int, unsigned int>> unknowns;
};
} // namespace snug::feti

#endif
