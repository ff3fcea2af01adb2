#ifndef snug_tests_unit_feti_truss_h
#define snug_tests_unit_feti_truss_h

#include <snug/feti/dense.h>
#include <snug/feti/total_feti.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <sstream>

namespace snug
{
  namespace test
  {
    using Matrix = dealii::FullMatrix<double>;
    using Node   = std::vector<int>; ///< grid coordinates, 2 or 3

    /// A block of a pin-jointed truss: grid nodes first..last, bars to all
    /// neighbours of the same cell. Rigid but for its 3 or 6 motions.
    struct Block
    {
      unsigned int      body;
      Node              first, last;
      std::vector<Node> nodes;

      Block(unsigned int body, const Node &first, const Node &last);

      unsigned int
      slot(const Node &node) const;
    };

    inline Block::Block(unsigned int body, const Node &first, const Node &last)
      : body(body)
      , first(first)
      , last(last)
    {
      nodes = {first};
      for (unsigned int d = 0; d < first.size(); ++d)
        {
          const auto start = nodes;
          for (int i = first[d] + 1; i <= last[d]; ++i)
            for (auto node : start)
              {
                node[d] = i;
                nodes.push_back(node);
              }
        }
    }

    inline unsigned int
    Block::slot(const Node &node) const
    {
      return std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
    }

    /// Slightly bent positions, so that nothing is symmetric by chance.
    inline std::vector<double>
    position(const Node &node)
    {
      std::vector<double> x(node.begin(), node.end());
      for (unsigned int d = 0; d < x.size(); ++d)
        x[d] += 0.1 * std::sin(1.3 * node[0] + 0.7 * node[1] + d);
      return x;
    }

    inline Matrix
    dense_stiffness(const Block &block)
    {
      const unsigned int dim = block.first.size();
      Matrix             K(dim * block.nodes.size(), dim * block.nodes.size());
      for (unsigned int a = 0; a < block.nodes.size(); ++a)
        for (unsigned int b = 0; b < a; ++b)
          {
            bool same_cell = true;
            for (unsigned int d = 0; d < dim; ++d)
              same_cell = same_cell &&
                          std::abs(block.nodes[a][d] - block.nodes[b][d]) <= 1;
            if (!same_cell)
              continue;
            const auto x = position(block.nodes[a]);
            const auto y = position(block.nodes[b]);
            double     square = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              square += (x[d] - y[d]) * (x[d] - y[d]);
            const double stiffness = (100. + 10. * block.body) / square;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                {
                  const double k =
                    stiffness * (x[i] - y[i]) * (x[j] - y[j]) / square;
                  K(dim * a + i, dim * a + j) += k;
                  K(dim * b + i, dim * b + j) += k;
                  K(dim * a + i, dim * b + j) -= k;
                  K(dim * b + i, dim * a + j) -= k;
                }
          }
      return K;
    }

    /// Translations and rotations about @p centre, then orthonormal if asked.
    inline qp::MultiVector
    rigid_motions(const Block &block, const std::vector<double> &centre)
    {
      const unsigned int dim = centre.size();
      qp::MultiVector    R(dim * block.nodes.size(), dim == 2 ? 3 : 6);
      for (unsigned int a = 0; a < block.nodes.size(); ++a)
        {
          auto x = position(block.nodes[a]);
          for (unsigned int d = 0; d < dim; ++d)
            {
              x[d] -= centre[d];
              R(dim * a + d, d) = 1.;
            }
          for (unsigned int r = 0; r < (dim == 2 ? 1u : 3u); ++r)
            {
              const unsigned int i = dim == 2 ? 0 : (r + 1) % 3;
              const unsigned int j = dim == 2 ? 1 : (r + 2) % 3;
              R(dim * a + i, dim + r) = -x[j];
              R(dim * a + j, dim + r) = x[i];
            }
        }
      return R;
    }

