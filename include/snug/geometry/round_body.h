#ifndef snug_geometry_round_body_h
#define snug_geometry_round_body_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/// The first @p n numbers of the entry Cells; 4 each if it is empty.
/// @throws InputError unless there are n, none of them 0.
std::vector<unsigned int> round_cells(const BodyMeshParameters &parameters, unsigned int n);

/// 1, 2, 4 or 8 for the part full, half, quarter or eighth.
/// @throws InputError if it is above @p largest.
unsigned int n_of_part(const BodyMeshParameters &parameters, unsigned int largest);

/// @throws InputError naming @p entry unless @p value is positive.
void require_positive(const std::string &entry, double value);

/// @throws InputError unless 0 < inner radius < radius.
void require_radii(const BodyMeshParameters &parameters);
} // namespace snug::geometry

#endif
