#ifndef snug_geometry_regions_h
#define snug_geometry_regions_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/**
 * Return @p geometry with the regions of the region formulas in addition to its own regions. A
 * coarse cell belongs to the first region whose formula is positive at the centre of the cell. If
 * no formula is positive, the region of the cell is not changed. Return @p geometry itself if
 * there are no formulas.
 * @throws InputError naming Region formulas.
 */
template <int dim>
std::unique_ptr<BodyGeometry<dim>> with_regions(std::unique_ptr<BodyGeometry<dim>> geometry,
                                                const BodyMeshParameters          &parameters);

/// Return the number of coarse cells of each region of region_names().
template <int dim>
std::vector<unsigned long> cells_of_regions(const BodyGeometry<dim> &geometry);
} // namespace snug::geometry

#endif
