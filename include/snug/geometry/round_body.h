#ifndef snug_geometry_round_body_h
#define snug_geometry_round_body_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/// Return the @p n numbers of the entry Cells, or 4 each if the entry is empty.
/// @throws InputError unless the entry has n numbers and no number is 0.
std::vector<unsigned int> round_cells(const BodyMeshParameters &parameters, unsigned int n);

/// Return 1, 2, 4 or 8 for the part full, half, quarter or eighth.
/// @throws InputError if the number exceeds @p largest.
unsigned int n_of_part(const BodyMeshParameters &parameters, unsigned int largest);

/// Check that @p value is positive. @throws InputError naming @p entry otherwise.
void require_positive(const std::string &entry, double value);

/// Check that 0 < inner radius < radius. @throws InputError otherwise.
void require_radii(const BodyMeshParameters &parameters);
} // namespace snug::geometry

#endif
