#include <snug/state/gluing_rows.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace snug
{
  namespace state
  {
    template <int dim>
    struct GluingRows<dim>::Message
    {
      unsigned int           subdomain, node, row;
      unsigned int           contact, coefficient;
      dealii::Tensor<1, dim> value;

      static const unsigned int size = 5 + dim;

      void
      append_to(std::vector<double> &buffer) const
      {
        for (const unsigned int n :
             {subdomain, node, row, contact, coefficient})
          buffer.push_back(n);
        for (unsigned int c = 0; c < dim; ++c)
          buffer.push_back(value[c]);
      }

      explicit Message(const double *buffer)
        : subdomain(buffer[0])
        , node(buffer[1])
        , row(buffer[2])
        , contact(buffer[3])
        , coefficient(buffer[4])
      {
        for (unsigned int c = 0; c < dim; ++c)
          value[c] = buffer[5 + c];
      }

      Message() = default;
    };

    template <int dim>
    GluingRows<dim>::GluingRows(
      const mesh::BodyMesh<dim>            &mesh,
      const mesh::Tearing                  &tearing,
      const mesh::Surface<dim>             &surface,
      const std::vector<Support>           &supports,
      const std::vector<contact::Row<dim>> &reference_rows)
      : mesh(mesh), surface(surface)
    {
      collect_surface(tearing, supports);
      scale_rows(reference_rows);
      const auto           ranks = cluster_ranks(reference_rows);
      const auto           nodes = collect_copies(tearing, supports, ranks);
      std::vector<Message> messages;
      const qp::RowSet     bounded =
        number_rows(nodes, reference_rows, ranks, messages);
      deliver(messages, tearing, bounded);
    }

    template <int dim>
    dealii::Tensor<1, dim>
    GluingRows<dim>::projected(unsigned int                  surface_node,
                               const dealii::Tensor<1, dim> &coefficient) const
    {
      dealii::Tensor<1, dim> result = coefficient;
      for (const auto &direction : fixed_directions[surface_node])
        result -= (result * direction) * direction;
      return result;
    }

    template <int dim>
    void
    GluingRows<dim>::scale_rows(
      const std::vector<contact::Row<dim>> &reference_rows)
    {
      // a row whose projection is round-off of a unit normal has vanished
      const double vanishing = 1e-12;
      for (const auto &row : reference_rows)
        {
          double square = 0.;
          for (const auto &c : row.coefficients)
            square +=
              projected(c.first, c.second).norm_square() / copies[c.first];
          scales.push_back(square < vanishing ? 0. : std::sqrt(square));
        }
    }

    template <int dim>
    void
    GluingRows<dim>::collect_surface(const mesh::Tearing        &tearing,
                                     const std::vector<Support> &supports)
    {
      const unsigned int                   n = surface.n_nodes();
      std::map<unsigned int, unsigned int> surface_of_global;
      for (unsigned int i = 0; i < n; ++i)
        surface_of_global[surface.global_node(i)] = i;
      std::vector<unsigned int> flags(n * dim, 0);
      for (const auto &entry : fixed_components(mesh, supports))
        {
          const auto found =
            surface_of_global.find(mesh.global_node(entry.first));
          if (found != surface_of_global.end())
            for (unsigned int c = 0; c < dim; ++c)
              if (entry.second[c])
                flags[found->second * dim + c] = 1;
        }
      copies.assign(n, 0);
      for (const auto &subdomain : tearing.subdomains)
        for (const unsigned int node : subdomain.nodes)
          {
            const auto found = surface_of_global.find(mesh.global_node(node));
            if (found != surface_of_global.end())
              ++copies[found->second];
          }
      MPI_Allreduce(MPI_IN_PLACE,
                    flags.data(),
                    flags.size(),
                    MPI_UNSIGNED,
                    MPI_MAX,
                    mesh.communicator());
      MPI_Allreduce(MPI_IN_PLACE,
                    copies.data(),
                    copies.size(),
                    MPI_UNSIGNED,
                    MPI_SUM,
                    mesh.communicator());
      fixed_directions.resize(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          if (flags[i * dim + c])
            fixed_directions[i].push_back(axis<dim>(c));
    }

    template <int dim>
    std::vector<unsigned int>
    GluingRows<dim>::cluster_ranks(
      const std::vector<contact::Row<dim>> &contact_rows) const
    {
      // Contact rows that share nodes form clusters; the rank of a cluster's
      // first node owns all rows at its nodes, so that B D^-1 B' is block
      // diagonal over ranks.
      std::vector<unsigned int> root(surface.n_nodes());
      std::iota(root.begin(), root.end(), 0);
      const auto find = [&](unsigned int i) {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      };
      for (const auto &row : contact_rows)
        for (const auto &c : row.coefficients)
          {
            const unsigned int a = find(row.coefficients.front().first);
            const unsigned int b = find(c.first);
            root[std::max(a, b)] = std::min(a, b);
          }
      std::vector<unsigned int> ranks;
      for (unsigned int i = 0; i < surface.n_nodes(); ++i)
        ranks.push_back(mesh.owner_of_global(surface.global_node(find(i))));
      return ranks;
    }

    template <int dim>
    std::map<unsigned int, typename GluingRows<dim>::NodeCopies>
    GluingRows<dim>::collect_copies(
      const mesh::Tearing             &tearing,
      const std::vector<Support>      &supports,
      const std::vector<unsigned int> &rank_of_contact) const
    {
      std::map<unsigned int, unsigned int> special;
      for (unsigned int i = 0; i < surface.n_nodes(); ++i)
        special[surface.global_node(i)] = rank_of_contact[i];
      // to the rank that owns the node's rows: (node, subdomain, -1) for a
      // copy, (node, component, 1) for a support
      std::map<unsigned int, std::vector<unsigned int>> out;
      const auto send = [&](unsigned int local, unsigned int what, bool fixed) {
        const unsigned int node  = mesh.global_node(local);
        const auto         found = special.find(node);
        auto              &buffer =
          out[found == special.end() ? mesh.owner(local) : found->second];
        buffer.insert(buffer.end(), {node, what, fixed ? 1u : 0u});
      };
      for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
        for (const unsigned int node : tearing.subdomains[s].nodes)
          send(node, tearing.first_id + s, false);
      for (const auto &entry : fixed_components(mesh, supports))
        if (!mesh.is_hanging(entry.first))
          for (unsigned int c = 0; c < dim; ++c)
            if (entry.second[c])
              send(entry.first, c, true);

      std::map<unsigned int, NodeCopies>      nodes;
      std::map<unsigned int, FixedFlags<dim>> fixed;
      for (const auto &message :
           dealii::Utilities::MPI::some_to_some(mesh.communicator(), out))
        for (std::size_t i = 0; i < message.second.size(); i += 3)
          {
            const unsigned int node = message.second[i];
            const unsigned int what = message.second[i + 1];
            if (message.second[i + 2] == 1)
              fixed[node][what] = true;
            else
              nodes[node].subdomains.push_back(what);
          }
      for (auto &node : nodes)
        std::sort(node.second.subdomains.begin(), node.second.subdomains.end());
      for (const auto &entry : fixed)
        for (unsigned int c = 0; c < dim; ++c)
          if (entry.second[c])
            nodes.at(entry.first).fixed.push_back(axis<dim>(c));
      return nodes;
    }

    template <int dim>
    qp::RowSet
    GluingRows<dim>::number_rows(
      const std::map<unsigned int, NodeCopies> &nodes,
      const std::vector<contact::Row<dim>>     &reference_rows,
      const std::vector<unsigned int>          &rank_of_contact,
      std::vector<Message>                     &messages)
    {
      const unsigned int none = scales.size();
      qp::RowSet         bounded;
      const auto         add = [&](unsigned int                  subdomain,
                           unsigned int                  node,
                           const dealii::Tensor<1, dim> &value) {
        Message message;
        message.subdomain   = subdomain;
        message.node        = node;
        message.row         = bounded.size();
        message.contact     = none;
        message.coefficient = 0;
        message.value       = value;
        messages.push_back(message);
      };
      for (const auto &entry : nodes)
        {
          const auto        &subdomains = entry.second.subdomains;
          const unsigned int m          = subdomains.size();
          for (const auto &direction : entry.second.fixed)
            for (const unsigned int subdomain : subdomains)
              {
                add(subdomain, entry.first, direction);
                bounded.push_back(0);
              }
          for (const auto &direction : complement<dim>(entry.second.fixed))
            for (unsigned int i = 1; i < m; ++i)
              {
                const double norm = std::sqrt(i * (i + 1.));
                for (unsigned int j = 0; j < i; ++j)
                  add(subdomains[j], entry.first, direction / norm);
                add(subdomains[i], entry.first, -(i / norm) * direction);
                bounded.push_back(0);
              }
        }
      owned_contact.assign(bounded.size(), none);
      const unsigned int my_rank =
        dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
      for (unsigned int i = 0; i < reference_rows.size(); ++i)
        {
          const auto &coefficients = reference_rows[i].coefficients;
          if (scales[i] == 0. ||
              rank_of_contact[coefficients.front().first] != my_rank)
            continue;
          for (unsigned int k = 0; k < coefficients.size(); ++k)
            {
              const unsigned int node =
                surface.global_node(coefficients[k].first);
              for (const unsigned int subdomain : nodes.at(node).subdomains)
                {
                  add(subdomain, node, dealii::Tensor<1, dim>());
                  messages.back().contact     = i;
                  messages.back().coefficient = k;
                }
            }
          bounded.push_back(1);
          owned_contact.push_back(i);
        }
      return bounded;
    }

    template <int dim>
    void
    GluingRows<dim>::deliver(const std::vector<Message> &messages,
                             const mesh::Tearing        &tearing,
                             const qp::RowSet           &bounded)
    {
      const MPI_Comm     comm = mesh.communicator();
      const unsigned int my_rank =
        dealii::Utilities::MPI::this_mpi_process(comm);
      const auto counts = dealii::Utilities::MPI::all_gather(
        comm, static_cast<unsigned int>(bounded.size()));
      const unsigned int first_row =
        std::accumulate(counts.begin(), counts.begin() + my_rank, 0u);
      n_global = std::accumulate(counts.begin(), counts.end(), 0u);

      std::map<unsigned int, std::vector<double>> out;
      const auto &first = tearing.first_id_of_rank;
      for (Message message : messages)
        {
          message.row += first_row;
          const unsigned int rank =
            std::upper_bound(first.begin(), first.end(), message.subdomain) -
            first.begin() - 1;
          message.append_to(out[rank]);
        }
      std::vector<std::vector<feti::RowLayout::Entry>> layout_entries(
        tearing.subdomains.size());
      entries.resize(tearing.subdomains.size());
      for (const auto &received :
           dealii::Utilities::MPI::some_to_some(comm, out))
        for (std::size_t i = 0; i < received.second.size(); i += Message::size)
          {
            const Message      message(received.second.data() + i);
            const unsigned int s     = message.subdomain - tearing.first_id;
            const auto        &nodes = tearing.subdomains[s].nodes;
            const unsigned int slot =
              std::lower_bound(nodes.begin(),
                               nodes.end(),
                               mesh.local_node(message.node)) -
              nodes.begin();
            for (unsigned int c = 0; c < dim; ++c)
              {
                const bool follows = message.contact < scales.size();
                if (!follows && message.value[c] == 0.)
                  continue;
                layout_entries[s].push_back({message.row, dim * slot + c});
                entries[s].push_back({message.row,
                                      dim * slot + c,
                                      message.value[c],
                                      message.contact,
                                      message.coefficient});
              }
          }
      layout = std::make_unique<feti::RowLayout>(comm,
                                                 bounded,
                                                 layout_entries,
                                                 tearing.first_id);
      for (auto &of_subdomain : entries)
        for (Entry &entry : of_subdomain)
          entry.local_row = layout->local_row(entry.local_row);
    }

    template class GluingRows<2>;
    template class GluingRows<3>;
  } // namespace state
} // namespace snug
