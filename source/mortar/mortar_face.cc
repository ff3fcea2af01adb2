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
      const auto              sample = to_array(of.samples[k]);
      const auto             &values = shape.at_sample(k).value;
      std::array<Number, dim> offset;
      for (int d = 0; d < dim; ++d)
        // The sample comes first, then the nodes.
        offset[d] = faces::combination<Number>(
          of.nodes.size() + 1, [&](unsigned int a) { return a == 0 ? 1. : -values[a - 1]; },
          [&](unsigned int a) -> const Number & {
            return a == 0 ? sample[d] : result.nodes[a - 1][d];
          });
      result.offsets.push_back(offset);
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
