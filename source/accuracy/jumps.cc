#include <snug/accuracy/jumps.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace snug::accuracy {
template <int dim>
mesh::Field<dim> jump(const state::StateSolver<dim> &solver,
                      const feti::PrimalVectors     &torn,
                      const feti::PrimalVectors     &continuous,
                      const unsigned int             j)
{
  const auto         &mesh = solver.mesh();
  std::vector<double> sums(static_cast<std::size_t>(dim) * mesh.n_local_nodes(), 0.);
  for (unsigned int s = 0; s < torn.size(); ++s)
    {
      const auto &nodes = solver.tearing().subdomains[s].nodes;
      for (unsigned int i = 0; i < dim * nodes.size(); ++i)
        sums[static_cast<std::size_t>(dim) * nodes[i / dim] + i % dim] +=
          dealii::Utilities::fixed_power<2>(torn[s](i, j) - continuous[s](i, j));
    }
  mesh::sum_at_shared_nodes(mesh, dim, sums);
  mesh::Field<dim> result(mesh.n_local_nodes());
  for (unsigned int i = 0; i < sums.size(); ++i)
    result[i / dim][i % dim] = std::sqrt(sums[i]);
  mesh.interpolate_hanging(result);
  return mesh::owners_values(mesh, result);
}

#define SNUG_INSTANTIATE(dim)                                                                  \
  template mesh::Field<dim> jump(const state::StateSolver<dim> &, const feti::PrimalVectors &, \
                                 const feti::PrimalVectors &, unsigned int);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
