#ifndef snug_cad_step_shapes_h
#define snug_cad_step_shapes_h

#include <snug/cad/write_step.h>

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Shape.hxx>

namespace snug::cad {
/// A shape with its name in a STEP file.
using NamedShape = std::pair<TopoDS_Shape, std::string>;

/// Return the surface of a face with two parameters.
Handle(Geom_BSplineSurface) surface_of(const SplineFace &face);

/// Write products whose faces have the names @p faces, in the order of TopExp::MapShapes(). See
/// write_step() for faces. @throws Standard_Failure, std::runtime_error.
void write_step(const std::string              &path,
                const std::string              &unit,
                const std::vector<NamedShape>  &products,
                const std::vector<std::string> &faces);
} // namespace snug::cad

#endif
