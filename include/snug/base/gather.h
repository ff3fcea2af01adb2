#ifndef snug_base_gather_h
#define snug_base_gather_h

#include <deal.II/base/mpi.h>

namespace snug {
/// Return the objects of all ranks on every rank. deal.II packs and compresses objects, which a
/// single rank need not do. Collective.
template <typename T>
std::vector<T> all_gather(MPI_Comm communicator, const T &mine)
{
  return dealii::Utilities::MPI::n_mpi_processes(communicator) == 1
           ? std::vector<T>(1, mine)
           : dealii::Utilities::MPI::all_gather(communicator, mine);
}

/// Return the objects of all ranks on rank @p root, and nothing on other ranks. Collective.
template <typename T>
std::vector<T> gather(MPI_Comm communicator, const T &mine, const unsigned int root = 0)
{
  return dealii::Utilities::MPI::n_mpi_processes(communicator) == 1
           ? std::vector<T>(1, mine)
           : dealii::Utilities::MPI::gather(communicator, mine, root);
}
} // namespace snug

#endif
