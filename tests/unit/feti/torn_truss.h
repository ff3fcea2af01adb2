#ifndef snug_tests_unit_feti_torn_truss_h
#define snug_tests_unit_feti_torn_truss_h

#include <snug/feti/loaded_problem.h>

#include <unit/feti/truss_block.h>

#include <memory>
#include <set>
#include <sstream>

namespace snug::test {
/**
 * Two bodies of torn trusses in 2D: a foundation of 2 x 2 blocks whose
 * lowest nodes are fixed, and a punch of 2 blocks above it, on rollers at
 * its left side unless @p floating, with contact rows node to node, or
 * node to segment (two master nodes) if asked. Contact normals are the
 * vertical but for slopes of the size of @p slope that differ. Cells are
 * @p height high and one wide.
 */
class TornTruss
{
public:
  TornTruss(bool floating, bool node_to_segment, double slope = 0., double height = 1.);

  /// Total FETI of this rank's blocks.
  std::unique_ptr<feti::LoadedProblem> make(const feti::FetiParameters &parameters);

  /// Return the row layout that make() has made.
  const feti::RowLayout &row_layout() const { return *layout; }

  /// Values of all rows -> owned ones.
  qp::MultiVector owned(const qp::MultiVector &all) const;
  qp::RowSet      owned(const qp::RowSet &all) const;
  /// Owned values of all ranks.
  qp::MultiVector gathered(const qp::MultiVector &owned) const;

  unsigned int n_rows() const { return bounded.size(); }

  /// Return the moments of the faces inside the clusters, u_a - u_b along each rigid motion of the
  /// common nodes.
  Matrix joints() const;

  /// whether the blocks of a body form a cluster
  bool clustered = false;

  // The whole problem, equal on all ranks.
  std::vector<Block>                 blocks;
  std::vector<feti::SubdomainSystem> systems;
  std::vector<unsigned int>          start; ///< first unknown of blocks
  Matrix                             B, K, R;
  qp::RowSet                         bounded;

private:
  struct Row
  {
    unsigned int                                 owner;
    bool                                         contact;
    std::vector<std::pair<unsigned int, double>> entries; ///< unknowns
  };

  int                                  rank, n_ranks;
  std::vector<Row>                     rows;      ///< by owner
  std::vector<unsigned int>            first_row; ///< of ranks
  std::unique_ptr<feti::RowLayout>     layout;
  std::vector<feti::SubdomainSystem>   mine;
  feti::PrimalVectors                  loads;
  std::unique_ptr<RunContext>          context;
  std::unique_ptr<feti::FactorCache>   cache;
  std::unique_ptr<feti::DualStructure> structure;
  std::unique_ptr<feti::Linearization> linearization;
  std::ostringstream                   log;

  unsigned int rank_of_block(unsigned int s) const { return s * n_ranks / blocks.size(); }
  std::vector<unsigned int> copies(unsigned int body, const Node &node, unsigned int d) const;
  void                      glue_nodes(bool floating);
  void                      add_contacts(bool node_to_segment, double slope);
  void                      fill_dense();
  std::vector<std::pair<unsigned int, unsigned int>> joined_blocks() const;
  void add_clusters(feti::SubdomainTable &table) const;
};

inline TornTruss::TornTruss(bool floating, bool node_to_segment, double slope, double height)
{
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const int c = 3;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      blocks.emplace_back(0, Node{i * c, j * c}, Node{(i + 1) * c, (j + 1) * c}, height);
  for (int i = 0; i < 2; ++i)
    blocks.emplace_back(1, Node{i * c, 7}, Node{(i + 1) * c, 9}, height);
  start.assign(1, 0);
  for (const Block &block : blocks)
    {
      systems.push_back(truss_system(block, {3., 3. + block.body}));
      start.push_back(start.back() + systems.back().n_dofs());
    }
  glue_nodes(floating);
  add_contacts(node_to_segment, slope);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row &a, const Row &b) { return a.owner < b.owner; });
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

inline void TornTruss::glue_nodes(bool floating)
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
        const auto         dofs  = copies(entry.first, node, d);
        const bool fixed = entry.first == 0 ? node[1] == 0 : d == 0 && node[0] == 0 && !floating;
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

