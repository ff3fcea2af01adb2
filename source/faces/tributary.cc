#include <snug/faces/tributary.h>

#include <deal.II/base/quadrature_lib.h>

namespace snug::faces {
namespace {
/// A Gauss point of a face, whose area is weight * |area|.
template <int dim>
struct AreaPoint
{
  const std::vector<unsigned int>        &nodes;
  const typename FaceShape<dim>::Values  &values;
  const typename FaceShape<dim>::Tangents t;
  const dealii::Tensor<1, dim>            area; ///< area vector
  const double                            weight;
  const dealii::Tensor<1, dim>            weight_gradient;
};

/// Call work() for every Gauss point of every face.
template <int dim, typename Work>
void for_each_point(const TributaryFaces<dim>                &of,
                    const typename mesh::Surface<dim>::Field &positions,
                    const Work                               &work)
{
  // area| is not a polynomial on curved faces, so use one point more than elements do.
  const dealii::QGauss<dim - 1> quadrature(of.shape.degree() + 2);
  const auto                   &section = of.surface.idealization();
  for (const unsigned int f : of.faces)
    {
      const auto &nodes = of.surface.faces()[f].nodes;
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const auto             values = of.shape.at(quadrature.point(q));
          dealii::Tensor<1, dim> x;
          for (unsigned int k = 0; k < nodes.size(); ++k)
            x += values.value[k] * positions[nodes[k]];
          const double weight = quadrature.weight(q);
          const auto   t      = tangents<dim>(values, nodes, positions);
          work(AreaPoint<dim>{nodes, values, t, area_vector(t), weight * section.weight(x),
                              weight * section.template weight_gradient<dim>()});
        }
    }
}
} // namespace

template <int dim>
std::vector<double> tributary_areas(const TributaryFaces<dim>                &of,
                                    const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<double> share(of.surface.n_nodes(), 0.);
  for_each_point(of, positions, [&](const AreaPoint<dim> &point) {
    for (unsigned int k = 0; k < point.nodes.size(); ++k)
      share[point.nodes[k]] += point.values.value[k] * point.weight * point.area.norm();
  });
  for (unsigned int node = 0; node < share.size(); ++node)
    // u_hanging = sum w_m u_m, so a force that is lumped to a hanging node acts on its masters with
    // the weights w_m.
    for (const auto &master : of.surface.masters(node))
      share[master.first] += master.second * share[node];
  return share;
}

template <int dim>
std::vector<double> tributary_areas(const TributaryFaces<dim>                &of,
                                    const std::vector<unsigned int>          &nodes,
                                    const typename mesh::Surface<dim>::Field &positions)
{
  const auto          share = tributary_areas(of, positions);
  std::vector<double> result;
  for (const unsigned int node : nodes)
    result.push_back(share[node]);
  return result;
}

template <int dim>
std::vector<double> shape_integrals(const mesh::Surface<dim>                 &surface,
                                    const unsigned int                        face,
                                    const FaceShape<dim>                     &shape,
                                    const typename mesh::Surface<dim>::Field &positions)
{
  const auto                   &nodes = surface.faces()[face].nodes;
  const dealii::QGauss<dim - 1> gauss(shape.degree() + 2);
  std::vector<double>           result(nodes.size(), 0.);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const auto             values = shape.at(gauss.point(q));
      dealii::Tensor<1, dim> x;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        x += values.value[k] * positions[nodes[k]];
      const double weight = gauss.weight(q) * surface.idealization().weight(x) *
                            area_vector(tangents<dim>(values, nodes, positions)).norm();
      for (unsigned int k = 0; k < nodes.size(); ++k)
        result[k] += weight * values.value[k];
    }
  return result;
}

template <int dim>
void add_tributary_gradient(const TributaryFaces<dim>                &of,
                            const std::vector<unsigned int>          &nodes,
                            const typename mesh::Surface<dim>::Field &positions,
                            const std::vector<double>                &factors,
                            typename mesh::Surface<dim>::Field       &gradient)
{
  AssertDimension(factors.size(), nodes.size());
  std::vector<double> of_nodes(of.surface.n_nodes(), 0.);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    of_nodes[nodes[i]] = factors[i];
  // Apply the transpose of the sharing in tributary_areas().
  auto share = of_nodes; // factors of the integrals of the shape functions
  for (unsigned int node = 0; node < share.size(); ++node)
    for (const auto &master : of.surface.masters(node))
      share[node] += master.second * of_nodes[master.first];
  for_each_point(of, positions, [&](const AreaPoint<dim> &point) {
    // Differentiate sum_k share_k N_k, the sum over the functions of all nodes, at once.
    double factor = 0.;
    for (unsigned int k = 0; k < point.nodes.size(); ++k)
      factor += share[point.nodes[k]] * point.values.value[k];
    // d|a| = (a/|a|) . da
    const auto by_tangents =
      area_vector_transpose(point.t, factor * point.weight / point.area.norm() * point.area);
    for (unsigned int k = 0; k < point.nodes.size(); ++k)
      {
        auto &sum = gradient[point.nodes[k]];
        // The weight of the section, which is 2 pi r in axisymmetric models, moves with the node.
        sum += factor * point.area.norm() * point.values.value[k] * point.weight_gradient;
        for (int i = 0; i < dim - 1; ++i)
          sum += point.values.gradient[k][i] * by_tangents[i];
      }
  });
}

#define SNUG_INSTANTIATE(dim)                                                            \
  template std::vector<double> tributary_areas(const TributaryFaces<dim> &,              \
                                               const mesh::Surface<dim>::Field &);       \
  template std::vector<double> tributary_areas(const TributaryFaces<dim> &,              \
                                               const std::vector<unsigned int> &,        \
                                               const mesh::Surface<dim>::Field &);       \
  template std::vector<double> shape_integrals(const mesh::Surface<dim> &, unsigned int, \
                                               const FaceShape<dim> &,                   \
                                               const mesh::Surface<dim>::Field &);       \
  template void                add_tributary_gradient(const TributaryFaces<dim> &,       \
                                                      const std::vector<unsigned int> &, \
                                                      const mesh::Surface<dim>::Field &, \
                                                      const std::vector<double> &, mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::faces
