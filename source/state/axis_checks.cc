#include <snug/base/errors.h>
#include <snug/state/axis_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::state {
template <int dim>
void check_radii(const mesh::BodyMesh<dim> &mesh, const std::vector<std::string> &body_names)
{
  // Start from 0, so that only negative radii appear. Radii are exact, because BodyMesh puts nodes
  // on the axis at x = 0 without round-off.
  std::vector<double> smallest(mesh.n_bodies(), 0.);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
      double &of = smallest[mesh.body_of_node(node)];
      of         = std::min(of, mesh.reference_positions()[node][0]);
    }
  dealii::Utilities::MPI::min(smallest, mesh.communicator(), smallest);
  for (unsigned int body = 0; body < smallest.size(); ++body)
    if (smallest[body] < 0.)
      {
        std::ostringstream text;
        text << "body " << body_names[body] << " reaches x = " << smallest[body]
             << ", but x is the radius and must not be negative";
        throw bad_entry("Model", "axisymmetric", text.str());
      }
}

template <int dim>
void check_axis(const mesh::BodyMesh<dim>                 &mesh,
                const typename mesh::BodyMesh<dim>::Field &positions,
                const std::vector<BodyBox<dim>>           &boxes)
{
  // The tolerance is relative to the body. A design that keeps the axis moves its nodes by
  // round-off at most.
  const double round_off = 1e-10;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    // u_r = 0 is held at the nodes that are on the axis in the reference geometry. For a node off
    // the axis, this constraint would be a support.
    if (mesh.reference_positions()[node][0] == 0. &&
        std::abs(positions[node][0]) > round_off * boxes[mesh.body_of_node(node)].length)
      {
        std::ostringstream text;
        text << "the design moves the node at (" << mesh.reference_positions()[node]
             << ") off the axis of the axisymmetric model";
        // An optimizer steps back from this error, as from tangled cells.
        throw TangledMesh(text.str());
      }
}

#define SNUG_INSTANTIATE(dim)                                                               \
  template void check_radii(const mesh::BodyMesh<dim> &, const std::vector<std::string> &); \
  template void check_axis(const mesh::BodyMesh<dim> &, const mesh::BodyMesh<dim>::Field &, \
                           const std::vector<BodyBox<dim>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
