#include <snug/base/errors.h>
#include <snug/faces/nodal_normals.h>

#include <cmath>
#include <sstream>

namespace snug::faces {
template <int dim>
NodalNormals<dim>::NodalNormals(const mesh::Surface<dim>        &surface,
                                const std::vector<unsigned int> &faces,
                                const FaceShape<dim>            &shape,
                                const Field                     &positions)
  : surface(surface), faces(faces), shape(shape), positions(positions)
{
  normalise_areas(positions, area_unit, area_length);
  unit = area_unit;
  length.assign(unit.size(), 1.);
  correct();
}

/// Compute a_k/|a_k| and |a_k| at the positions @p x.
template <int dim>
void NodalNormals<dim>::normalise_areas(const Field         &x,
                                        Field               &areas,
                                        std::vector<double> &lengths) const
{
  areas.assign(surface.n_nodes(), {});
  lengths.assign(surface.n_nodes(), 0.);
  std::vector<bool> touched(surface.n_nodes(), false);
  for (const unsigned int f : faces)
    {
      const auto &face = surface.faces()[f];
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        {
          const TrueSurface<dim> of(shape, face, k);
          // Area vectors are summed without normalization, so that faces are weighted by their
          // areas and the sum is a polynomial of the positions.
          areas[face.nodes[k]] += area_vector(tangents<dim>(of.at_node, of.points, x));
          touched[face.nodes[k]] = true;
        }
    }
  for (unsigned int node = 0; node < areas.size(); ++node)
    if (touched[node])
      {
        lengths[node] = areas[node].norm();
        // The condition is written so that it also catches NaN.
        if (!(lengths[node] > 0.) || !std::isfinite(lengths[node]))
          {
            std::ostringstream message;
            message << "the contact faces at (" << x[node] << ") are tangled: they have no normal";
            throw TangledMesh(message.str());
          }
        areas[node] /= lengths[node];
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
  Field               reference;
  std::vector<double> lengths;
  normalise_areas(X, reference, lengths);
  for (unsigned int node = 0; node < unit.size(); ++node)
    if (known[node] && !several[node])
      {
        unit[node] += normal_of(known[node], node) - reference[node];
        length[node] = unit[node].norm();
        unit[node] /= length[node];
      }
}

template <int dim>
typename NodalNormals<dim>::Field NodalNormals<dim>::derivative(const Field &velocity) const
{
  Field result(surface.n_nodes());
  for (const unsigned int f : faces)
    {
      const auto &face = surface.faces()[f];
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        {
          const TrueSurface<dim> of(shape, face, k);
          result[face.nodes[k]] +=
            area_vector_derivative(tangents<dim>(of.at_node, of.points, positions),
                                   tangents<dim>(of.at_node, of.points, velocity));
        }
    }
  for (unsigned int node = 0; node < result.size(); ++node)
    // Nodes of other faces have length 0 and no derivative.
    if (area_length[node] > 0.)
      result[node] =
        unit_vector_derivative(unit[node], length[node],
                               unit_vector_derivative(area_unit[node], area_length[node],
                                                      result[node]));
  return result;
}

/// Apply the chain rule in reverse order: unit normal, sum of area vectors, tangents, points of
/// each face.
template <int dim>
void NodalNormals<dim>::add_transpose(const Field &normal_gradient, Field &gradient) const
{
  for (const unsigned int f : faces)
    {
      const auto &face = surface.faces()[f];
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        {
          const TrueSurface<dim> of(shape, face, k);
          const unsigned int     node = face.nodes[k];
          // (I - n n')/|a| is symmetric, so the same function serves derivative and transpose.
          const auto to_area =
            unit_vector_derivative(area_unit[node], area_length[node],
                                   unit_vector_derivative(unit[node], length[node],
                                                          normal_gradient[node]));
          const auto to_tangents =
            area_vector_transpose(tangents<dim>(of.at_node, of.points, positions), to_area);
          for (unsigned int j = 0; j < of.points.size(); ++j)
            for (int i = 0; i < dim - 1; ++i)
              gradient[of.points[j]] += of.at_node.gradient[j][i] * to_tangents[i];
        }
    }
}

template <int dim>
dealii::Tensor<1, dim> unit_vector_derivative(const dealii::Tensor<1, dim> &n,
                                              double                        length,
                                              const dealii::Tensor<1, dim> &v)
{
  return (v - (n * v) * n) / length;
}

template class NodalNormals<2>;
template class NodalNormals<3>;
template dealii::Tensor<1, 2>
unit_vector_derivative(const dealii::Tensor<1, 2> &, double, const dealii::Tensor<1, 2> &);
template dealii::Tensor<1, 3>
unit_vector_derivative(const dealii::Tensor<1, 3> &, double, const dealii::Tensor<1, 3> &);
} // namespace snug::faces
