#include <snug/state/body_boxes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::state {
template <int dim>
std::vector<BodyBox<dim>> body_boxes(const mesh::BodyMesh<dim> &mesh)
{
  const unsigned int n = mesh.n_bodies();
  // Store the maxima of x and of -x, so that one reduction finds both ends. Ranks without a body
  // keep the lowest number.
  std::vector<double> largest(2 * dim * n, -std::numeric_limits<double>::max());
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double x  = mesh.reference_positions()[node][c];
        double      *of = &largest[2 * dim * mesh.body_of_node(node)];
        of[c]           = std::max(of[c], x);
        of[dim + c]     = std::max(of[dim + c], -x);
      }
  dealii::Utilities::MPI::max(largest, mesh.communicator(), largest);
  std::vector<BodyBox<dim>> boxes(n);
  for (unsigned int body = 0; body < n; ++body)
    {
      double square = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const double upper    = largest[2 * dim * body + c];
          const double lower    = -largest[2 * dim * body + dim + c];
          boxes[body].centre[c] = (upper + lower) / 2;
          square += (upper - lower) * (upper - lower) / 4;
        }
      boxes[body].length = std::sqrt(square);
    }
  return boxes;
}

template std::vector<BodyBox<2>> body_boxes(const mesh::BodyMesh<2> &);
template std::vector<BodyBox<3>> body_boxes(const mesh::BodyMesh<3> &);
} // namespace snug::state
