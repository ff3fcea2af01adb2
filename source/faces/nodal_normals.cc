#include <snug/base/errors.h>
#include <snug/faces/nodal_normals.h>

#include <cmath>
#include <sstream>

namespace snug::faces {
namespace {
/// About cos(25 deg), the minimum length of the free part of a normal that respects supports.
/// Normals that lean more on a support are meant to do so: without the held part they would have
/// little to do with the face.
const double least_free_part = 0.9;

template <int dim, typename Number>
Number norm(const dealii::Tensor<1, dim, Number> &v)
{
  using std::sqrt;
  return sqrt(v * v);
}

/// Return the area vector of the true surface of @p face at its node @p k.
template <int dim, typename Number>
dealii::Tensor<1, dim, Number> area_at_node(const FaceShape<dim>                    &shape,
                                            const typename mesh::Surface<dim>::Face &face,
                                            const unsigned int                       k,
                                            const PointField<dim, Number>           &x)
{
  const TrueSurface<dim> of(shape, face, k);
  return area_vector(tangents<dim>(of.at_node, of.points, x));
}
} // namespace

template <int dim>
NodalNormals<dim>::NodalNormals(const mesh::Surface<dim>        &surface,
                                const std::vector<unsigned int> &faces,
                                const FaceShape<dim>            &shape,
                                const Field                     &positions,
                                const HeldDirections<dim>       *held)
  : surface(surface)
  , faces(faces)
  , shape(shape)
  , positions(positions)
  , held(held)
  , areas(sum_areas(PointField<dim, double>(positions)))
  , corrections(surface.n_nodes())
  , touched(surface.n_nodes(), false)
  , corrected(surface.n_nodes(), false)
  , unit(surface.n_nodes())
{
  for (const unsigned int f : faces)
    for (const unsigned int node : surface.faces()[f].nodes)
      touched[node] = true;
  check(areas, positions);
  check_true_surface();
  correct();
  for (unsigned int node = 0; node < unit.size(); ++node)
    if (touched[node])
      unit[node] = normal(node, areas[node]);
}

/// Return a_k. Area vectors are summed without normalization, so that faces are weighted by their
/// areas and the sum is a polynomial of the positions.
template <int dim>
template <typename Number>
std::vector<dealii::Tensor<1, dim, Number>>
NodalNormals<dim>::sum_areas(const PointField<dim, Number> &x) const
{
  std::vector<dealii::Tensor<1, dim, Number>> result(surface.n_nodes());
  for (const unsigned int f : faces)
    {
      const auto &face = surface.faces()[f];
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        result[face.nodes[k]] += area_at_node(shape, face, k, x);
    }
  return result;
}

/// Return n_k from a_k.
template <int dim>
template <typename Number>
dealii::Tensor<1, dim, Number> NodalNormals<dim>::normal(const unsigned int             node,
                                                         dealii::Tensor<1, dim, Number> v) const
{
  v /= norm(v);
  if (corrected[node])
    {
      v += corrections[node];
      v /= norm(v);
    }
  if (!held || (*held)[node].empty())
    return v;
  const auto   free = free_part(v, (*held)[node]);
  const Number size = norm(free);
  return value_of(size) > least_free_part ? free / size : v;
}

/// Throw an error where @p areas at the positions @p x have no direction.
template <int dim>
void NodalNormals<dim>::check(const Field &areas, const Field &x) const
{
  for (unsigned int node = 0; node < areas.size(); ++node)
    // The condition is written so that it also catches NaN.
    if (touched[node] && (!(areas[node].norm() > 0.) || !std::isfinite(areas[node].norm())))
      {
        std::ostringstream message;
        message << "the contact faces at (" << x[node] << ") are tangled: they have no normal";
        throw TangledMesh(message.str());
      }
}

/// Throw an error where the true surface of a face turns back from the mesh. The contact search
/// would exclude the node, because its normal points into the body.
template <int dim>
void NodalNormals<dim>::check_true_surface() const
{
  const PointField<dim, double> x(positions);
  for (const unsigned int f : faces)
    {
      const auto &face = surface.faces()[f];
      for (unsigned int k = 0; k < face.nodes.size() && !face.samples.empty(); ++k)
        if (!(area_at_node(shape, face, k, x) *
                area_vector(tangents<dim>(shape.at_node(k), face.nodes, positions)) >
              0.))
          {
            std::ostringstream message;
            message << "the true surface of a contact face turns back at ("
                    << positions[face.nodes[k]]
                    << "): the map of the mesh, for example its 'Warp', must not have a vanishing "
                       "derivative along the face";
            throw TangledMesh(message.str());
          }
    }
}

template <int dim>
void NodalNormals<dim>::correct()
{
  using Known           = const geometry::KnownSurface<dim> *;
  const auto &X         = surface.reference_positions();
  const auto  normal_of = [&X](const Known &of, const unsigned int node) {
    return of->normal(dealii::Point<dim>(X[node]));
  };
  std::vector<Known> known(surface.n_nodes(), nullptr);
  std::vector<bool>  several(surface.n_nodes(), false);
  bool               any = false;
  for (const unsigned int f : faces)
    for (const unsigned int node : surface.faces()[f].nodes)
      {
        const Known here = surface.faces()[f].known;
        // If a face has no known surface, or another one, the normal is a mean. The parts of a
        // surface that is cut into boundaries are known separately, up to the digits of a mesh
        // file.
        several[node] = several[node] || here == nullptr ||
                        (known[node] && known[node] != here &&
                         (normal_of(known[node], node) - normal_of(here, node)).norm() > 1e-6);
        known[node] = here;
        any         = any || here != nullptr;
      }
  if (!any)
    return;
  const Field reference = sum_areas(PointField<dim, double>(X));
  check(reference, X);
  for (unsigned int node = 0; node < corrections.size(); ++node)
    if (known[node] && !several[node])
      {
        auto unit_area = reference[node];
        unit_area /= unit_area.norm();
        corrected[node]   = true;
        corrections[node] = normal_of(known[node], node) - unit_area;
      }
}

template <int dim>
typename NodalNormals<dim>::Field NodalNormals<dim>::derivative(const Field &velocity) const
{
  const auto moving = sum_areas(PointField<dim, Differential<1>>(positions, velocity));
  Field      result(surface.n_nodes());
  for (unsigned int node = 0; node < result.size(); ++node)
    if (touched[node])
      {
        const auto n = normal(node, moving[node]);
        for (int d = 0; d < dim; ++d)
          result[node][d] = n[d].slope[0];
      }
  return result;
}

/// Record first the normal of each node as a function of its area vector, then the area vectors of
/// each face as functions of its points.
template <int dim>
void NodalNormals<dim>::add_transpose(const Field &normal_gradient, Field &gradient) const
{
  Recording                       recording;
  const PointField<dim, Recorded> of_areas(areas, recording);
  Field                           area_gradient(surface.n_nodes());
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (touched[node] && normal_gradient[node].norm_square() > 0.)
      recording.add(normal(node, of_areas[node]), normal_gradient[node]);
  recording.sweep();
  of_areas.add_derivatives(area_gradient);
  for (const unsigned int f : faces)
    {
      const auto &face = surface.faces()[f];
      recording.clear();
      const PointField<dim, Recorded> x(positions, recording);
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        if (area_gradient[face.nodes[k]].norm_square() > 0.)
          recording.add(area_at_node(shape, face, k, x), area_gradient[face.nodes[k]]);
      recording.sweep();
      x.add_derivatives(gradient);
    }
}

template class NodalNormals<2>;
template class NodalNormals<3>;
} // namespace snug::faces
