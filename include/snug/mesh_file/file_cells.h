#ifndef snug_mesh_file_file_cells_h
#define snug_mesh_file_file_cells_h

#include <snug/base/errors.h>
#include <snug/mesh_file/mesh_file.h>

namespace snug::mesh_file {
/**
 * Return the elements of a body: the elements of dimension dim in one of the @p regions (empty:
 * all), right-handed. A line about renumbered elements is added to @p notes.
 *
 * @throws InputError if there are no such elements, or an element is a pyramid, inverted or, in 2D,
 *   outside of the plane.
 */
template <int dim>
std::vector<MeshFile::Element> body_cells(const MeshFile                 &file,
                                          const std::vector<std::string> &regions,
                                          std::vector<std::string>       &notes);

/// Return the error "line 17: element 4 message".
InputError element_error(const MeshFile::Element &element, const std::string &message);
} // namespace snug::mesh_file

#endif
