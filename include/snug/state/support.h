#ifndef snug_state_support_h
#define snug_state_support_h

#include <snug/mesh/body_mesh.h>

#include <array>
#include <map>
#include <vector>

namespace snug
{
  namespace state
  {
    /// Fixed displacement components of one boundary of a body.
    struct Support
    {
      unsigned int              body, boundary;
      std::vector<unsigned int> components;
    };

    template <int dim>
    using FixedFlags = std::array<bool, dim>;

    /// Components fixed at local nodes by the supports and, in axisymmetric
    /// models, by the axis (u_r = 0 where r = 0), as far as this rank's own
    /// boundary faces show.
    template <int dim>
    std::map<unsigned int, FixedFlags<dim>>
    fixed_components(const mesh::BodyMesh<dim>  &mesh,
                     const std::vector<Support> &supports);

    /// The unit vector of component @p c.
    template <int dim>
    dealii::Tensor<1, dim>
    axis(unsigned int c);

    /// An orthonormal basis of the complement of orthonormal @p fixed,
    /// nearest the axes.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    complement(const std::vector<dealii::Tensor<1, dim>> &fixed);
  } // namespace state
} // namespace snug

#endif
