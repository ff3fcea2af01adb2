#include <snug/base/assertions.h>
#include <snug/faces/quadratic_triangle.h>
#include <snug/faces/tributary.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace snug::faces {
namespace {
/// Call add(k, number) with the parts of the integral of the shape function of each node k of a
/// face.
template <int dim, typename Number, typename Add>
void for_each_part(const mesh::Surface<dim>      &surface,
                   const unsigned int             face,
                   const FaceShape<dim>          &shape,
                   const PointField<dim, Number> &positions,
                   const Add                     &add)
{
  using std::sqrt;
  const auto &nodes   = surface.faces()[face].nodes;
  const auto &section = surface.idealization();
  // The length of the area vector is not a polynomial on curved faces, so use one point more than
  // elements do.
  const dealii::QGauss<dim - 1> gauss(shape.degree() + 2);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const auto                     values = shape.at(gauss.point(q));
      const auto                     area   = area_vector(tangents<dim>(values, nodes, positions));
      const Number                   length = sqrt(area * area);
      dealii::Tensor<1, dim, Number> x;
      dealii::Tensor<1, dim>         value_of_x;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        x += values.value[k] * positions[nodes[k]];
      for (int d = 0; d < dim; ++d)
        value_of_x[d] = value_of(x[d]);
      // The weight of the section, which is 2 pi r in axisymmetric models, is linear in x.
      const Number weight =
        section.weight(value_of_x) + section.template weight_gradient<dim>() * (x - value_of_x);
      for (unsigned int k = 0; k < nodes.size(); ++k)
        add(k, values.value[k] * (gauss.weight(q) * weight) * length);
    }
}
} // namespace

template <int dim>
std::vector<bool> nodes_without_area(const TributaryFaces<dim>                &of,
                                     const typename mesh::Surface<dim>::Field &positions)
{
  const bool        has_axis = of.surface.idealization().is_axisymmetric();
  std::vector<bool> result(of.surface.n_nodes(), false), has_area = result;
  for (const unsigned int face : of.faces)
    {
      const auto triangle = quadratic_triangle(of.surface, face);
      for (const unsigned int node : of.surface.faces()[face].nodes)
        {
          const bool is_on_axis = has_axis && of.shape.degree() == 2 && positions[node][0] == 0.;
          const bool is_corner  = triangle && node == triangle->corners[0];
          (is_corner || is_on_axis ? result : has_area)[node] = true;
        }
    }
  for (unsigned int node = 0; node < result.size(); ++node)
    result[node] = result[node] && !has_area[node];
  return result;
}

template <int dim, typename Number>
std::vector<Number> tributary_areas(const TributaryFaces<dim>     &of,
                                    const PointField<dim, Number> &positions)
{
  std::vector<Number> share(of.surface.n_nodes(), Number(0.));
  for (const unsigned int f : of.faces)
    for_each_part(of.surface, f, of.shape, positions,
                  [&](const unsigned int k, const Number &part) {
                    share[of.surface.faces()[f].nodes[k]] += part;
                  });
  for (unsigned int node = 0; node < share.size(); ++node)
    // u_hanging = sum w_m u_m, so a force that is lumped to a hanging node acts on its masters with
    // the weights w_m.
    for (const auto &master : of.surface.masters(node))
      share[master.first] += master.second * share[node];
  return share;
}

template <int dim, typename Number>
std::vector<Number> tributary_areas(const TributaryFaces<dim>       &of,
                                    const std::vector<unsigned int> &nodes,
                                    const PointField<dim, Number>   &positions)
{
  const auto          share = tributary_areas(of, positions);
  std::vector<Number> result;
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
  std::vector<double> result(surface.faces()[face].nodes.size(), 0.);
  for_each_part(surface, face, shape, PointField<dim, double>(positions),
                [&](const unsigned int k, const double part) { result[k] += part; });
  return result;
}

template <int dim>
void add_tributary_gradient(const TributaryFaces<dim>                &of,
                            const std::vector<unsigned int>          &nodes,
                            const typename mesh::Surface<dim>::Field &positions,
                            const std::vector<double>                &factors,
                            typename mesh::Surface<dim>::Field       &gradient)
{
  SNUG_ASSERT_EQUAL(factors.size(), nodes.size());
  std::vector<double> of_nodes(of.surface.n_nodes(), 0.);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    of_nodes[nodes[i]] = factors[i];
  // Apply the transpose of the sharing in tributary_areas().
  auto share = of_nodes; // factors of the integrals of the shape functions
  for (unsigned int node = 0; node < share.size(); ++node)
    for (const auto &master : of.surface.masters(node))
      share[node] += master.second * of_nodes[master.first];
  Recording recording;
  for (const unsigned int f : of.faces)
    {
      recording.clear();
      const PointField<dim, Recorded> x(positions, recording);
      for_each_part(of.surface, f, of.shape, x, [&](const unsigned int k, const Recorded &part) {
        recording.add(part, share[of.surface.faces()[f].nodes[k]]);
      });
      recording.sweep();
      x.add_derivatives(gradient);
    }
}

#define SNUG_INSTANTIATE_NUMBER(dim, Number)                                      \
  template std::vector<Number> tributary_areas(const TributaryFaces<dim> &,       \
                                               const PointField<dim, Number> &);  \
  template std::vector<Number> tributary_areas(const TributaryFaces<dim> &,       \
                                               const std::vector<unsigned int> &, \
                                               const PointField<dim, Number> &);
#define SNUG_INSTANTIATE(dim)                                                            \
  SNUG_INSTANTIATE_NUMBER(dim, double)                                                   \
  SNUG_INSTANTIATE_NUMBER(dim, Differential<1>)                                          \
  template std::vector<bool>   nodes_without_area(const TributaryFaces<dim> &,           \
                                                  const mesh::Surface<dim>::Field &);    \
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
#undef SNUG_INSTANTIATE_NUMBER
} // namespace snug::faces