    inline void
    orthonormalise(qp::MultiVector &R)
    {
      for (unsigned int j = 0; j < 2 * R.n_columns(); ++j)
        {
          const unsigned int column = j % R.n_columns();
          for (unsigned int k = 0; k <= column; ++k)
            {
              double product = 0.;
              for (unsigned int i = 0; i < R.n_rows(); ++i)
                product += R(i, column) * R(i, k);
              for (unsigned int i = 0; i < R.n_rows(); ++i)
                R(i, column) = k < column ? R(i, column) - product * R(i, k) :
                                            R(i, column) / std::sqrt(product);
            }
        }
    }

    /// The system of one block without rows of B; loads along @p direction.
    inline feti::SubdomainSystem
    truss_system(const Block &block, const std::vector<double> &centre_of_body)
    {
      const unsigned int    dim = centre_of_body.size();
      const Matrix          K   = dense_stiffness(block);
      feti::SubdomainSystem system;
      system.body = block.body;
      std::vector<std::vector<PetscInt>> columns(K.m());
      for (unsigned int i = 0; i < K.m(); ++i)
        for (unsigned int j = 0; j < K.m(); ++j)
          if (K(i, j) != 0.)
            columns[i].push_back(j);
      system.K = feti::CsrMatrix::from_rows(columns, K.m());
      for (unsigned int i = 0; i < K.m(); ++i)
        for (const PetscInt j : columns[i])
          system.K.values[system.K.position(i, j)] = K(i, j);
      system.f.assign(K.m(), 0.);
      for (unsigned int a = 0; a < block.nodes.size(); ++a)
        if (block.body == 1)
          system.f[dim * a + dim - 1] = -1. - 0.1 * (a % 3);
      system.R = rigid_motions(block, position(block.nodes[0]));
      orthonormalise(system.R);
      system.Z = feti::dense::transpose_product(
        system.R, rigid_motions(block, centre_of_body));
      const std::set<unsigned int> corners = {
        0,
        block.slot(block.last),
        block.slot([&]() {
          Node corner = block.first;
          corner[0]   = block.last[0];
          return corner;
        }()),
        block.slot([&]() {
          Node corner = block.last;
          corner[0]   = block.first[0];
          return corner;
        }())};
      for (const unsigned int corner : corners)
        for (unsigned int d = 0; d < dim; ++d)
          system.fixing_dofs.push_back(dim * corner + d);
      return system;
    }

    /**
     * Two bodies of torn trusses in 2D: a foundation of 2 x 2 blocks whose
     * lowest nodes are fixed, and a punch of 2 blocks above it, on rollers at
     * its left side unless @p floating, with contact rows node to node, or
     * node to segment (two master nodes) if asked.
     */
    class TornTruss
    {
    public:
      TornTruss(bool floating, bool node_to_segment);

      /// Total FETI of this rank's blocks.
      std::unique_ptr<feti::TotalFeti>
      make(const feti::FetiParameters &parameters);

      /// Values of all rows -> owned ones.
      qp::MultiVector
      owned(const qp::MultiVector &all) const;
      qp::RowSet
      owned(const qp::RowSet &all) const;
      /// Owned values of all ranks.
      qp::MultiVector
      gathered(const qp::MultiVector &owned) const;

      unsigned int
      n_rows() const
      {
        return bounded.size();
      }

      // The whole problem, equal on all ranks.
      std::vector<Block>                 blocks;
      std::vector<feti::SubdomainSystem> systems;
      std::vector<unsigned int>          start; ///< first unknown of blocks
      Matrix                             B, K, R;
      qp::RowSet                         bounded;

    private:
      struct Row
      {
        unsigned int                                  owner;
        bool                                          contact;
        std::vector<std::pair<unsigned int, double>> entries; ///< unknowns
      };

      int                                    rank, n_ranks;
      std::vector<Row>                       rows; ///< by owner
      std::vector<unsigned int>              first_row; ///< of ranks
      std::unique_ptr<feti::RowLayout>       layout;
      std::vector<feti::SubdomainSystem>     mine;
      std::unique_ptr<RunContext>            context;
      std::ostringstream                     log;

