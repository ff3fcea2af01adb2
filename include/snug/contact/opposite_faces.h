#ifndef snug_contact_opposite_faces_h
#define snug_contact_opposite_faces_h

#include <snug/contact/projection.h>
#include <snug/contact/segment_points.h>

namespace snug
{
  namespace contact
  {
    /**
     * A slave face widened by this part of its size on all sides decides which
     * master faces it is paired with: so far may they slide on each other
     * before a part of it has no partner.
     */
    constexpr double pairing_margin = 0.1;

    /// Faces steeper to each other than this are not opposite: -cos(60 deg).
    constexpr double opposite_cosine = -0.5;

    /**
     * For each slave face the master faces, ascending, that lie opposite to it:
     * their normals at the centres are within 60 degrees of opposite, they
     * overlap along the slave's normal, and their distance is at most 1.5 times
     * that of the closest master face plus the slave face's diameter.
     */
    template <int dim>
    std::vector<std::vector<unsigned int>>
    opposite_faces(const mesh::Surface<dim>                 &surface,
                   const PairFaces                          &sides,
                   const FaceShape<dim>                     &shape,
                   const typename mesh::Surface<dim>::Field &positions);
  } // namespace contact
} // namespace snug

#endif
