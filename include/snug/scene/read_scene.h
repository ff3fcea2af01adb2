#ifndef snug_scene_read_scene_h
#define snug_scene_read_scene_h

#include <snug/scene/scene.h>

#include <mpi.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace snug::scene {
/// What a scene is read from. Later ones of equal entries win.
struct SceneSource
{
  std::string              file;             ///< only a name, for messages
  std::string              text;             ///< contents of the parameter file
  std::vector<std::string> sets;             ///< "Subsection/Entry=value"
  std::string              output_directory; ///< if not empty, overrides
  /// reads mesh files; with none they cannot be read
  std::function<std::string(const std::string &file)> read_file = {};
};

/// From where text may be read. Devices and pipes need not end.
enum class TextSource
{
  regular_file,
  any ///< devices and pipes as well, such as /dev/stdin, if they hold at most 16 MB
};

/**
 * Return the contents of a file, read by rank 0 only. Collective.
 * @throws InputError on all ranks if it cannot be read.
 */
std::string read_text(const std::string &file,
                      MPI_Comm           communicator,
                      TextSource         source = TextSource::regular_file);

/**
 * Read and check a scene and the mesh files it names. Lists left empty
 * that have a default (corner, size, grading, body force, initial design)
 * are filled in. Equal sources give equal scenes and equal errors;
 * collective if reading files is.
 *
 * @throws InputError, one line with file, line, entry, value and what is
 *   allowed; see check() for what is checked beyond the form of values.
 */
Scene read_scene(const SceneSource &source);

/// Every entry as a parameter file that reads back to the same scene.
void print(const Scene &scene, std::ostream &out);

/// All entries with defaults, allowed values and meaning, as Markdown.
void print_reference(std::ostream &out);
} // namespace snug::scene

#endif
