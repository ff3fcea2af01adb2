#ifndef snug_faces_tributary_h
#define snug_faces_tributary_h

#include <snug/faces/face_shape.h>
#include <snug/faces/point_field.h>

namespace snug::faces {
/// Faces over which areas are integrated.
template <int dim>
struct TributaryFaces
{
  const mesh::Surface<dim>        &surface;
  const std::vector<unsigned int> &faces; ///< indices into the surface
  const FaceShape<dim>            &shape;
};

/**
 * Return for each surface node whether its area over some faces is zero except for curvature. A
 * pressure causes no force there, and a force causes no pressure. Such nodes are
 * - corner nodes of degree 2 on the axis of revolution, where int N r dr = 0;
 * - corners of a QuadraticTriangle, where int lambda (2 lambda - 1) dA = 0.
 */
template <int dim>
std::vector<bool> nodes_without_area(const TributaryFaces<dim>                &of,
                                     const typename mesh::Surface<dim>::Field &positions);

/**
 * Return the tributary area of each surface node over some faces at @p positions [length^2]. The
 * area is the integral of the shape function of the node with the weight of the idealization
 * (thickness, circumference). Hanging nodes give their share to their masters and keep it, too.
 * Therefore only the sum over nodes that do not hang is the area of the faces. Number is double or
 * Differential<1>.
 */
template <int dim, typename Number>
std::vector<Number> tributary_areas(const TributaryFaces<dim>     &of,
                                    const PointField<dim, Number> &positions);

/// Return the tributary areas of @p nodes alone.
template <int dim, typename Number>
std::vector<Number> tributary_areas(const TributaryFaces<dim>       &of,
                                    const std::vector<unsigned int> &nodes,
                                    const PointField<dim, Number>   &positions);

/// Return the integrals of the shape functions of the nodes of a @p face, a surface index, with
/// the weight of the idealization [length^2].
template <int dim>
std::vector<double> shape_integrals(const mesh::Surface<dim>                 &surface,
                                    unsigned int                              face,
                                    const FaceShape<dim>                     &shape,
                                    const typename mesh::Surface<dim>::Field &positions);

/// Add gradient_a += d/dX_a sum_i factors_i area_i over @p nodes i, for all surface nodes a.
/// Hanging nodes count as independent positions.
template <int dim>
void add_tributary_gradient(const TributaryFaces<dim>                &of,
                            const std::vector<unsigned int>          &nodes,
                            const typename mesh::Surface<dim>::Field &positions,
                            const std::vector<double>                &factors,
                            typename mesh::Surface<dim>::Field       &gradient);
} // namespace snug::faces

#endif
