#ifndef snug_base_rank_order_h
#define snug_base_rank_order_h

#include <mpi.h>

#include <functional>
#include <string>

namespace snug {
/**
 * Give the bytes @p mine of every rank to @p take on rank 0, in the order of the ranks, as for a
 * file of all ranks. Rank 0 keeps the bytes of one other rank at a time, so that its memory does
 * not grow with the number of ranks. @p take is not called for ranks without bytes, and must not
 * throw. Collective.
 * @throws std::bad_alloc on all ranks if rank 0 has not enough memory.
 */
void collect_in_order(MPI_Comm                                        communicator,
                      const std::string                              &mine,
                      const std::function<void(const std::string &)> &take);

/**
 * Return on every rank the @p size bytes that @p read(bytes) on rank 0 puts into a string of this
 * size. It is called for one rank after the other, as for a file that collect_in_order() wrote, and
 * must not throw. Collective.
 * @throws std::bad_alloc on all ranks if one rank has not enough memory.
 */
std::string distribute_in_order(MPI_Comm                                  communicator,
                                unsigned long long                        size,
                                const std::function<void(std::string &)> &read);
} // namespace snug

#endif
