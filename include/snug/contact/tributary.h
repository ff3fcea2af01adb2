#ifndef snug_contact_tributary_h
#define snug_contact_tributary_h

#include <snug/contact/face_shape.h>

namespace snug
{
  namespace contact
  {
    /**
     * Tributary area of each surface node over @p faces (indices into the
     * surface) at @p positions [length^2]: the integral of its shape function
     * with the weight of the idealization (thickness, circumference). Hanging
     * nodes give their share to their masters and keep it, too, so it is the
     * sum over nodes that do not hang which is the area.
     */
    template <int dim>
    std::vector<double>
    tributary_areas(const mesh::Surface<dim>                 &surface,
                    const std::vector<unsigned int>          &faces,
                    const FaceShape<dim>                     &shape,
                    const typename mesh::Surface<dim>::Field &positions);
  } // namespace contact
} // namespace snug

#endif
