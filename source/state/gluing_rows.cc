#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/state/gluing_rows.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::state {
template <int dim>
struct GluingRows<dim>::Message
{
  unsigned int            subdomain, node;
  unsigned int            owner, row; ///< rank, and number among its rows
  Source                  source = Source::constant;
  unsigned int            index = 0, item = 0;
  std::array<double, dim> factor{};

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & subdomain & node & owner & row & source & index & item & factor;
  }
};

namespace {
/// Return the rank that owns the equality rows of each node that ties or springs couple with other
/// nodes, by global node: the owner of the first of all coupled nodes. B D^-1 B' of the equality
/// rows is then block diagonal over ranks.
template <int dim>
std::map<unsigned int, unsigned int> ranks_of_tied_nodes(const mesh::BodyMesh<dim>  &mesh,
                                                         const mesh::Surface<dim>   &surface,
                                                         const RowCoefficients<dim> &reference)
{
  std::map<unsigned int, unsigned int> root;
  const auto                           find = [&](unsigned int node) {
    while (root.at(node) != node)
      node = root.at(node) = root.at(root.at(node));
    return node;
  };
  const auto join = [&](const unsigned int a, const unsigned int b) {
    root.emplace(a, a);
    root.emplace(b, b);
    const unsigned int of_a = find(a), of_b = find(b);
    root[std::max(of_a, of_b)] = std::min(of_a, of_b);
  };
  for (const auto *rows : {&reference.ties, &reference.followers})
    for (const auto &row : *rows)
      for (const auto &c : row.coefficients)
        join(surface.global_node(row.coefficients.front().first), surface.global_node(c.first));
  for (const auto &row : reference.springs)
    for (const auto &c : row.coefficients)
      join(row.coefficients.front().first, c.first);
  std::map<unsigned int, unsigned int> ranks;
  for (const auto &node : root)
    ranks[node.first] = mesh.owner_of_global(find(node.first));
  return ranks;
}
} // namespace

template <int dim>
GluingRows<dim>::GluingRows(const mesh::BodyMesh<dim>                 &mesh,
                            const mesh::Tearing                       &tearing,
                            const mesh::Surface<dim>                  &surface,
                            const supports::DirichletConstraints<dim> &held,
                            const RowCoefficients<dim>                &reference,
                            const std::vector<contact::Tangent>       &tangents,
                            const Model<dim>                          &model,
                            const unsigned int                         load_case)
  : mesh(mesh), surface(surface), held(held)
{
  // The order matters, because scales need the copies of the surface nodes, and the numbers of
  // contact rows come after those of gluing and supports on the same rank.
  n_bounded = narrow<unsigned int>(reference.contact.size() + reference.tangents.size());
  collect_surface(tearing);
  scale_rows(reference, tangents, largest_modulus(model));
  ranks_of_tied              = ranks_of_tied_nodes(mesh, surface, reference);
  const auto           nodes = collect_copies(tearing);
  std::vector<Message> messages;
  number_node_rows(nodes, reference, messages);
  n_rows_of_rank = all_gather(mesh.communicator(), narrow<unsigned int>(owned.size()));
  number_spring_rows(nodes, reference, messages);
  number_contact_rows(nodes, reference, tangents, tearing.n_global - tearing.n_points, messages);
  // Load cases hold different motions. Their rows come last, so that all other rows have the same
  // numbers in all load cases.
  number_held_motions(tearing, model, load_case, messages);
  send_entries(messages, tearing);
}

template <int dim>
void GluingRows<dim>::collect_surface(const mesh::Tearing &tearing)
{
  std::map<unsigned int, unsigned int> surface_of_global;
  for (unsigned int i = 0; i < surface.n_nodes(); ++i)
    {
      surface_of_global[surface.global_node(i)] = i;
      held_of_surface.push_back(held.find(surface.global_node(i)));
    }
  // Count the subdomains of all ranks that reach each surface node. No subdomain reaches hanging
  // nodes.
  copies.assign(surface.n_nodes(), 0);
  for (const auto &subdomain : tearing.subdomains)
    for (const unsigned int node : subdomain.nodes)
      {
        const auto found = surface_of_global.find(mesh.global_node(node));
        if (found != surface_of_global.end())
          ++copies[found->second];
      }
  MPI_Allreduce(MPI_IN_PLACE, copies.data(), copies.size(), MPI_UNSIGNED, MPI_SUM,
                mesh.communicator());
}

