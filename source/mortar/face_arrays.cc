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
FaceNodes<dim, Number> face_nodes(const mesh::Surface<dim>     &surface,
                                  unsigned int                  face,
                                  const FaceNodes<dim, Number> &nodes)
{
  FaceNodes<dim, Number> result;
  for (const unsigned int node : surface.faces()[face].nodes)
    result.push_back(nodes[node]);
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                               \
  template FaceNodes<dim, double> node_arrays<dim>(const mesh::Surface<dim>::Field &);      \
  template FaceNodes<dim, faces::Differential<1>> node_arrays<dim>(                         \
    const mesh::Surface<dim>::Field &, const mesh::Surface<dim>::Field &);                  \
  template FaceNodes<dim, double> face_nodes<dim>(const mesh::Surface<dim> &, unsigned int, \
                                                  const FaceNodes<dim, double> &);          \
  template FaceNodes<dim, faces::Differential<1>> face_nodes<dim>(                          \
    const mesh::Surface<dim> &, unsigned int, const FaceNodes<dim, faces::Differential<1>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
