#include <snug/elasticity/element.h>
#include <snug/io/nodal_stress.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace snug::io {
namespace {
/// Coordinate in [0,1] of Gauss point @p i of @p n = 1 or 2.
/// The points of degree 1 and 2: 1/2, and 1/2 -+ 1 / (2 sqrt 3).
double gauss_coordinate(unsigned int n, unsigned int i)
{
  return n == 1 ? 0.5 : 0.5 + (i == 0 ? -0.5 : 0.5) / std::sqrt(3.);
}

/// Weight of Gauss point @p i of @p n in the value at @p x.
/// Lagrange polynomial of the points; outside them weights may be negative or above 1.
double gauss_weight(unsigned int n, unsigned int i, double x)
{
  if (n == 1)
    return 1.;
  const double other = gauss_coordinate(n, 1 - i);
  return (x - other) / (gauss_coordinate(n, i) - other);
}

/// Digit @p axis of @p index in base @p base.
/// Coordinate of a point or node of a tensor product, first axis fastest.
unsigned int tensor_index(unsigned int index, unsigned int base, unsigned int axis)
{
  for (unsigned int k = 0; k < axis; ++k)
    index /= base;
  return index % base;
}

/// Where a cell's stress is taken and how the nodes extrapolate it; the weights of a node add
/// up to 1.
template <int dim>
struct StressSampling
{
  std::vector<dealii::Point<dim>>  points;  ///< p^dim Gauss points
  std::vector<std::vector<double>> weights; ///< [node][point]
};

template <int dim>
StressSampling<dim> stress_sampling(unsigned int degree)
{
  const unsigned int  n_points = dealii::Utilities::fixed_power<dim>(degree);
  const unsigned int  n_nodes  = dealii::Utilities::fixed_power<dim>(degree + 1);
  StressSampling<dim> sampling;
  sampling.points.resize(n_points);
  sampling.weights.assign(n_nodes, std::vector<double>(n_points, 1.));
  for (unsigned int q = 0; q < n_points; ++q)
    for (unsigned int k = 0; k < dim; ++k)
      {
        const unsigned int i  = tensor_index(q, degree, k);
        sampling.points[q][k] = gauss_coordinate(degree, i);
        for (unsigned int a = 0; a < n_nodes; ++a)
          sampling.weights[a][q] *=
            gauss_weight(degree, i, double(tensor_index(a, degree + 1, k)) / degree);
      }
  return sampling;
}

constexpr unsigned int n_stress = dealii::SymmetricTensor<2, 3>::n_independent_components;

/// Per local node and region: weighted sums of the components of stress
/// and the sum of weights, over this rank's cells.
template <int dim>
std::vector<double> stress_sums(const mesh::BodyMesh<dim>                 &mesh,
                                const std::vector<state::BodyModel<dim>>  &bodies,
                                const typename mesh::BodyMesh<dim>::Field &positions,
                                const typename mesh::BodyMesh<dim>::Field &displacement)
{
  std::vector<elasticity::Element<dim>> elements;
  for (const auto &body : bodies)
    elements.emplace_back(mesh.degree(), mesh.idealization(), body.formulation);
  // A plain section: weights by the radius or thickness would spoil the mean of a linear field.
  const elasticity::Element<dim> flat(mesh.degree());
  const auto                     sampling  = stress_sampling<dim>(mesh.degree());
  const unsigned int             n_regions = n_stress_regions(mesh);
  std::vector<double>            sums(std::size_t(n_stress + 1) * n_regions * mesh.n_local_nodes());
  for (const auto &cell : mesh.cells())
    {
      const auto                              &element = elements[cell.body];
      typename elasticity::Element<dim>::Nodes X, u;
      for (const unsigned int node : cell.nodes)
        {
          X.push_back(positions[node]);
          u.push_back(displacement[node]);
        }
      const double weight = 1. / flat.volume(X); // of the section
      for (unsigned int q = 0; q < sampling.points.size(); ++q)
        {
          const auto stress =
            element.stress(X, bodies[cell.body].material(cell), u, sampling.points[q]);
          for (unsigned int a = 0; a < X.size(); ++a)
            {
              const double factor = weight * sampling.weights[a][q];
              double      *sum =
                &sums[std::size_t(n_stress + 1) * (cell.nodes[a] * n_regions + cell.region)];
              for (unsigned int c = 0; c < n_stress; ++c)
                sum[c] += factor * stress.access_raw_entry(c);
              // factors may be negative, but those of a cell at a node add up to 1 / volume > 0
              sum[n_stress] += factor;
            }
        }
    }
  return sums;
}
} // namespace

/// The same for all bodies, so that one index serves for all nodes.
template <int dim>
unsigned int n_stress_regions(const mesh::BodyMesh<dim> &mesh)
{
  std::size_t n = 1;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    n = std::max(n, mesh.geometry(body).region_names().size());
  return n;
}

template <int dim>
std::vector<dealii::SymmetricTensor<2, 3>>
nodal_stress(const mesh::BodyMesh<dim>                 &mesh,
             const std::vector<state::BodyModel<dim>>  &bodies,
             const typename mesh::BodyMesh<dim>::Field &positions,
             const typename mesh::BodyMesh<dim>::Field &displacement)
{
  AssertDimension(bodies.size(), mesh.n_bodies());
  auto               sums      = stress_sums(mesh, bodies, positions, displacement);
  const unsigned int n_regions = n_stress_regions(mesh);
  // sums and weights together, so that the mean is one over the cells of all ranks
  mesh::sum_at_shared_nodes(mesh, (n_stress + 1) * n_regions, sums);

  std::vector<dealii::SymmetricTensor<2, 3>> stress(n_regions * mesh.n_local_nodes());
  const auto                                 weight = [&](unsigned int i) {
    return sums[std::size_t(n_stress + 1) * i + n_stress];
  };
  for (unsigned int i = 0; i < stress.size(); ++i)
    // no weight: no cell of this region has the node
    if (weight(i) > 0.)
      for (unsigned int c = 0; c < n_stress; ++c)
        stress[i].access_raw_entry(c) = sums[std::size_t(n_stress + 1) * i + c] / weight(i);
  // Only the cells on the fine side have a hanging node, so their mean would jump across the face.
  for (const auto &hanging : mesh.hanging())
    for (unsigned int r = 0; r < n_regions; ++r)
      {
        dealii::SymmetricTensor<2, 3> sum;
        bool                          inside = true;
        for (const auto &[master, factor] : hanging.masters)
          {
            sum += factor * stress[master * n_regions + r];
            inside = inside && weight(master * n_regions + r) > 0.;
          }
        // Where a master lies outside the region, the mean of the cells stays.
        if (inside)
          stress[hanging.node * n_regions + r] = sum;
      }
  return stress;
}

#define SNUG_INSTANTIATE(dim)                                                                        \
  template unsigned int                               n_stress_regions(const mesh::BodyMesh<dim> &); \
  template std::vector<dealii::SymmetricTensor<2, 3>> nodal_stress(                                  \
    const mesh::BodyMesh<dim> &, const std::vector<state::BodyModel<dim>> &,                         \
    const mesh::BodyMesh<dim>::Field &, const mesh::BodyMesh<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