template <int dim>
unsigned int GluingRows<dim>::rank_of(const unsigned int node) const
{
  const auto tied = ranks_of_tied.find(node);
  return tied == ranks_of_tied.end() ? mesh.owner_of_global(node) : tied->second;
}

template <int dim>
typename GluingRows<dim>::Copies GluingRows<dim>::collect_copies(const mesh::Tearing &tearing) const
{
  // pairs (node, subdomain) for the rank that owns the equality rows of the node
  std::map<unsigned int, std::vector<unsigned int>> out;
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    for (const unsigned int local : tearing.subdomains[s].nodes)
      {
        const unsigned int node   = mesh.global_node(local);
        auto              &buffer = out[rank_of(node)];
        buffer.insert(buffer.end(), {node, tearing.first_id + s});
      }
  Copies nodes;
  for (const auto &message : dealii::Utilities::MPI::some_to_some(mesh.communicator(), out))
    for (std::size_t i = 0; i < message.second.size(); i += 2)
      nodes[message.second[i]].push_back(message.second[i + 1]);
  // Sort, because messages come rank by rank. In ascending order the Helmert rows of a node depend
  // on the numbers of its subdomains alone.
  for (auto &node : nodes)
    std::sort(node.second.begin(), node.second.end());
  return nodes;
}

/// Return an entry of the owned row that is numbered next.
template <int dim>
typename GluingRows<dim>::Message GluingRows<dim>::entry_of_owned_row(const unsigned int subdomain,
                                                                      const unsigned int node) const
{
  return {subdomain, node, dealii::Utilities::MPI::this_mpi_process(mesh.communicator()),
          narrow<unsigned int>(owned.size())};
}

template <int dim>
void GluingRows<dim>::number_node_rows(const Copies               &nodes,
                                       const RowCoefficients<dim> &reference,
                                       std::vector<Message>       &messages)
{
  for (const auto &entry : nodes)
    {
      const unsigned int node       = entry.first;
      const auto        &subdomains = entry.second;
      const unsigned int m          = subdomains.size();
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 1; i < m; ++i)
          {
            // Helmert row i is the mean of the first i copies against copy i. Rows of differences
            // of pairs would glue the copies as well but are not orthogonal to each other.
            const double norm = std::sqrt(i * (i + 1.));
            for (unsigned int j = 0; j <= i; ++j)
              {
                messages.push_back(entry_of_owned_row(subdomains[j], node));
                messages.back().factor[c] = (j < i ? 1. : -1. * i) / norm;
              }
            // Copies are equal, so the right-hand side is 0.
            owned.push_back({Source::constant, 0, 0, 0.});
          }
      const unsigned int h = held.find(node);
      if (h == held.n_nodes())
        continue;
      // One row holds the sum of the copies instead of each copy. With the gluing the effect is the
      // same, and the rows stay orthonormal.
      const auto directions = reference.held.directions(h);
      for (unsigned int k = 0; k < directions.size(); ++k)
        {
          for (const unsigned int subdomain : subdomains)
            {
              messages.push_back(entry_of_owned_row(subdomain, node));
              Message &message = messages.back();
              // A direction that follows the design has entries for all components, also where it
              // is zero at the reference geometry, because another design may rotate it.
              message.source = held.follows_positions(h) ? Source::held : Source::constant;
              message.index  = h;
              message.item   = k;
              for (unsigned int c = 0; c < dim; ++c)
                message.factor[c] =
                  (held.follows_positions(h) ? 1. : directions[k][c]) / std::sqrt(double(m));
            }
          owned.push_back({Source::held, h, k, std::sqrt(double(m))});
        }
    }
}

