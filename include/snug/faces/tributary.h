#ifndef snug_faces_tributary_h
#define snug_faces_tributary_h

#include <snug/faces/face_shape.h>

namespace snug::faces {
/// The faces that areas are taken over.
template <int dim>
struct TributaryFaces
{
  const mesh::Surface<dim>        &surface;
  const std::vector<unsigned int> &faces; ///< indices into the surface
  const FaceShape<dim>            &shape;
};

/**
 * Tributary area of each surface node over some faces at @p positions
 * [length^2]: the integral of its shape function with the weight of the
 * idealization (thickness, circumference). Hanging nodes give their share
 * to their masters and keep it, too, so it is the sum over nodes that do
 * not hang which is the area.
 */
/// Whether the area of a node is zero but for curvature: on the axis of
/// revolution, int N r dr = 0 of the corner nodes of degree 2. A pressure
/// makes no force there, and a force no pressure.
template <int dim>
bool is_without_area(const mesh::Surface<dim>     &surface,
                     unsigned int                  degree,
                     const dealii::Tensor<1, dim> &position)
{
  return surface.idealization().is_axisymmetric() && degree == 2 && position[0] == 0.;
}

template <int dim>
std::vector<double> tributary_areas(const TributaryFaces<dim>                &of,
                                    const typename mesh::Surface<dim>::Field &positions);

/// Those of @p nodes alone.
template <int dim>
std::vector<double> tributary_areas(const TributaryFaces<dim>                &of,
                                    const std::vector<unsigned int>          &nodes,
                                    const typename mesh::Surface<dim>::Field &positions);

/// Return the integrals of the shape functions of the nodes of a @p face, a surface index, with
/// the weight of the idealization [length^2].
template <int dim>
std::vector<double> shape_integrals(const mesh::Surface<dim>                 &surface,
                                    unsigned int                              face,
                                    const FaceShape<dim>                     &shape,
                                    const typename mesh::Surface<dim>::Field &positions);

/// gradient_a += d/dX_a sum_i factors_i area_i over @p nodes i, for all
/// surface nodes a: hanging ones count as independent positions.
template <int dim>
void add_tributary_gradient(const TributaryFaces<dim>                &of,
                            const std::vector<unsigned int>          &nodes,
                            const typename mesh::Surface<dim>::Field &positions,
                            const std::vector<double>                &factors,
                            typename mesh::Surface<dim>::Field       &gradient);
} // namespace snug::faces

#endif
