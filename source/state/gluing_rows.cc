#include <snug/base/disjoint_sets.h>
#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/state/gluing_rows.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace snug::state {
template <int dim>
struct GluingRows<dim>::Message
{
  unsigned int            subdomain, node, row;
  Source                  source = Source::constant;
  unsigned int            index = 0, item = 0;
  std::array<double, dim> factor{};

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & subdomain & node & row & source & index & item & factor;
  }
};

template <int dim>
std::vector<unsigned int> contact_clusters(const unsigned int                       n_nodes,
                                           const std::vector<RowCoefficients<dim>> &positions)
{
  DisjointSets clusters(n_nodes);
  for (const auto &rows : positions)
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (const auto &c : rows.row(i).coefficients)
        clusters.join(rows.row(i).coefficients.front().first, c.first);
  std::vector<unsigned int> root(n_nodes);
  for (unsigned int node = 0; node < n_nodes; ++node)
    root[node] = clusters.find(node);
  return root;
}

namespace {
/// Return the rank that owns the rows of each node of contact surfaces and of springs that join
/// several nodes, by global node. The first node of a cluster determines the rank. Nodes that a
/// spring joins are in one cluster.
template <int dim>
std::map<unsigned int, unsigned int> ranks_of_nodes(const mesh::BodyMesh<dim>         &mesh,
                                                    const mesh::Surface<dim>          &surface,
                                                    const std::vector<unsigned int>   &clusters,
                                                    const std::vector<SpringRow<dim>> &springs)
{
  std::map<unsigned int, unsigned int> root;
  for (unsigned int i = 0; i < surface.n_nodes(); ++i)
    root[surface.global_node(i)] = surface.global_node(clusters[i]);
  const auto find = [&](unsigned int node) {
    while (root.at(node) != node)
      node = root.at(node);
    return node;
  };
  for (const auto &row : springs)
    for (unsigned int k = 1; k < row.coefficients.size(); ++k)
      {
        for (const auto &[node, c] : row.coefficients)
          root.emplace(node, node);
        const unsigned int a = find(row.coefficients[0].first), b = find(row.coefficients[k].first);
        root[std::max(a, b)] = std::min(a, b);
      }
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
                            const std::vector<unsigned int>           &clusters,
                            const Model<dim>                          &model,
                            const unsigned int                         load_case)
  : mesh(mesh), surface(surface), held(held)
{
  // The order matters, because scales need the copies of the surface nodes, and the numbers of
  // contact rows come after those of gluing and supports on the same rank.
  n_bounded = narrow<unsigned int>(reference.contact.size() + reference.tangents.size());
  collect_surface(tearing);
  scale_rows(reference, tangents, largest_modulus(model));
  // The rank of the first node of a cluster owns all rows at the nodes of the cluster, so that
  // B D^-1 B' is block diagonal over ranks.
  const auto           ranks = ranks_of_nodes(mesh, surface, clusters, reference.springs);
  const auto           nodes = collect_copies(tearing, ranks);
  std::vector<Message> messages;
  number_node_rows(nodes, reference, messages);
  number_spring_rows(nodes, reference, messages);
  number_contact_rows(nodes, reference, ranks, tearing.n_global - tearing.n_points, messages);
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
typename GluingRows<dim>::Copies
GluingRows<dim>::collect_copies(const mesh::Tearing                        &tearing,
                                const std::map<unsigned int, unsigned int> &special) const
{
  // Nodes of contact surfaces go to the rank of their cluster, and all other nodes go to their
  // owner.
  // pairs (node, subdomain) for the rank that owns the rows of the node
  std::map<unsigned int, std::vector<unsigned int>> out;
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    for (const unsigned int local : tearing.subdomains[s].nodes)
      {
        const unsigned int node   = mesh.global_node(local);
        const auto         found  = special.find(node);
        auto              &buffer = out[found == special.end() ? mesh.owner(local) : found->second];
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
                messages.push_back({subdomains[j], node, narrow<unsigned int>(owned.size())});
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
              messages.push_back({subdomain, node, narrow<unsigned int>(owned.size())});
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

template <int dim>
void GluingRows<dim>::number_contact_rows(const Copies                               &nodes,
                                          const RowCoefficients<dim>                 &reference,
                                          const std::map<unsigned int, unsigned int> &rank_of_node,
                                          const unsigned int                          first_point,
                                          std::vector<Message>                       &messages)
{
  auto               on_point = reference.points.begin(); // entries of row i
  const unsigned int my_rank  = dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
  for (unsigned int i = 0; i < reference.n_rows(); ++i)
    {
      const auto &coefficients = reference.row(i).coefficients;
      while (on_point != reference.points.end() && on_point->row < i)
        ++on_point;
      // A vanished row would be a zero row of B, so StateProblem checks its gap instead. All nodes
      // of a row are in one cluster, so the first node determines the owner.
      if (scales[i] == 0. ||
          rank_of_node.at(surface.global_node(coefficients.front().first)) != my_rank)
        continue;
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        {
          const unsigned int node       = surface.global_node(coefficients[k].first);
          const auto        &subdomains = nodes.at(node);
          for (const unsigned int subdomain : subdomains)
            {
              messages.push_back({subdomain, node, narrow<unsigned int>(owned.size())});
              Message &message = messages.back();
              message.source   = Source::contact;
              message.index    = i;
              message.item     = k;
              for (unsigned int c = 0; c < dim; ++c)
                // The factor is 1 / (nr m). It is multiplied by the coefficient when B is filled.
                message.factor[c] = 1. / (scales[i] * subdomains.size());
            }
        }
      const unsigned int n_unknowns = mesh.idealization().n_rigid_motions();
      for (auto p = on_point; p != reference.points.end() && p->row == i; ++p)
        for (unsigned int k = 0; k < n_unknowns; ++k)
          {
            const auto index = narrow<unsigned int>(p - reference.points.begin());
            messages.push_back({first_point + p->point, 0, narrow<unsigned int>(owned.size()),
                                Source::point, index, k});
            messages.back().factor[0] = 1. / scales[i];
          }
      owned.push_back({Source::contact, i, 0, 1. / scales[i]});
    }
}

/// Number the rows of springs, which have an own unknown of the ground without copies. The rank
/// with the copies of the nodes owns the row. A row is not projected off the held directions,
/// because a spring need not be independent of the supports.
template <int dim>
void GluingRows<dim>::number_spring_rows(const Copies               &nodes,
                                         const RowCoefficients<dim> &reference,
                                         std::vector<Message>       &messages)
{
  for (unsigned int i = 0; i < reference.springs.size(); ++i)
    {
      const auto &coefficients = reference.springs[i].coefficients;
      double      square       = 0.;
      for (const auto &[node, c] : coefficients)
        if (const auto found = nodes.find(node); found != nodes.end())
          square += c.norm_square() / static_cast<double>(found->second.size());
      spring_scales.push_back(std::sqrt(square) * reference.springs[i].scale);
      if (nodes.count(coefficients.front().first) == 0)
        continue;
      for (unsigned int k = 0; k < coefficients.size(); ++k)
        {
          const auto &subdomains = nodes.at(coefficients[k].first);
          for (const unsigned int subdomain : subdomains)
            {
              messages.push_back(
                {subdomain, coefficients[k].first, narrow<unsigned int>(owned.size())});
              Message &message = messages.back();
              message.source   = Source::spring;
              message.index    = i;
              message.item     = k;
              for (unsigned int c = 0; c < dim; ++c)
                message.factor[c] =
                  1. / (spring_scales[i] * static_cast<double>(subdomains.size()));
            }
        }
      owned.push_back({Source::spring, i, 0, 1. / spring_scales[i]});
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
      messages.push_back({tearing.n_global - tearing.n_points + p, 0,
                          narrow<unsigned int>(owned.size()), Source::constant, 0, k});
      messages.back().factor[0] = 1.;
      owned.push_back({Source::point, i, 0, k < dim ? 1. : model.points[p].length});
    }
}

template <int dim>
void GluingRows<dim>::send_entries(const std::vector<Message> &messages,
                                   const mesh::Tearing        &tearing)
{
  const MPI_Comm     comm    = mesh.communicator();
  const unsigned int my_rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const auto         counts  = all_gather(comm, static_cast<unsigned int>(owned.size()));
  // Owned rows are numbered from 0. In the global numbers, the rows of lower ranks come first.
  const unsigned int first_row = std::accumulate(counts.begin(), counts.begin() + my_rank, 0u);
  n_global                     = std::accumulate(counts.begin(), counts.end(), 0u);

  std::map<unsigned int, std::vector<Message>> out;
  const auto                                  &first = tearing.first_id_of_rank;
  for (Message message : messages)
    {
      message.row += first_row;
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
      tied.push_back(row.source == Source::point ||
                     (row.source == Source::contact && row.index >= n_bounded));
    }
  layout = std::make_unique<feti::RowLayout>(comm, bounded, layout_entries, tearing.first_id, tied);
  for (auto &of_subdomain : entries)
    for (Entry &entry : of_subdomain)
      // local_row is global until here: local rows are known once the layout has all entries.
      entry.local_row = layout->local_row(entry.local_row);
}

template std::vector<unsigned int> contact_clusters(unsigned int,
                                                    const std::vector<RowCoefficients<2>> &);
template std::vector<unsigned int> contact_clusters(unsigned int,
                                                    const std::vector<RowCoefficients<3>> &);
template class GluingRows<2>;
template class GluingRows<3>;
} // namespace snug::state
