#ifndef snug_mortar_clip_h
#define snug_mortar_clip_h

#include <snug/faces/recording.h>

#include <array>
#include <vector>

namespace snug::mortar {
/// Convex cell, given by its vertices: the ends of an interval, ascending (d = 1), or the corners
/// of a polygon, counterclockwise (d = 2).
template <std::size_t d, typename Number>
using ConvexCell = std::vector<std::array<Number, d>>;

/**
 * Return the part of @p subject inside @p clip; empty if there is none. The tolerance is meant for
 * cells of a size around 1: a vertex of @p subject within 1e-11 of the boundary of @p clip counts
 * as inside. So where boundaries coincide, the result follows the boundary of @p subject. Polygons
 * are cut by one edge of @p clip after the other (Sutherland, Hodgman, Comm. ACM 17, 1974).
 */
template <std::size_t d, typename Number>
ConvexCell<d, Number> intersection(const ConvexCell<d, Number> &subject,
                                   const ConvexCell<d, Number> &clip);

/// Return the signed area of a polygon, as a sum over triangles, or the signed length of an
/// interval. The result is negative for the other orientation.
template <std::size_t d, typename Number>
double signed_measure(const ConvexCell<d, Number> &cell);

/// Return the simplices of a convex cell with @p n_vertices vertices, by vertex numbers: the
/// interval itself, or the fan of triangles at vertex 0.
template <std::size_t d>
std::vector<std::array<unsigned int, d + 1>> simplices(unsigned int n_vertices);
} // namespace snug::mortar

#endif
