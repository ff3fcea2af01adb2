#ifndef snug_mesh_file_file_cells_h
#define snug_mesh_file_file_cells_h

#include <snug/base/errors.h>
#include <snug/mesh_file/mesh_file.h>

namespace snug::mesh_file {
/**
 * The elements of a file that make a body: those of dimension dim in one
 * of the @p regions (empty: all), right-handed. What was turned or left out
 * is added to @p notes.
 *
 * @throws InputError if there are none, some do not lie in the plane (2D),
 *   are pyramids or inverted.
 */
template <int dim>
std::vector<MeshFile::Element> body_cells(const MeshFile                 &file,
                                          const std::vector<std::string> &regions,
                                          std::vector<std::string>       &notes);

/// "line 17: element 4 message".
InputError element_error(const MeshFile::Element &element, const std::string &message);
} // namespace snug::mesh_file

#endif