      unsigned int
      rank_of_block(unsigned int s) const
      {
        return s * n_ranks / blocks.size();
      }
      std::vector<unsigned int>
      copies(unsigned int body, const Node &node, unsigned int d) const;
      void
      glue_nodes(bool floating);
      void
      add_contacts(bool node_to_segment);
      void
      fill_dense();
    };

    inline TornTruss::TornTruss(bool floating, bool node_to_segment)
    {
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
      const int c = 3;
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          blocks.emplace_back(0,
                              Node{i * c, j * c},
                              Node{(i + 1) * c, (j + 1) * c});
      for (int i = 0; i < 2; ++i)
        blocks.emplace_back(1, Node{i * c, 7}, Node{(i + 1) * c, 9});
      start.assign(1, 0);
      for (const Block &block : blocks)
        {
          systems.push_back(truss_system(block, {3., 3. + block.body}));
          start.push_back(start.back() + systems.back().n_dofs());
        }
      glue_nodes(floating);
      add_contacts(node_to_segment);
      std::stable_sort(rows.begin(), rows.end(), [](const Row &a, const Row &b) {
        return a.owner < b.owner;
      });
      first_row.assign(n_ranks + 1, 0);
      for (const Row &row : rows)
        {
          bounded.push_back(row.contact);
          for (int r = row.owner; r < n_ranks; ++r)
            ++first_row[r + 1];
        }
      fill_dense();
    }

    inline std::vector<unsigned int>
    TornTruss::copies(unsigned int body, const Node &node, unsigned int d) const
    {
      std::vector<unsigned int> result;
      for (unsigned int s = 0; s < blocks.size(); ++s)
        {
          const unsigned int slot = blocks[s].slot(node);
          if (blocks[s].body == body && slot < blocks[s].nodes.size())
            result.push_back(start[s] + 2 * slot + d);
        }
      return result;
    }

    inline void
    TornTruss::glue_nodes(bool floating)
    {
      std::set<std::pair<unsigned int, Node>> nodes;
      for (const Block &block : blocks)
        for (const Node &node : block.nodes)
          nodes.emplace(block.body, node);
      for (const auto &entry : nodes)
        for (unsigned int d = 0; d < 2; ++d)
          {
            const Node &node = entry.second;
            // rows at one x meet on one rank, as contact rows ask for
            const unsigned int owner = node[0] * n_ranks / 7;
            const auto         dofs = copies(entry.first, node, d);
            const bool         fixed =
              entry.first == 0 ? node[1] == 0 :
                                 d == 0 && node[0] == 0 && !floating;
            for (unsigned int i = 0; i < dofs.size(); ++i)
              {
                if (fixed)
                  rows.push_back({owner, false, {{dofs[i], 1.}}});
                else if (i > 0)
                  {
                    rows.push_back({owner, false, {}});
                    const double norm = std::sqrt(i * (i + 1.));
                    for (unsigned int j = 0; j < i; ++j)
                      rows.back().entries.emplace_back(dofs[j], 1. / norm);
                    rows.back().entries.emplace_back(dofs[i], -(i / norm));
                  }
              }
          }
    }

    inline void
    TornTruss::add_contacts(bool node_to_segment)
    {
      for (int i = 0; i <= 6; ++i)
        {
          // segments stay within the nodes of one owner
          const unsigned int owner = i * n_ranks / 7;
          const bool         segment =
            node_to_segment && i < 6 &&
            owner == static_cast<unsigned int>((i + 1) * n_ranks / 7);
          Row  row{owner, true, {}};
          const auto add = [&](unsigned int body, const Node &node, double c) {
            const auto dofs = copies(body, node, 1);
            for (const unsigned int dof : dofs)
              row.entries.emplace_back(dof, c / dofs.size());
          };
          add(1, {i, 7}, -1.);
          add(0, {i, 6}, segment ? 0.7 : 1.);
          if (segment)
            add(0, {i + 1, 6}, 0.3);
          double square = 0.;
          for (const auto &entry : row.entries)
            square += entry.second * entry.second;
          for (auto &entry : row.entries)
            entry.second /= std::sqrt(square);
          rows.push_back(row);
        }
    }

