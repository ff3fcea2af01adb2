#ifndef snug_base_deal_ii_compat_h
#define snug_base_deal_ii_compat_h

#include <deal.II/base/index_set.h>

#include <deal.II/lac/affine_constraints.h>

/// Calls whose form depends on the version of deal.II, from 9.4 on. Only this header queries the
/// version.
namespace snug::deal_ii_compat {
/// Return the communicator of a triangulation. The old name is deprecated since deal.II 9.7
/// (deal.II's pull request 17551).
template <typename Triangulation>
MPI_Comm communicator(const Triangulation &triangulation)
{
#if DEAL_II_VERSION_GTE(9, 7, 0)
  return triangulation.get_mpi_communicator();
#else
  return triangulation.get_communicator();
#endif
}

/// Return an empty list of constraints for the unknowns that this rank owns and the unknowns that
/// are relevant to it. Since deal.II 9.6 the owned unknowns are required, or their absence is
/// deprecated (deal.II's pull requests 15789 and 16035).
inline dealii::AffineConstraints<double> constraints(const dealii::IndexSet &owned,
                                                     const dealii::IndexSet &relevant)
{
#if DEAL_II_VERSION_GTE(9, 6, 0)
  return dealii::AffineConstraints<double>(owned, relevant);
#else
  (void)owned;
  return dealii::AffineConstraints<double>(relevant);
#endif
}
} // namespace snug::deal_ii_compat

#endif
