#ifndef snug_state_gluing_rows_h
#define snug_state_gluing_rows_h

#include <snug/contact/contact.h>
#include <snug/feti/row_layout.h>
#include <snug/feti/subdomain_system.h>
#include <snug/mesh/tearing.h>
#include <snug/state/springs.h>
#include <snug/supports/dirichlet_constraints.h>

#include <array>
#include <map>
#include <memory>

namespace snug::state {
/// Entries of a row on the motion of a reference point, or their derivatives, see ReferencePoints.
struct PointEntries
{
  unsigned int          row, point; ///< RowCoefficients::row()
  std::array<double, 6> values;     ///< of the unknowns of the motion
};

/// Data of the rows of B at a geometry, or the derivative of these data, where empty frames are
/// zero.
template <int dim>
struct RowCoefficients
{
  std::vector<contact::Row<dim>>  contact;
  std::vector<contact::Row<dim>>  tangents; ///< tangential rows of contacts
  supports::ConstraintFrames<dim> held;     ///< per held node
  std::vector<SpringRow<dim>>     springs   = {};
  std::vector<contact::Row<dim>>  ties      = {}; ///< rows of tied pairs
  std::vector<contact::Row<dim>>  followers = {}; ///< rows of faces that follow reference points
  std::vector<PointEntries>       points    = {}; ///< ascending by row

  /// @name Normal rows, then tangential rows, then rows of ties, then rows of followers
  /// @{
  unsigned int n_rows() const
  {
    return static_cast<unsigned int>(contact.size() + tangents.size() + ties.size() +
                                     followers.size());
  }
  const contact::Row<dim> &row(unsigned int i) const
  {
    for (const auto *rows : {&contact, &tangents, &ties})
      if (i < rows->size())
        return (*rows)[i];
      else
        i -= static_cast<unsigned int>(rows->size());
    return followers[i];
  }
  /// @}
};

/**
 * This class is the topology of Gluing: the owner of each row of B, and the copies of nodes that
 * the row joins. The copies of each node meet on the rank that owns its equality rows, which
 * sends the entries of all rows at these copies to the subdomains.
 */
template <int dim>
class GluingRows
{
public:
  /// Quantity that the value of an entry follows.
  enum class Source : unsigned int
  {
    constant, ///< no quantity
    contact,  ///< coefficient `item` of RowCoefficients::row(`index`), also of ties
    spring,   ///< coefficient `item` of RowCoefficients::springs[`index`]
    held,     ///< direction `item` of held node `index`
    /// entry `item` of RowCoefficients::points[`index`]; of a row: its support, see held_motions
    point
  };

  struct Entry
  {
    unsigned int local_row, dof;
    double       factor; ///< the value of constant entries
    Source       source;
    unsigned int index, item;
  };

  /// Meaning of an owned row, in the terms of Entry.
  struct OwnedRow
  {
    Source       source;
    unsigned int index, item;
    double       factor; ///< factor of the right-hand side
  };

  /// An unknown of the motion of a reference point that a load case holds.
  struct HeldMotion
  {
    unsigned int point, unknown;
  };

  /// Build the rows; see Gluing. Collective.
  GluingRows(const mesh::BodyMesh<dim>                 &mesh,
             const mesh::Tearing                       &tearing,
             const mesh::Surface<dim>                  &surface,
             const supports::DirichletConstraints<dim> &held,
             const RowCoefficients<dim>                &reference,
             const std::vector<contact::Tangent>       &tangents,
             const Model<dim>                          &model,
             unsigned int                               load_case);

  /// Return the part of a coefficient at a surface node that remains after projecting it off the
  /// directions held there.
  dealii::Tensor<1, dim> projected(unsigned int                           surface_node,
                                   const dealii::Tensor<1, dim>          &coefficient,
                                   const supports::ConstraintFrames<dim> &frames) const;

  /// Return the gap of row @p i in a load case, minus the part that the displacements held at its
  /// nodes take [length].
  double gap(unsigned int i, const RowCoefficients<dim> &rows, unsigned int load_case) const;

  std::unique_ptr<feti::RowLayout> layout;
  std::vector<std::vector<Entry>>  entries; ///< per subdomain
  std::vector<OwnedRow>            owned;
  /// nr per RowCoefficients::row(), or 0 if the row is left out
  std::vector<double> scales;
  std::vector<double> spring_scales; ///< nr per RowCoefficients::springs
  /// Stiffness of the bodies [force / length] at the tangential rows that are held
  /// (contact::Tangent) and displaced, by RowCoefficients::row().
  std::map<unsigned int, double> held_tangents;
  std::vector<HeldMotion>        held_motions; ///< of all ranks
  std::vector<unsigned int>      copies;       ///< per surface node
  /// held node of each surface node, or held.n_nodes()
  std::vector<unsigned int> held_of_surface;
  unsigned int              n_global  = 0;
  unsigned int              n_bounded = 0; ///< number of normal and tangential rows

private:
  /// Subdomains of the copies of a node, ascending, by global node. Only rank_of() the node
  /// knows them.
  using Copies = std::map<unsigned int, std::vector<unsigned int>>;

  /// An entry that the owner of a row sends to a subdomain.
  struct Message;

  void   collect_surface(const mesh::Tearing &tearing);
  void   scale_rows(const RowCoefficients<dim>          &reference,
                    const std::vector<contact::Tangent> &tangents,
                    double                               modulus);
  void   drop_dependent_ties(const RowCoefficients<dim> &reference);
  bool   is_displaced(unsigned int i, const RowCoefficients<dim> &reference) const;
  double stiffness_at(unsigned int surface_node, double modulus) const;
  Copies collect_copies(const mesh::Tearing &tearing) const;
  /// Return the rank that owns the equality rows of a global node.
  unsigned int rank_of(unsigned int node) const;
  Message      entry_of_owned_row(unsigned int subdomain, unsigned int node) const;
  void         number_node_rows(const Copies               &nodes,
                                const RowCoefficients<dim> &reference,
                                std::vector<Message>       &messages);
  Message      next_row(unsigned int owner, OwnedRow row);
  void         add_copies(const Copies         &nodes,
                          unsigned int          node,
                          unsigned int          item,
                          double                scale,
                          Message               message,
                          std::vector<Message> &messages) const;
  void         number_contact_rows(const Copies                        &nodes,
                                   const RowCoefficients<dim>          &reference,
                                   const std::vector<contact::Tangent> &tangents,
                                   unsigned int                         first_point,
                                   std::vector<Message>                &messages);
  void         number_spring_rows(const Copies               &nodes,
                                  const RowCoefficients<dim> &reference,
                                  std::vector<Message>       &messages);
  void         number_held_motions(const mesh::Tearing  &tearing,
                                   const Model<dim>     &model,
                                   unsigned int          load_case,
                                   std::vector<Message> &messages);
  void         send_entries(const std::vector<Message> &messages, const mesh::Tearing &tearing);

  const mesh::BodyMesh<dim>                 &mesh;
  const mesh::Surface<dim>                  &surface;
  const supports::DirichletConstraints<dim> &held;
  std::map<unsigned int, unsigned int>       ranks_of_tied;  ///< of nodes with ties, by global node
  std::vector<unsigned int>                  n_rows_of_rank; ///< numbered so far
};
} // namespace snug::state

#endif
