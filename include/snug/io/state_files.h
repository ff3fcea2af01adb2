#ifndef snug_io_state_files_h
#define snug_io_state_files_h

#include <mpi.h>

#include <string>
#include <vector>

namespace snug::io {
/// A named part of a state: a body, or a boundary of a body.
struct Block
{
  std::string group; ///< "bodies" or "boundaries"
  std::string name;  ///< "punch" or "punch.bottom"
  std::string piece; ///< VTU text of the cells of this rank; empty if this rank has no cell
};

/**
 * Return the number of consecutive ranks that share a file: @p ranks_per_file, or for 0 at least 16
 * and as many as make at most 16 files. One file is easiest to use. Several files are written and
 * read in parallel, and 16 of them are enough for a file system.
 */
unsigned int ranks_of_a_file(unsigned int ranks_per_file, unsigned int n_ranks);

/**
 * Write one state of a series into @p directory, for ParaView:
 *
 * - STEM/NUMBER-NAME.RANKS.vtu contains the cells of one block on one group of ranks,
 * - STEM.vtm names all blocks as group, then name; a block of several files is a group of them,
 * - STEM.pvtu joins the blocks of the first group to one grid.
 *
 * The blocks are the same on all ranks except for their pieces. Collective.
 * @param[in] arrays VtuGrid::declarations() of the blocks.
 * @param[in] ranks_per_file See ranks_of_a_file(). The first rank of a group writes. It keeps the
 *   piece of one other rank at a time.
 * @throws std::runtime_error if a file cannot be written.
 */
void write_state(MPI_Comm                  comm,
                 const std::string        &directory,
                 const std::string        &stem,
                 const std::vector<Block> &blocks,
                 const std::string        &arrays,
                 unsigned int              ranks_per_file);

/// Write the series solution.pvd and contact.pvd of the states of all load cases, with their
/// numbers as times. @p fields and @p faces are the files of the load cases, relative to @p
/// directory. Collective.
/// @throws std::runtime_error if a file cannot be written.
void write_load_cases(MPI_Comm                        comm,
                      const std::string              &directory,
                      const std::vector<std::string> &fields,
                      const std::vector<std::string> &faces);
} // namespace snug::io

#endif
