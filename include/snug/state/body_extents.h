#ifndef snug_state_body_extents_h
#define snug_state_body_extents_h

#include <snug/mesh/body_mesh.h>

#include <string>
#include <vector>

namespace snug
{
  namespace state
  {
    /// Centre and half diagonal of each body's bounding box at the reference
    /// positions [length]. Collective.
    template <int dim>
    void
    measure_bodies(const mesh::BodyMesh<dim>           &mesh,
                   std::vector<dealii::Tensor<1, dim>> &centres,
                   std::vector<double>                 &lengths);

    /// Bodies of an axisymmetric model must not reach negative radii.
    /// Collective. @throws InputError on all ranks.
    template <int dim>
    void
    check_radii(const mesh::BodyMesh<dim>      &mesh,
                const std::vector<std::string> &body_names);

    /// Nodes on the axis are held there; @p length is that of a body.
    /// @throws TangledMesh, on this rank, if a design moves one away.
    template <int dim>
    void
    check_axis(const mesh::BodyMesh<dim>                 &mesh,
               const typename mesh::BodyMesh<dim>::Field &positions,
               double                                     length);
  } // namespace state
} // namespace snug

#endif