/// Return the place of the next row of a spring, a contact or a tie. All ranks number these rows
/// alike, because rank_of() a node sends the entries at its copies, whichever rank owns the row.
template <int dim>
typename GluingRows<dim>::Message GluingRows<dim>::next_row(const unsigned int owner, OwnedRow row)
{
  Message message{0, 0, owner, n_rows_of_rank[owner]++};
  message.source = row.source;
  message.index  = row.index;
  if (owner == dealii::Utilities::MPI::this_mpi_process(mesh.communicator()))
    owned.push_back(row);
  return message;
}

/// Add the entries of coefficient @p item of a row at the copies of a node of this rank.
template <int dim>
void GluingRows<dim>::add_copies(const Copies         &nodes,
                                 const unsigned int    node,
                                 const unsigned int    item,
                                 const double          scale,
                                 Message               message,
                                 std::vector<Message> &messages) const
{
  const auto found = nodes.find(node);
  if (found == nodes.end())
    return;
  message.node = node;
  message.item = item;
  // The factor is 1 / (nr m). It is multiplied by the coefficient when B is filled.
  message.factor.fill(1. / (scale * static_cast<double>(found->second.size())));
  for (const unsigned int subdomain : found->second)
    {
      message.subdomain = subdomain;
      messages.push_back(message);
    }
}

template <int dim>
void GluingRows<dim>::number_contact_rows(const Copies                        &nodes,
                                          const RowCoefficients<dim>          &reference,
                                          const std::vector<contact::Tangent> &tangents,
                                          const unsigned int                   first_point,
                                          std::vector<Message>                &messages)
{
  auto               on_point  = reference.points.begin(); // entries of row i
  const unsigned int n_contact = narrow<unsigned int>(reference.contact.size());
  for (unsigned int i = 0; i < reference.n_rows(); ++i)
    {
      const auto &coefficients = reference.row(i).coefficients;
      while (on_point != reference.points.end() && on_point->row < i)
        ++on_point;
      // A vanished row would be a zero row of B, so StateProblem checks its gap instead.
      if (scales[i] == 0.)
        continue;
      // The first node determines the owner. Friction cones need the rows of a contact on one rank.
      const bool  is_tangent = i >= n_contact && i < n_bounded;
      const auto &first = reference.row(is_tangent ? tangents[i - n_contact].row : i).coefficients;
      const unsigned int owner   = rank_of(surface.global_node(first.front().first));
      const auto         message = next_row(owner, {Source::contact, i, 0, 1. / scales[i]});
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        add_copies(nodes, surface.global_node(coefficients[k].first), k, scales[i], message,
                   messages);
      if (owner != dealii::Utilities::MPI::this_mpi_process(mesh.communicator()))
        continue;
      const unsigned int n_unknowns = mesh.idealization().n_rigid_motions();
      for (auto p = on_point; p != reference.points.end() && p->row == i; ++p)
        for (unsigned int k = 0; k < n_unknowns; ++k)
          {
            const auto index = narrow<unsigned int>(p - reference.points.begin());
            messages.push_back(
              {first_point + p->point, 0, owner, message.row, Source::point, index, k});
            messages.back().factor[0] = 1. / scales[i];
          }
    }
}

/// Number the rows of springs, which have an own unknown of the ground without copies. A row is not
/// projected off the held directions, because a spring need not be independent of the supports.
template <int dim>
void GluingRows<dim>::number_spring_rows(const Copies               &nodes,
                                         const RowCoefficients<dim> &reference,
                                         std::vector<Message>       &messages)
{
  std::vector<double> squares(reference.springs.size(), 0.);
  for (unsigned int i = 0; i < squares.size(); ++i)
    for (const auto &[node, c] : reference.springs[i].coefficients)
      if (const auto found = nodes.find(node); found != nodes.end())
        squares[i] += c.norm_square() / static_cast<double>(found->second.size());
  dealii::Utilities::MPI::sum(squares, mesh.communicator(), squares);
  for (unsigned int i = 0; i < squares.size(); ++i)
    {
      const auto &coefficients = reference.springs[i].coefficients;
      spring_scales.push_back(std::sqrt(squares[i]) * reference.springs[i].scale);
      const auto message = next_row(rank_of(coefficients.front().first),
                                    {Source::spring, i, 0, 1. / spring_scales[i]});
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        add_copies(nodes, coefficients[k].first, k, spring_scales[i], message, messages);
    }
}

