#ifndef snug_geometry_regions_h
#define snug_geometry_regions_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/**
 * @p geometry with the regions of its parameters' formulas besides its own:
 * a coarse cell belongs to the first region whose formula is positive at
 * its centre, or else to the region it had. The geometry itself if there
 * are no formulas.
 * @throws InputError naming Region formulas.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> with_regions(std::unique_ptr<BodyGeometry<dim>> geometry,
                                                const BodyMeshParameters          &parameters);

/// Numbers of coarse cells of the regions, as many as region_names().
template <int dim>
std::vector<unsigned long> cells_of_regions(const BodyGeometry<dim> &geometry);
} // namespace snug::geometry

#endif