    inline void
    TornTruss::fill_dense()
    {
      const unsigned int n = start.back();
      B.reinit(rows.size(), n);
      K.reinit(n, n);
      R.reinit(n, 3 * blocks.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        for (const auto &entry : rows[i].entries)
          B(i, entry.first) = entry.second;
      for (unsigned int s = 0; s < blocks.size(); ++s)
        {
          K.fill(dense_stiffness(blocks[s]), start[s], start[s], 0, 0);
          for (unsigned int i = 0; i < systems[s].n_dofs(); ++i)
            for (unsigned int mode = 0; mode < 3; ++mode)
              R(start[s] + i, 3 * s + mode) = systems[s].R(i, mode);
        }
    }

    inline std::unique_ptr<feti::TotalFeti>
    TornTruss::make(const feti::FetiParameters &parameters)
    {
      feti::SubdomainTable table;
      table.n_modes    = 3;
      table.body_names = {"foundation", "punch"};
      std::vector<std::vector<feti::RowLayout::Entry>> entries;
      std::vector<unsigned int>                        ids;
      mine.clear();
      for (unsigned int s = 0; s < blocks.size(); ++s)
        {
          table.body.push_back(blocks[s].body);
          if (rank_of_block(s) != static_cast<unsigned int>(rank))
            continue;
          ids.push_back(s);
          mine.push_back(systems[s]);
          entries.emplace_back();
          for (unsigned int i = 0; i < n_rows(); ++i)
            for (unsigned int j = start[s]; j < start[s + 1]; ++j)
              if (B(i, j) != 0.)
                entries.back().push_back({i, j - start[s]});
        }
      table.first = ids.empty() ? blocks.size() : ids[0];
      layout      = std::make_unique<feti::RowLayout>(MPI_COMM_WORLD,
                                                 owned(bounded),
                                                 entries,
                                                 table.first);
      for (unsigned int k = 0; k < mine.size(); ++k)
        for (const auto &entry : entries[k])
          mine[k].B.push_back({layout->local_row(entry.global_row),
                               entry.dof,
                               B(entry.global_row, start[ids[k]] + entry.dof)});
      context   = std::make_unique<RunContext>(MPI_COMM_WORLD, log);
      auto feti = std::make_unique<feti::TotalFeti>(
        mine, *layout, table, parameters, *context);
      qp::MultiVector gap(layout->n_owned());
      for (unsigned int i = 0; i < gap.n_rows(); ++i)
        gap(i) = layout->bounded()[i] ? 0.01 : 0.;
      feti->update(std::vector<bool>(mine.size(), true), gap);
      return feti;
    }

    inline qp::MultiVector
    TornTruss::owned(const qp::MultiVector &all) const
    {
      qp::MultiVector part(first_row[rank + 1] - first_row[rank],
                           all.n_columns());
      for (unsigned int k = 0; k < all.n_columns(); ++k)
        for (unsigned int i = 0; i < part.n_rows(); ++i)
          part(i, k) = all(first_row[rank] + i, k);
      return part;
    }

    inline qp::RowSet
    TornTruss::owned(const qp::RowSet &all) const
    {
      return qp::RowSet(all.begin() + first_row[rank],
                        all.begin() + first_row[rank + 1]);
    }

    inline qp::MultiVector
    TornTruss::gathered(const qp::MultiVector &part) const
    {
      qp::MultiVector all(n_rows(), part.n_columns());
      for (unsigned int k = 0; k < all.n_columns(); ++k)
        for (unsigned int i = 0; i < part.n_rows(); ++i)
          all(first_row[rank] + i, k) = part(i, k);
      MPI_Allreduce(MPI_IN_PLACE,
                    all.column(0),
                    all.n_rows() * all.n_columns(),
                    MPI_DOUBLE,
                    MPI_SUM,
                    MPI_COMM_WORLD);
      return all;
    }
  } // namespace test
} // namespace snug

#endif
