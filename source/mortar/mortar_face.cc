#include <snug/mortar/mortar_face.h>

namespace snug::mortar {
template <int dim, typename Number>
MortarFace<dim, Number> mortar_face(const mesh::Surface<dim>             &surface,
                                    const faces::FaceShape<dim>          &shape,
                                    const unsigned int                    face,
                                    const faces::PointField<dim, Number> &positions)
{
  const auto to_array = [&positions](const unsigned int point) {
    const auto             &x = positions[point];
    std::array<Number, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = x[d];
    return result;
  };
  const auto             &of = surface.faces()[face];
  MortarFace<dim, Number> result;
  for (const unsigned int node : of.nodes)
    result.nodes.push_back(to_array(node));
  for (unsigned int k = 0; k < of.samples.size(); ++k)
    {
      result.offsets.push_back(to_array(of.samples[k]));
      for (unsigned int a = 0; a < of.nodes.size(); ++a)
        for (int d = 0; d < dim; ++d)
          result.offsets[k][d] -= shape.at_sample(k).value[a] * result.nodes[a][d];
    }
  return result;
}

#define SNUG_INSTANTIATE(dim, Number)                                                       \
  template MortarFace<dim, Number> mortar_face(const mesh::Surface<dim> &,                  \
                                               const faces::FaceShape<dim> &, unsigned int, \
                                               const faces::PointField<dim, Number> &);
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, faces::Differential<1>)
SNUG_INSTANTIATE(2, faces::Recorded)
SNUG_INSTANTIATE(3, double)
SNUG_INSTANTIATE(3, faces::Differential<1>)
SNUG_INSTANTIATE(3, faces::Recorded)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
