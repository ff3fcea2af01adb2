#include <snug/base/errors.h>
#include <snug/state/body_extents.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace snug
{
  namespace state
  {
    template <int dim>
    void
    measure_bodies(const mesh::BodyMesh<dim>           &mesh,
                   std::vector<dealii::Tensor<1, dim>> &centres,
                   std::vector<double>                 &lengths)
    {
      const unsigned int  n = mesh.n_bodies();
      std::vector<double> largest(2 * dim * n,
                                  -std::numeric_limits<double>::max());
      for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double x  = mesh.reference_positions()[node][c];
            double      *of = &largest[2 * dim * mesh.body_of_node(node)];
            of[c]           = std::max(of[c], x);
            of[dim + c]     = std::max(of[dim + c], -x);
          }
      dealii::Utilities::MPI::max(largest, mesh.communicator(), largest);
      centres.resize(n);
      lengths.resize(n);
      for (unsigned int body = 0; body < n; ++body)
        {
          double square = 0.;
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double upper = largest[2 * dim * body + c];
              const double lower = -largest[2 * dim * body + dim + c];
              centres[body][c]   = (upper + lower) / 2;
              square += (upper - lower) * (upper - lower) / 4;
            }
          lengths[body] = std::sqrt(square);
        }
    }
    template <int dim>
    void
    check_radii(const mesh::BodyMesh<dim>      &mesh,
                const std::vector<std::string> &body_names)
    {
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
            text << "entry 'Model' = 'axisymmetric': body " << body_names[body]
                 << " reaches x = " << smallest[body]
                 << ", but x is the radius and must not be negative";
            throw InputError(text.str());
          }
    }

    template <int dim>
    void
    check_axis(const mesh::BodyMesh<dim>                 &mesh,
               const typename mesh::BodyMesh<dim>::Field &positions,
               double                                     length)
    {
      const double round_off = 1e-10;
      for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
        if (mesh.reference_positions()[node][0] == 0. &&
            std::abs(positions[node][0]) > round_off * length)
          {
            std::ostringstream text;
            text << "the design moves the node at ("
                 << mesh.reference_positions()[node]
                 << ") off the axis of the axisymmetric model";
            throw TangledMesh(text.str());
          }
    }

#define SNUG_INSTANTIATE(dim)                                         \
  template void measure_bodies(const mesh::BodyMesh<dim> &,           \
                               std::vector<dealii::Tensor<1, dim>> &, \
                               std::vector<double> &);                \
  template void check_radii(const mesh::BodyMesh<dim> &,              \
                            const std::vector<std::string> &);        \
  template void check_axis(const mesh::BodyMesh<dim> &,               \
                           const mesh::BodyMesh<dim>::Field &,        \
                           double);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace state
} // namespace snug
