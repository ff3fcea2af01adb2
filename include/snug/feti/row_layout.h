#ifndef snug_feti_row_layout_h
#define snug_feti_row_layout_h

#include <snug/base/narrow.h>
#include <snug/base/petsc_handle.h>
#include <snug/qp/dual_problem.h>

#include <tuple>

namespace snug::feti {
/**
 * This class describes the distribution of the rows of B over ranks. Each row is owned by one rank.
 * The local rows of a rank are those with an entry in one of its subdomains: first the equality
 * rows, then the contact rows, each in the order of the global rows. Layouts with equal equality
 * rows thus number these rows equally. Rows that share an unknown (one copy of it in one subdomain)
 * must have one owner, so that @f$B D^{-1} B^T@f$ is block diagonal over ranks.
 */
class RowLayout
{
public:
  /// Place of an entry of B in a subdomain: global row (offset of the owner + index), unknown.
  struct Entry
  {
    unsigned int global_row;
    unsigned int dof;
  };

  /// An unknown: global subdomain and number in the subdomain.
  struct Unknown
  {
    unsigned int subdomain;
    unsigned int dof;

    bool operator<(const Unknown &other) const
    {
      return std::tie(subdomain, dof) < std::tie(other.subdomain, other.dof);
    }
  };

  /// Messages from this rank to other ranks.
  struct Sent
  {
    unsigned int  neighbours = 0; ///< ranks to which it sends
    unsigned int  messages   = 0;
    unsigned long numbers    = 0;
  };

  /**
   * Set up the communication between owned rows, local rows and entries. Collective.
   * @param[in] contact_rows flag of each owned row of contact, normal or tangential.
   * @param[in] entries of each subdomain of this rank.
   * @param[in] first_subdomain global id of the first subdomain of this rank.
   * @param[in] tie_rows flag of each owned row of tied pairs and reference points; empty: there are
   *   none.
   */
  RowLayout(MPI_Comm                               communicator,
            const qp::RowSet                      &contact_rows,
            const std::vector<std::vector<Entry>> &entries,
            unsigned int                           first_subdomain,
            const qp::RowSet                      &tie_rows = {});

  MPI_Comm          communicator() const { return comm; }
  unsigned int      n_owned() const { return narrow<unsigned int>(is_contact.size()); }
  unsigned int      n_local() const { return narrow<unsigned int>(local_rows.size()); }
  const qp::RowSet &contact_rows() const { return is_contact; }
  /// Return flags of the equality rows of tied pairs and reference points, which glue no copies of
  /// a node and hold none.
  const qp::RowSet &tie_rows() const { return is_tie; }
  /// Return the global row of an owned row.
  unsigned int global_row(unsigned int owned_row) const { return first_owned + owned_row; }
  unsigned int global_row_of_local(unsigned int local_row) const { return local_rows[local_row]; }
  /// Return the local row of a global row. An entry of this rank's subdomains must touch the row.
  unsigned int local_row(unsigned int global_row) const;

  /// Return local values, taken from the owned values. Collective.
  qp::MultiVector to_local(const qp::MultiVector &owned) const;
  /// Return owned values as sums of the local values of all ranks. Collective.
  qp::MultiVector to_owned(const qp::MultiVector &local) const;

  /// Return what this rank sends for to_local() and to_owned() of one column, as for a product
  /// with F, to other ranks.
  Sent sent() const;

  /**
   * Send @p width numbers per entry of B to the owner of the entry's row. @p values are ordered
   * subdomain by subdomain, as the entries of the constructor. The owner receives the numbers row
   * by row, sorted by subdomain and unknown. Collective.
   */
  std::vector<double> gather_entries(unsigned int width, const std::vector<double> &values) const;
  /// Return the first gathered entry of each owned row; n_owned + 1 numbers.
  const std::vector<unsigned int> &entry_start() const { return start; }
  /// Return the unknown of each gathered entry.
  const std::vector<Unknown> &entry_unknowns() const { return unknowns; }

private:
  void sort_local_rows(const std::vector<unsigned int> &first_row_of_rank);

  /// Gather the values of the entries, rank by rank. The @p n_per_entry values of an entry are one
  /// item of the MPI type @p of_entry.
  template <typename T>
  std::vector<T> gather_unsorted(MPI_Datatype          of_entry,
                                 unsigned int          n_per_entry,
                                 const std::vector<T> &values) const;

  MPI_Comm                  comm;
  qp::RowSet                is_contact, is_tie;
  unsigned int              first_owned;  ///< first owned row, as a global row
  std::vector<unsigned int> local_rows;   ///< global rows: equality rows, then contact rows
  unsigned int              n_equalities; ///< number of local equality rows
  petsc::StarForest         row_forest, entry_forest;
  std::vector<unsigned int> start;
  std::vector<unsigned int> order; ///< sorted order of the gathered entries
  std::vector<Unknown>      unknowns;
};
} // namespace snug::feti

#endif
