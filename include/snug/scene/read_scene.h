#ifndef snug_scene_read_scene_h
#define snug_scene_read_scene_h

#include <snug/base/entries.h>
#include <snug/base/run_context.h>
#include <snug/scene/scene.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace snug::scene {
/// Sources of a scene. If an entry is set several times, the last value counts.
struct SceneSource
{
  std::string              file;             ///< only a name, used in messages
  std::string              text;             ///< contents of the parameter file
  std::vector<std::string> sets;             ///< statements "Subsection/Entry=value"
  std::string              output_directory; ///< if not empty, it overrides the entry
  /// function that reads mesh files on rank 0; if empty, mesh files cannot be read
  std::function<std::string(const std::string &file)> read_file = {};
  /// run that reads the scene and gets its verbosity; null: every rank reads the scene by itself,
  /// and CAD files cannot be read
  RunContext *context = nullptr;
};

/// Kinds of files from which text may be read. Devices and pipes need not end.
enum class TextSource
{
  regular_file,
  any ///< devices and pipes too, such as /dev/stdin, if they contain at most 16 MB
};

/// Return the contents of a file. @throws InputError if it cannot be read.
std::string read_text(const std::string &file, TextSource source = TextSource::regular_file);

/**
 * Read and check a scene and the mesh files and CAD files named in the scene. Empty lists that have
 * a default (corner, size, grading, body force, initial design) are filled in. Equal sources give
 * equal scenes and equal errors. Only rank 0 has the cells of files, see ImportedMesh.
 * Collective on the ranks of the run.
 *
 * @throws InputError, one line with file, line, entry, value and the allowed values; see check()
 * for the checks beyond the form of values.
 */
Scene read_scene(const SceneSource &source);

/// Write every entry as a parameter file that reads back to the same scene.
void print(const Scene &scene, std::ostream &out);

/// Return the entries of subsections called NAME, with defaults and meanings. They are bound to
/// @p scene.
Entries reference_entries(Scene &scene);

/// Return the default of an entry of reference_entries(). Lists of names have none, but contain the
/// names that the reference needs.
std::string reference_default(const Entries::Description &entry);

/// Write all entries with defaults, allowed values and meaning, as Markdown.
void print_reference(std::ostream &out);
} // namespace snug::scene

#endif
