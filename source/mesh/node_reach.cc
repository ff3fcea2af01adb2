#include <snug/mesh/node_reach.h>

#include <algorithm>
#include <map>

namespace snug::mesh {
namespace {
/// Return the position of a node in @p among.
unsigned int slot_of(const unsigned int node, const std::vector<unsigned int> &among)
{
  return among.empty() ? node : std::lower_bound(among.begin(), among.end(), node) - among.begin();
}
} // namespace

template <int dim>
NodeReach<dim>::NodeReach(const BodyMesh<dim>             &mesh,
                          const std::vector<unsigned int> &nodes,
                          const std::vector<unsigned int> &among)
  : n_nodes(nodes.size())
{
  const auto slot = [&](unsigned int node) { return slot_of(node, among); };
  // Most cells have no hanging node. T is null for these cells, which means the identity.
  bool hanging = false;
  for (const unsigned int node : nodes)
    hanging = hanging || mesh.is_hanging(node);
  if (!hanging)
    {
      for (const unsigned int node : nodes)
        reached.push_back(slot(node));
      return;
    }
  std::vector<std::map<unsigned int, double>> rows;
  for (const unsigned int node : nodes)
    {
      rows.emplace_back();
      if (mesh.is_hanging(node))
        // A master has one slot, even if several hanging nodes share the master or the master is a
        // node of the cell.
        for (const auto &master : mesh.hanging()[mesh.hanging_index(node)].masters)
          rows.back()[slot(master.first)] += master.second;
      else
        rows.back()[slot(node)] = 1.;
      for (const auto &entry : rows.back())
        reached.push_back(entry.first);
    }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  Weights T;
  for (const auto &row : rows)
    for (const unsigned int s : reached)
      T.push_back(row.count(s) ? row.at(s) : 0.);
  weights = std::make_shared<const Weights>(std::move(T));
}

template <int dim>
NodeReach<dim> NodeReach<dim>::of_cell(const BodyMesh<dim>             &mesh,
                                       const unsigned int               cell,
                                       const std::vector<unsigned int> &among)
{
  const Tetrahedron *tetrahedron = mesh.tetrahedron(cell);
  if (tetrahedron == nullptr)
    return {mesh, mesh.cells()[cell].nodes, among};
  const auto &cells = tetrahedron->cells;
  NodeReach   result;
  result.n_nodes = mesh.cells()[cell].nodes.size();
  for (const unsigned int node : tetrahedron->nodes)
    result.reached.push_back(slot_of(node, among));
  // The functions are static, so the pointer does not own them.
  result.weights = {std::shared_ptr<const Weights>(),
                    &tetrahedron_functions(std::find(cells.begin(), cells.end(), cell) -
                                           cells.begin())};
  return result;
}

template <int dim>
typename NodeReach<dim>::Nodes NodeReach<dim>::values(const double *u) const
{
  Nodes              result(n_nodes);
  const unsigned int m = reached.size();
  for (unsigned int a = 0; a < n_nodes; ++a)
    for (unsigned int c = 0; c < dim; ++c)
      if (!weights)
        result[a][c] = u[dim * reached[a] + c];
      else
        for (unsigned int s = 0; s < m; ++s)
          result[a][c] += (*weights)[a * m + s] * u[dim * reached[s] + c];
  return result;
}

/// This is the transpose of values(): a force at a hanging node acts on the masters with their
/// weights.
template <int dim>
void NodeReach<dim>::add(double factor, const Nodes &r, double *u) const
{
  const unsigned int m = reached.size();
  for (unsigned int a = 0; a < n_nodes; ++a)
    for (unsigned int c = 0; c < dim; ++c)
      if (!weights)
        u[dim * reached[a] + c] += factor * r[a][c];
      else
        for (unsigned int s = 0; s < m; ++s)
          u[dim * reached[s] + c] += factor * (*weights)[a * m + s] * r[a][c];
}

/// The two products K T and T'(K T) run over the nonzeros of T. They have at most n^2 m and n m^2
/// terms, whereas a single triple product has n^2 m^2 terms.
template <int dim>
void NodeReach<dim>::condense(std::vector<double> &K) const
{
  if (!weights)
    return;
  const Weights      &T = *weights;
  const unsigned int  n = n_nodes, m = reached.size();
  std::vector<double> KT(std::size_t(n) * dim * m * dim, 0.);
  for (unsigned int row = 0; row < n * dim; ++row)
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int s = 0; s < m; ++s)
        if (T[b * m + s] != 0.)
          for (unsigned int d = 0; d < dim; ++d)
            KT[row * m * dim + s * dim + d] += K[row * n * dim + b * dim + d] * T[b * m + s];
  std::vector<double> result(std::size_t(m) * dim * m * dim, 0.);
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int s = 0; s < m; ++s)
      if (T[a * m + s] != 0.)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int column = 0; column < m * dim; ++column)
            result[(s * dim + c) * m * dim + column] +=
              T[a * m + s] * KT[(a * dim + c) * m * dim + column];
  K = result;
}

template class NodeReach<2>;
template class NodeReach<3>;
} // namespace snug::mesh