inline void TornTruss::add_contacts(bool node_to_segment, double slope)
{
  for (int i = 0; i <= 6; ++i)
    {
      // segments stay within the nodes of one owner
      const unsigned int owner = i * n_ranks / 7;
      const bool         segment =
        node_to_segment && i < 6 && owner == static_cast<unsigned int>((i + 1) * n_ranks / 7);
      Row        row{owner, true, {}};
      const auto add = [&](unsigned int body, const Node &node, double c) {
        for (unsigned int d = 0; d < 2; ++d)
          {
            const auto   dofs = copies(body, node, d);
            const double part = d == 1 ? c : c * slope * std::sin(1. + i);
            for (const unsigned int dof : dofs)
              if (part != 0.)
                row.entries.emplace_back(dof, part / dofs.size());
          }
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

inline void TornTruss::fill_dense()
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

/// Blocks of a body with a common side.
inline std::vector<std::pair<unsigned int, unsigned int>> TornTruss::joined_blocks() const
{
  return {{0, 1}, {0, 2}, {1, 3}, {2, 3}, {4, 5}};
}

inline Matrix TornTruss::joints() const
{
  const auto pairs = joined_blocks();
  Matrix     result(3 * pairs.size(), start.back());
  for (unsigned int j = 0; j < pairs.size(); ++j)
    for (const Node &node : blocks[pairs[j].first].nodes)
      for (const auto &[s, sign] : {std::pair(pairs[j].first, 1.), std::pair(pairs[j].second, -1.)})
        if (blocks[pairs[j].second].slot(node) < blocks[pairs[j].second].nodes.size())
          {
            const auto         x     = blocks[s].position(node);
            const unsigned int u     = start[s] + 2 * blocks[s].slot(node);
            result(3 * j, u)         = sign;
            result(3 * j + 1, u + 1) = sign;
            result(3 * j + 2, u)     = -sign * x[1];
            result(3 * j + 2, u + 1) = sign * x[0];
          }
  return result;
}

inline void TornTruss::add_clusters(feti::SubdomainTable &table) const
{
  table.clusters         = {0, 0, 0, 0, 1, 1};
  table.first_subdomains = {0, 4};
  for (unsigned int s = 0; s < blocks.size(); ++s)
    {
      if (rank_of_block(s) != static_cast<unsigned int>(rank))
        continue;
      table.joints.emplace_back();
      for (unsigned int other = 0; other < blocks.size(); ++other)
        for (const auto &[a, b] : joined_blocks())
          if ((a == s && b == other) || (b == s && a == other))
            {
              table.joints.back().push_back({other, {}, qp::MultiVector()});
              // both sides order the nodes alike
              auto                            &joint = table.joints.back().back();
              std::vector<std::vector<double>> x;
              for (const Node &node : blocks[a].nodes)
                if (blocks[b].slot(node) < blocks[b].nodes.size())
                  {
                    x.push_back(blocks[a].position(node));
                    for (unsigned int d = 0; d < 2; ++d)
                      joint.dofs.push_back(2 * blocks[s].slot(node) + d);
                  }
              joint.motions = qp::MultiVector(joint.dofs.size(), 3);
              for (unsigned int i = 0; i < x.size(); ++i)
                {
                  joint.motions(2 * i, 0) = joint.motions(2 * i + 1, 1) = 1.;
                  joint.motions(2 * i, 2)                               = -x[i][1];
                  joint.motions(2 * i + 1, 2)                           = x[i][0];
                }
              orthonormalise(joint.motions);
            }
    }
}

inline std::unique_ptr<feti::LoadedProblem> TornTruss::make(const feti::FetiParameters &parameters)
{
  feti::SubdomainTable table;
  table.n_modes    = 3;
  table.body_names = {"foundation", "punch"};
  std::vector<std::vector<feti::RowLayout::Entry>> entries;
  std::vector<unsigned int>                        ids;
  linearization.reset();
  structure.reset();
  cache.reset();
  mine.clear();
  loads = feti::PrimalVectors();
  feti::ConstraintRows rows_of_B;
  for (unsigned int s = 0; s < blocks.size(); ++s)
    {
      table.body.push_back(blocks[s].body);
      if (rank_of_block(s) != static_cast<unsigned int>(rank))
        continue;
      ids.push_back(s);
      mine.push_back(systems[s]);
      const auto f = truss_loads(blocks[s], 2);
      loads.emplace_back(f.n_rows());
      loads.back() = f;
      rows_of_B.emplace_back();
      entries.emplace_back();
      std::set<unsigned int> boundary;
      for (unsigned int i = 0; i < n_rows(); ++i)
        for (unsigned int j = start[s]; j < start[s + 1]; ++j)
          if (B(i, j) != 0.)
            {
              entries.back().push_back({i, j - start[s]});
              boundary.insert(j - start[s]);
            }
      mine.back().boundary.assign(boundary.begin(), boundary.end());
    }
  table.first = ids.empty() ? blocks.size() : ids[0];
  if (clustered)
    add_clusters(table);
  layout = std::make_unique<feti::RowLayout>(MPI_COMM_WORLD, owned(bounded), entries, table.first);
  for (unsigned int k = 0; k < mine.size(); ++k)
    for (const auto &entry : entries[k])
      rows_of_B[k].push_back({layout->local_row(entry.global_row), entry.dof,
                              B(entry.global_row, start[ids[k]] + entry.dof)});
  context   = std::make_unique<RunContext>(MPI_COMM_WORLD, log);
  cache     = std::make_unique<feti::FactorCache>(parameters.factorization, *context);
  structure = std::make_unique<feti::DualStructure>(*layout, table, parameters, *cache);
  qp::MultiVector gap(layout->n_owned());
  for (unsigned int i = 0; i < gap.n_rows(); ++i)
    gap(i) = layout->contact_rows()[i] ? 0.01 : 0.;
  linearization = std::make_unique<feti::Linearization>(*structure, mine, std::move(rows_of_B),
                                                        feti::SharedOperators(mine.size()));
  return std::make_unique<feti::LoadedProblem>(*linearization, loads, gap);
}

inline qp::MultiVector TornTruss::owned(const qp::MultiVector &all) const
{
  qp::MultiVector part(first_row[rank + 1] - first_row[rank], all.n_columns());
  for (unsigned int k = 0; k < all.n_columns(); ++k)
    for (unsigned int i = 0; i < part.n_rows(); ++i)
      part(i, k) = all(first_row[rank] + i, k);
  return part;
}

inline qp::RowSet TornTruss::owned(const qp::RowSet &all) const
{
  return qp::RowSet(all.begin() + first_row[rank], all.begin() + first_row[rank + 1]);
}

inline qp::MultiVector TornTruss::gathered(const qp::MultiVector &part) const
{
  qp::MultiVector all(n_rows(), part.n_columns());
  for (unsigned int k = 0; k < all.n_columns(); ++k)
    for (unsigned int i = 0; i < part.n_rows(); ++i)
      all(first_row[rank] + i, k) = part(i, k);
  MPI_Allreduce(MPI_IN_PLACE, all.column(0), all.n_rows() * all.n_columns(), MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  return all;
}
} // namespace snug::test

#endif
