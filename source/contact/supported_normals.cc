#include <snug/contact/supported_normals.h>

namespace snug::contact {
namespace {
/// About cos(25 deg), the minimum length of the free part of a normal that is corrected. Normals
/// that lean more on a support are meant to do so.
const double least_free_part = 0.9;
} // namespace

template <int dim>
SupportedNormals<dim>::SupportedNormals(const mesh::Surface<dim>         &surface,
                                        const std::vector<unsigned int>  &faces,
                                        const faces::FaceShape<dim>      &shape,
                                        const Field                      &positions,
                                        const faces::HeldDirections<dim> &held)
  : nodal(surface, faces, shape, positions)
  , held(held)
  , unit(nodal.normals())
  , length(unit.size(), 0.)
{
  for (unsigned int node = 0; node < unit.size(); ++node)
    {
      const auto   v    = faces::free_part(unit[node], held[node]);
      const double size = v.norm();
      // Normals that lean on a support by more than 25 degrees stay as they are: without the held
      // part they would have little to do with the face.
      if (!held[node].empty() && size > least_free_part)
        {
          unit[node]   = v / size;
          length[node] = size;
        }
    }
}

template <int dim>
typename SupportedNormals<dim>::Field SupportedNormals<dim>::derivative(const Field &velocity) const
{
  Field result = nodal.derivative(velocity);
  for (unsigned int node = 0; node < result.size(); ++node)
    if (length[node] > 0.)
      result[node] = faces::unit_vector_derivative(unit[node], length[node],
                                                   faces::free_part(result[node], held[node]));
  return result;
}

template <int dim>
void SupportedNormals<dim>::add_transpose(const Field &normal_gradient, Field &gradient) const
{
  Field to_nodal = normal_gradient;
  for (unsigned int node = 0; node < to_nodal.size(); ++node)
    if (length[node] > 0.)
      // Apply the transposes in reverse order; both factors are symmetric.
      to_nodal[node] = faces::free_part(faces::unit_vector_derivative(unit[node], length[node],
                                                                      normal_gradient[node]),
                                        held[node]);
  nodal.add_transpose(to_nodal, gradient);
}

template class SupportedNormals<2>;
template class SupportedNormals<3>;
} // namespace snug::contact
