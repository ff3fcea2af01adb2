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
  : surface(surface)
  , faces(faces)
  , shape(shape)
  , positions(positions)
  , unit(surface.n_nodes())
  , length(surface.n_nodes(), 0.)
{
  std::vector<bool> touched(surface.n_nodes(), false);
  for (const unsigned int f : faces)
    {
      const auto &nodes = surface.faces()[f].nodes;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          // Not normalized before they are summed: faces weigh by their areas, and the sum is a
          // polynomial of the positions.
          unit[nodes[k]] += area_vector(tangents<dim>(shape.at_node(k), nodes, positions));
          touched[nodes[k]] = true;
        }
    }
  for (unsigned int node = 0; node < unit.size(); ++node)
    if (touched[node])
      {
        length[node] = unit[node].norm();
        // Written so that NaN is caught as well.
        if (!(length[node] > 0.) || !std::isfinite(length[node]))
          {
            std::ostringstream message;
            message << "the contact faces at (" << positions[node]
                    << ") are tangled: they have no normal";
            throw TangledMesh(message.str());
          }
        unit[node] /= length[node];
      }
}

template <int dim>
typename NodalNormals<dim>::Field NodalNormals<dim>::derivative(const Field &velocity) const
{
  Field result(surface.n_nodes());
  for (const unsigned int f : faces)
    {
      const auto &nodes = surface.faces()[f].nodes;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        result[nodes[k]] +=
          area_vector_derivative(tangents<dim>(shape.at_node(k), nodes, positions),
                                 tangents<dim>(shape.at_node(k), nodes, velocity));
    }
  for (unsigned int node = 0; node < result.size(); ++node)
    // Nodes of other faces have length 0 and no derivative.
    if (length[node] > 0.)
      result[node] = unit_vector_derivative(unit[node], length[node], result[node]);
  return result;
}

/// The chain backwards: unit normal, sum of area vectors, tangents, nodes of each face.
template <int dim>
void NodalNormals<dim>::add_transpose(const Field &normal_gradient, Field &gradient) const
{
  for (const unsigned int f : faces)
    {
      const auto &nodes = surface.faces()[f].nodes;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          const auto &values = shape.at_node(k);
          const auto  t_gradient =
            // (I - n n')/|a| is symmetric: the same function serves derivative and transpose.
            area_vector_transpose(tangents<dim>(values, nodes, positions),
                                  unit_vector_derivative(unit[nodes[k]], length[nodes[k]],
                                                         normal_gradient[nodes[k]]));
          for (unsigned int j = 0; j < nodes.size(); ++j)
            for (int i = 0; i < dim - 1; ++i)
              gradient[nodes[j]] += values.gradient[j][i] * t_gradient[i];
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
