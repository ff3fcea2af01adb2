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

/// Return the equality rows without ties and springs. Ties would couple all unknowns of a boundary,
/// and so would springs. With zeros on springs, products of the vectors of soft modes with F need
/// no D.
qp::RowSet Linearization::rows_of_soft_modes() const
{
  auto result = qp::complement(contact_rows());
  for (unsigned int row = 0; row < result.size(); ++row)
    if (layout().tie_rows()[row])
      result[row] = 0;
  for (unsigned int row = 0; row < D.size(); ++row)
    if (D[row] > 0.)
      result[row] = 0;
  return result;
}

/// Return the columns of the jump operator without springs, whose rows would couple all unknowns of
/// a boundary.
std::vector<JumpColumns> Linearization::jumps(const std::vector<double> &entries) const
{
  const unsigned int first = table().first, width = 2 + table().n_modes;
  const auto         n = narrow<unsigned int>(systems.size());
  if (!qp::any(!D.empty(), context().communicator()))
    return jump_operator(layout(), *gram, entries, width, first, n, rows_of_soft_modes());
  auto                others = entries;
  std::vector<double> separate(D.size(), 0.);
  for (unsigned int row = 0; row < D.size(); ++row)
    if (D[row] > 0.)
      {
        separate[row] = 1.;
        for (unsigned int e = layout().entry_start()[row]; e < layout().entry_start()[row + 1]; ++e)
          others[std::size_t(e) * width] = 0.;
      }
  std::unique_ptr<const RowGram> of_others;
  throw_collectively(context().communicator(), [&]() {
    of_others = std::make_unique<RowGram>(structure.gram, others, width, separate);
  });
  return jump_operator(layout(), *of_others, others, width, first, n, rows_of_soft_modes());
}

/// Return the row forces of the soft modes of the subdomains of this rank.
std::vector<RowForces> Linearization::find_soft_modes(const std::vector<double> &entries) const
{
  std::vector<RowForces> forces;
  if (!structure.seeks_soft_modes(systems))
    return forces;
  const unsigned int first   = table().first;
  const auto         columns = jumps(entries);
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
