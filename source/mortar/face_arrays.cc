#include <snug/mortar/face_arrays.h>

namespace snug::mortar {
template <int dim>
FaceNodes<dim, double> node_arrays(const typename mesh::Surface<dim>::Field &positions)
{
  FaceNodes<dim, double> result(positions.size());
  for (unsigned int node = 0; node < positions.size(); ++node)
    for (int d = 0; d < dim; ++d)
      result[node][d] = positions[node][d];
  return result;
}

template <int dim>
FaceNodes<dim, faces::Differential<1>>
node_arrays(const typename mesh::Surface<dim>::Field &positions,
            const typename mesh::Surface<dim>::Field &velocity)
{
  FaceNodes<dim, faces::Differential<1>> result(positions.size());
  for (unsigned int node = 0; node < positions.size(); ++node)
    for (int d = 0; d < dim; ++d)
      {
        result[node][d]          = positions[node][d];
        result[node][d].slope[0] = velocity[node][d];
      }
  return result;
}

template <int dim, typename Number>
MortarFace<dim, Number> mortar_face(const mesh::Surface<dim>     &surface,
                                    const faces::FaceShape<dim>  &shape,
                                    unsigned int                  face,
                                    const FaceNodes<dim, Number> &points)
{
  const auto             &of = surface.faces()[face];
  MortarFace<dim, Number> result;
  for (const unsigned int node : of.nodes)
    result.nodes.push_back(points[node]);
  for (unsigned int k = 0; k < of.samples.size(); ++k)
    {
      result.offsets.push_back(points[of.samples[k]]);
      for (unsigned int a = 0; a < of.nodes.size(); ++a)
        for (int d = 0; d < dim; ++d)
          result.offsets[k][d] -= shape.at_sample(k).value[a] * result.nodes[a][d];
    }
  return result;
}

template <int dim>
void add_offset_gradient(const typename mesh::Surface<dim>::Face &face,
                         const faces::FaceShape<dim>             &shape,
                         const FaceNodes<dim, double>            &offset_gradient,
                         typename mesh::Surface<dim>::Field      &gradient)
{
  for (unsigned int k = 0; k < face.samples.size(); ++k)
    for (int d = 0; d < dim; ++d)
      {
        gradient[face.samples[k]][d] += offset_gradient[k][d];
        for (unsigned int a = 0; a < face.nodes.size(); ++a)
          gradient[face.nodes[a]][d] -= shape.at_sample(k).value[a] * offset_gradient[k][d];
      }
}

#define SNUG_INSTANTIATE(dim)                                                                                    \
  template FaceNodes<dim, double> node_arrays<dim>(const mesh::Surface<dim>::Field &);                           \
  template FaceNodes<dim, faces::Differential<1>> node_arrays<dim>(                                              \
    const mesh::Surface<dim>::Field &, const mesh::Surface<dim>::Field &);                                       \
  template MortarFace<dim, double>                 mortar_face<dim>(const mesh::Surface<dim> &,                  \
                                                                    const faces::FaceShape<dim> &, unsigned int, \
                                                                    const FaceNodes<dim, double> &);             \
  template MortarFace<dim, faces::Differential<1>> mortar_face<dim>(                                             \
    const mesh::Surface<dim> &, const faces::FaceShape<dim> &, unsigned int,                                     \
    const FaceNodes<dim, faces::Differential<1>> &);                                                             \
  template void add_offset_gradient<dim>(const mesh::Surface<dim>::Face &,                                       \
                                         const faces::FaceShape<dim> &,                                          \
                                         const FaceNodes<dim, double> &,                                         \
                                         mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