/// Number the rows that hold motions of reference points. The last rank, which has the subdomains
/// of the points, owns them.
template <int dim>
void GluingRows<dim>::number_held_motions(const mesh::Tearing  &tearing,
                                          const Model<dim>     &model,
                                          const unsigned int    load_case,
                                          std::vector<Message> &messages)
{
  const auto &points = model.load_cases[load_case].points;
  for (unsigned int p = 0; p < points.size(); ++p)
    for (unsigned int k = 0; k < points[p].held.size(); ++k)
      if (points[p].held[k])
        held_motions.push_back({p, k});
  const MPI_Comm comm = mesh.communicator();
  if (dealii::Utilities::MPI::this_mpi_process(comm) + 1 !=
      dealii::Utilities::MPI::n_mpi_processes(comm))
    return;
  for (unsigned int i = 0; i < held_motions.size(); ++i)
    {
      const auto [p, k] = held_motions[i];
      Message message   = entry_of_owned_row(tearing.n_global - tearing.n_points + p, 0);
      message.item      = k;
      message.factor[0] = 1.;
      messages.push_back(message);
      owned.push_back({Source::point, i, 0, k < dim ? 1. : model.points[p].length});
    }
}

template <int dim>
void GluingRows<dim>::send_entries(const std::vector<Message> &messages,
                                   const mesh::Tearing        &tearing)
{
  const MPI_Comm comm = mesh.communicator();
  // Owned rows are numbered from 0. In the global numbers, the rows of lower ranks come first.
  const auto first_row =
    feti::RowExchange::first_of_ranks(comm, narrow<unsigned int>(owned.size()));
  n_global = first_row.back();

  std::map<unsigned int, std::vector<Message>> out;
  const auto                                  &first = tearing.first_id_of_rank;
  for (Message message : messages)
    {
      message.row += first_row[message.owner];
      const unsigned int rank =
        // A rank without subdomains has the first id of the next rank, so the last of equal ids
        // counts.
        std::upper_bound(first.begin(), first.end(), message.subdomain) - first.begin() - 1;
      out[rank].push_back(message);
    }
  std::vector<std::vector<feti::RowLayout::Entry>> layout_entries(tearing.subdomains.size());
  entries.resize(tearing.subdomains.size());
  for (const auto &received : dealii::Utilities::MPI::some_to_some(comm, out))
    for (const Message &message : received.second)
      {
        const unsigned int s     = message.subdomain - tearing.first_id;
        const auto        &nodes = tearing.subdomains[s].nodes;
        if (nodes.empty()) // a reference point
          {
            layout_entries[s].push_back({message.row, message.item});
            entries[s].push_back({message.row, message.item, message.factor[0], message.source,
                                  message.index, message.item});
            continue;
          }
        const unsigned int slot =
          std::lower_bound(nodes.begin(), nodes.end(), mesh.local_node(message.node)) -
          nodes.begin();
        for (unsigned int c = 0; c < dim; ++c)
          {
            // Skip components that the row does not have, see number_node_rows().
            if (message.factor[c] == 0.)
              continue;
            layout_entries[s].push_back({message.row, dim * slot + c});
            entries[s].push_back({message.row, dim * slot + c, message.factor[c], message.source,
                                  message.index, message.item});
          }
      }
  qp::RowSet bounded, tied;
  for (const OwnedRow &row : owned)
    {
      // lambda_i >= 0 for contact, while multipliers of gluing, ties and supports have any sign.
      bounded.push_back(row.source == Source::contact && row.index < n_bounded);
      tied.push_back(row.source == Source::point || row.source == Source::spring ||
                     (row.source == Source::contact && row.index >= n_bounded));
    }
  layout = std::make_unique<feti::RowLayout>(comm, bounded, layout_entries, tearing.first_id, tied);
  for (auto &of_subdomain : entries)
    for (Entry &entry : of_subdomain)
      // local_row is global until here: local rows are known once the layout has all entries.
      entry.local_row = layout->local_row(entry.local_row);
}

template class GluingRows<2>;
template class GluingRows<3>;
} // namespace snug::state
