#ifndef snug_cad_part_h
#define snug_cad_part_h

// Headers of deal.II come first, because OpenCASCADE defines a macro Handle.
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

namespace snug::cad {
/**
 * A solid of a CAD file, or in 2D a plane face of a file. Its faces, in 2D its edges, have the
 * numbers 1, 2, ... in the order of the file. This text calls edges of a 2D part faces as well.
 */
struct Part
{
  TopoDS_Shape             shape;
  unsigned int             dim;
  std::vector<std::string> names;     ///< of the faces; empty if the file has no name
  double                   size = 0.; ///< diagonal of the box of the part [length]
  std::string name = {}; ///< of the product or the solid; empty if the file has no name

  std::vector<TopoDS_Shape> faces() const;
};

/// Return the ending of a path in lower case, ".step".
std::string ending_of(const std::string &path);

/// Read all solids of a CAD file, as read_part() does. @throws InputError without the path.
std::vector<Part> read_solids(const std::string &path);

/**
 * Read a file of STEP, IGES or BREP, which the end of @p path indicates. Lengths of STEP and IGES
 * are converted to mm. Faces without a solid are sewn to one. @p solid is the number of the solid,
 * in 2D of the plane face; 0: the only one.
 * @throws InputError naming the entry File or Solid.
 */
Part read_part(const std::string &path, unsigned int solid, unsigned int dim);

/// @name The shape as text, from which the same shape is read on other ranks
/// @{
std::string  to_brep(const TopoDS_Shape &shape);
TopoDS_Shape from_brep(const std::string &text);
/// @}
} // namespace snug::cad

#endif
