#ifndef snug_feti_contact_nodes_h
#define snug_feti_contact_nodes_h

#include <snug/feti/coarse_space.h>

#include <boost/range/iterator_range.hpp>

#include <vector>

namespace snug::feti {
/// This struct lists the gathered entries of some rows of this rank by row and by unknown, without
/// the entries in the motions of rigid bodies, which would couple all rows of a body but have no
/// weight in W.
struct RowEntries
{
  /// Lists of entries, one after the other.
  struct Lists
  {
    auto operator[](unsigned int i) const
    {
      return boost::make_iterator_range(numbers.begin() + start[i], numbers.begin() + start[i + 1]);
    }
    std::vector<unsigned int> start{0}, numbers;
  };

  /// List the entries of the owned @p rows.
  RowEntries(const RowLayout &layout, const SubdomainTable &table, const qp::RowSet &rows);

  /// Return the place of an unknown in unknowns, or the number of unknowns.
  unsigned int place(const RowLayout::Unknown &unknown) const;

  std::vector<RowLayout::Unknown> unknowns; ///< of the entries, ascending
  std::vector<unsigned int>       row;      ///< owned row of each gathered entry
  std::vector<unsigned int>       unknown;  ///< place() of the unknown of each gathered entry
  Lists                           of_row;   ///< by owned row; empty for other rows
  Lists                           of_unknown;
};

/**
 * This struct lists the nodes at which the contact rows meet. The entries of contact rows at the
 * copies of a node are sent to the rank that owns the equality rows of these copies, or to the rank
 * of the subdomain where an unknown has no equality row. The lists belong to a pairing.
 */
struct ContactNodes
{
  /// Find the nodes of the rows of @p layout. Collective.
  ContactNodes(const RowLayout &layout, const SubdomainTable &table, const RowEntries &equalities);

  /// An entry of a row in one of the unknowns of a node.
  struct Entry
  {
    unsigned int row;     ///< owned equality row, or place among the contact rows of the nodes
    unsigned int unknown; ///< of the node
    unsigned int entry;   ///< gathered entry, or place among the received entries
  };

  /// Unknowns that node rows connect: the copies of a component of a node, or of all components.
  struct Node
  {
    unsigned int       n_unknowns;
    std::vector<Entry> of_node_rows, of_ties, of_contacts; ///< ascending by row
  };

  MPI_Comm          communicator;
  qp::RowSet        rows_of_contact; ///< flag of each owned row
  qp::RowSet        on_rigid;        ///< flag of each owned contact row on a rigid body
  bool              any;             ///< whether a rank has contact rows
  std::vector<Node> nodes;           ///< on this rank
  RowExchange       rows;            ///< of the contact rows of the nodes
  unsigned int      n_rows = 0;      ///< number of these rows
  /// exchange of the entries of contact rows, from the owners of the rows to the nodes
  RowExchange               entries;
  std::vector<unsigned int> sent; ///< gathered entries of the owned contact rows

private:
  /// An entry of a contact row on the way to its node.
  struct Met;

  static std::vector<Met> meet(const RowLayout        &layout,
                               const SubdomainTable   &table,
                               const RowEntries       &equalities,
                               const std::vector<Met> &mine);
  void                    add_node(const RowLayout                 &layout,
                                   const RowEntries                &equalities,
                                   const std::vector<Met>          &met,
                                   const std::vector<unsigned int> &global_rows,
                                   const RowLayout::Unknown        &first,
                                   std::vector<bool>               &visited);
};
} // namespace snug::feti

#endif
