#ifndef snug_optimization_warm_start_file_h
#define snug_optimization_warm_start_file_h

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>

namespace snug::optimization {
/**
 * Write what @p of_this_rank returns on each rank to the file @p path: the number of ranks, the
 * number of bytes of each rank as 64-bit integers of this machine, and the bytes. The file is
 * renamed when it is complete, so that a kill while writing leaves the file from before. Rank 0
 * writes. Collective.
 * @throws InputError if the file cannot be written.
 */
void write_warm_start(MPI_Comm                            communicator,
                      const std::string                  &path,
                      const std::function<std::string()> &of_this_rank);

/// Return the bytes of this rank; nothing on all ranks if the file is missing, incomplete or of
/// another number of ranks. Rank 0 reads. Collective.
std::optional<std::string> read_warm_start(MPI_Comm communicator, const std::string &path);
} // namespace snug::optimization

#endif
