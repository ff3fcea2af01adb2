#ifndef snug_feti_row_layout_h
#define snug_feti_row_layout_h

#include <snug/base/narrow.h>
#include <snug/base/petsc_handle.h>
#include <snug/qp/dual_problem.h>

#include <tuple>

namespace snug::feti {
/// This class exchanges values of rows between their owners and the ranks that use the rows.
/// Global rows are numbered rank by rank.
class RowExchange
{
public:
  RowExchange() = default;

  /// Prepare the exchange of the global @p rows, which this rank uses. @p first_of_rank holds the
  /// first row of each rank and the number of rows. Collective.
  RowExchange(MPI_Comm                         communicator,
              const std::vector<unsigned int> &first_of_rank,
              const std::vector<unsigned int> &rows);

  /// Return the numbers of @p n_owned rows per rank as @p first_of_rank of the constructor.
  /// Collective.
  static std::vector<unsigned int> first_of_ranks(MPI_Comm communicator, unsigned int n_owned);

  /// Return the values of the rows that this rank uses, taken from the owned values. Collective.
  qp::MultiVector to_local(const qp::MultiVector &owned) const;
  /// Return owned values as sums of the local values of all ranks. Collective.
  qp::MultiVector to_owned(const qp::MultiVector &local) const;

  PetscSF forest() const { return star_forest; }

private:
  unsigned int      n_owned = 0, n_local = 0;
  petsc::StarForest star_forest;
};

/**
 * This class describes the distribution of the rows of B over ranks. Each row is owned by one rank.
 * The local rows of a rank are those with an entry in one of its subdomains: first the equality
 * rows, then the contact rows, each in the order of the global rows. Layouts with equal equality
 * rows thus number these rows equally.
 *
 * Node rows are the equality rows that glue the copies of one node or hold it. Ties are the other
 * equality rows: those of tied pairs, reference points and springs. Equality rows that share an
 * unknown (one copy of it in one subdomain) must have one owner. Contact rows may have any owner,
 * except that the rows of the contacts of one node have one.
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
   * @param[in] ties flag of each owned row that is a tie; empty: there are none.
   */
  RowLayout(MPI_Comm                               communicator,
            const qp::RowSet                      &contact_rows,
            const std::vector<std::vector<Entry>> &entries,
            unsigned int                           first_subdomain,
            const qp::RowSet                      &ties = {});

  MPI_Comm          communicator() const { return comm; }
  unsigned int      n_owned() const { return narrow<unsigned int>(is_contact.size()); }
  unsigned int      n_local() const { return narrow<unsigned int>(local_rows.size()); }
  const qp::RowSet &contact_rows() const { return is_contact; }
  /// Return flags of the node rows.
  const qp::RowSet &node_rows() const { return is_node_row; }
  /// Return the first row of each rank, as a global row, and the number of rows.
  const std::vector<unsigned int> &first_of_rank() const { return first; }
  /// Return the global row of an owned row.
  unsigned int global_row(unsigned int owned_row) const { return first_owned + owned_row; }
  unsigned int global_row_of_local(unsigned int local_row) const { return local_rows[local_row]; }
  /// Return the local row of a global row. An entry of this rank's subdomains must touch the row.
  unsigned int local_row(unsigned int global_row) const;

  /// Return local values, taken from the owned values. Collective.
  qp::MultiVector to_local(const qp::MultiVector &owned) const { return exchange.to_local(owned); }
  /// Return owned values as sums of the local values of all ranks. Collective.
  qp::MultiVector to_owned(const qp::MultiVector &local) const { return exchange.to_owned(local); }

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
  void sort_local_rows();

  /// Gather the values of the entries, rank by rank. The @p n_per_entry values of an entry are one
  /// item of the MPI type @p of_entry.
  template <typename T>
  std::vector<T> gather_unsorted(MPI_Datatype          of_entry,
                                 unsigned int          n_per_entry,
                                 const std::vector<T> &values) const;

  MPI_Comm                  comm;
  qp::RowSet                is_contact, is_node_row;
  std::vector<unsigned int> first;
  unsigned int              first_owned;  ///< first owned row, as a global row
  std::vector<unsigned int> local_rows;   ///< global rows: equality rows, then contact rows
  unsigned int              n_equalities; ///< number of local equality rows
  RowExchange               exchange;     ///< of the local rows
  petsc::StarForest         entry_forest;
  std::vector<unsigned int> start;
  std::vector<unsigned int> order; ///< sorted order of the gathered entries
  std::vector<Unknown>      unknowns;
};
} // namespace snug::feti

#endif
