#include <snug/io/bounding_box.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace snug::io {
namespace {
/// Return the bounding box of the @p points of all ranks. Collective.
template <int dim>
BoundingBox<dim> box_of(const std::vector<dealii::Tensor<1, dim>> &points, MPI_Comm communicator)
{
  std::vector<double> ends(2 * dim, -std::numeric_limits<double>::max());
  for (const auto &x : points)
    for (unsigned int d = 0; d < dim; ++d)
      {
        ends[d]       = std::max(ends[d], x[d]);
        ends[dim + d] = std::max(ends[dim + d], -x[d]);
      }
  dealii::Utilities::MPI::max(ends, communicator, ends);
  BoundingBox<dim> box;
  for (unsigned int d = 0; d < dim; ++d)
    {
      box.upper[d] = ends[d] + 0.; // no -0
      box.lower[d] = 0. - ends[dim + d];
    }
  return box;
}
} // namespace

template <int dim>
BoundingBox<dim> box_of_body(const mesh::BodyMesh<dim> &mesh, const unsigned int body)
{
  std::vector<dealii::Tensor<1, dim>> points;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.body_of_node(node) == body)
      points.push_back(mesh.reference_positions()[node]);
  return box_of<dim>(points, mesh.communicator());
}

template <int dim>
BoundingBox<dim> box_of_side(const mesh::BodyMesh<dim> &mesh, const contact::Side &side)
{
  std::vector<dealii::Tensor<1, dim>> points;
  for (const auto &face : mesh.boundary_faces())
    if (contact::is_on(face, side))
      for (const unsigned int node : face.nodes)
        points.push_back(mesh.reference_positions()[node]);
  return box_of<dim>(points, mesh.communicator());
}

template <int dim>
double distance(const BoundingBox<dim> &a, const BoundingBox<dim> &b)
{
  dealii::Tensor<1, dim> gap;
  for (unsigned int d = 0; d < dim; ++d)
    gap[d] = std::max({0., a.lower[d] - b.upper[d], b.lower[d] - a.upper[d]});
  return gap.norm();
}

#define SNUG_INSTANTIATE(dim)                                                                \
  template BoundingBox<dim> box_of_body(const mesh::BodyMesh<dim> &, unsigned int);          \
  template BoundingBox<dim> box_of_side(const mesh::BodyMesh<dim> &, const contact::Side &); \
  template double           distance(const BoundingBox<dim> &, const BoundingBox<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
