#include <snug/feti/linearization.h>
#include <snug/feti/soft_modes.h>
#include <snug/qp/row_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::feti {
bool DualStructure::seeks_soft_modes(const std::vector<SubdomainSystem> &systems) const
{
  if (parameters.preconditioner == Preconditioner::none ||
      parameters.soft_modes == SoftModesOf::none ||
      (clusters.any() && !coarse.table.compares_soft_modes))
    return false;
  bool slender = parameters.soft_modes == SoftModesOf::all;
  for (const SubdomainSystem &system : systems)
    slender = slender || !system.compact;
  return dealii::Utilities::MPI::logical_or(slender, layout.communicator());
}

/// Return the row forces of the soft modes of the subdomains of this rank.
std::vector<RowForces> Linearization::find_soft_modes(const std::vector<double> &entries) const
{
  std::vector<RowForces> forces;
  if (!structure.seeks_soft_modes(systems))
    return forces;
  const unsigned int first   = table().first;
  const auto         columns = jump_operator(layout(), *gram, entries, 2 + table().n_modes, table(),
                                             narrow<unsigned int>(systems.size()));
  const auto         neighbours =
    stiffness_of_neighbours(systems, columns, first, context().communicator());
  double largest = 0.;
  // Number of vectors, and number of subdomains with at least one.
  std::vector<unsigned int> counts(2, 0);
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      if (systems[s].is_rigid())
        continue;
      const auto modes_of_s =
        feti::soft_modes(systems[s], *operators.factors[s], columns[s], neighbours[s], first + s);
      if (modes_of_s.mu.empty())
        continue;
      forces.push_back(row_forces(modes_of_s, columns[s], first + s));
      largest = std::max(largest, modes_of_s.mu.front());
      counts[0] += narrow<unsigned int>(modes_of_s.mu.size());
      ++counts[1];
    }
  dealii::Utilities::MPI::sum(counts, context().communicator(), counts);
  largest = dealii::Utilities::MPI::max(largest, context().communicator());
  context().work.soft_modes += counts[0];
  if (counts[0] > 0)
    context().out(Verbosity::debug)
      << "soft modes: " << counts[0] << " of " << counted(counts[1], "subdomain")
      << ", maximum eigenvalue " << largest << std::endl;
  return forces;
}
} // namespace snug::feti
