#include <snug/elasticity/element.h>
#include <snug/io/nodal_stress.h>
#include <snug/io/shared_nodes.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace snug
{
  namespace io
  {
    namespace
    {
      /// Coordinate in [0,1] of Gauss point @p i of @p n = 1 or 2.
      double
      gauss_coordinate(unsigned int n, unsigned int i)
      {
        return n == 1 ? 0.5 : 0.5 + (i == 0 ? -0.5 : 0.5) / std::sqrt(3.);
      }

      /// Weight of Gauss point @p i of @p n in the value at @p x.
      double
      gauss_weight(unsigned int n, unsigned int i, double x)
      {
        if (n == 1)
          return 1.;
        const double other = gauss_coordinate(n, 1 - i);
        return (x - other) / (gauss_coordinate(n, i) - other);
      }

      /// Digit @p axis of @p index in base @p base.
      unsigned int
      tensor_index(unsigned int index, unsigned int base, unsigned int axis)
      {
        for (unsigned int k = 0; k < axis; ++k)
          index /= base;
        return index % base;
      }

      template <int dim>
      struct StressSampling
      {
        std::vector<dealii::Point<dim>>  points;  ///< p^dim Gauss points
        std::vector<std::vector<double>> weights; ///< [node][point]
      };

      template <int dim>
      StressSampling<dim>
      stress_sampling(unsigned int degree)
      {
        const unsigned int n_points =
          dealii::Utilities::fixed_power<dim>(degree);
        const unsigned int n_nodes =
          dealii::Utilities::fixed_power<dim>(degree + 1);
        StressSampling<dim> sampling;
        sampling.points.resize(n_points);
        sampling.weights.assign(n_nodes, std::vector<double>(n_points, 1.));
        for (unsigned int q = 0; q < n_points; ++q)
          for (unsigned int k = 0; k < dim; ++k)
            {
              const unsigned int i  = tensor_index(q, degree, k);
              sampling.points[q][k] = gauss_coordinate(degree, i);
              for (unsigned int a = 0; a < n_nodes; ++a)
                sampling.weights[a][q] *=
                  gauss_weight(degree,
                               i,
                               double(tensor_index(a, degree + 1, k)) / degree);
            }
        return sampling;
      }

      /// Per local node: weighted sums of the components of stress and of the
      /// out-of-plane stress, and the sum of weights, over this rank's cells.
      template <int dim>
      std::vector<double>
      stress_sums(const mesh::BodyMesh<dim>                 &mesh,
                  const std::vector<elasticity::Material>   &materials,
                  const typename mesh::BodyMesh<dim>::Field &positions,
                  const typename mesh::BodyMesh<dim>::Field &displacement)
      {
        constexpr unsigned int n_stress =
          dealii::SymmetricTensor<2, dim>::n_independent_components;
        const elasticity::Element<dim> element(mesh.degree());
        const auto          sampling = stress_sampling<dim>(mesh.degree());
        std::vector<double> sums(std::size_t(n_stress + 2) *
                                 mesh.n_local_nodes());
        for (const auto &cell : mesh.cells())
          {
            typename elasticity::Element<dim>::Nodes X, u;
            for (const unsigned int node : cell.nodes)
              {
                X.push_back(positions[node]);
                u.push_back(displacement[node]);
              }
            const double weight = 1. / element.volume(X);
            for (unsigned int q = 0; q < sampling.points.size(); ++q)
              {
                double     out_of_plane = 0.;
                const auto stress       = element.stress(
                  X, materials[cell.body], u, sampling.points[q], out_of_plane);
                for (unsigned int a = 0; a < X.size(); ++a)
                  {
                    const double factor = weight * sampling.weights[a][q];
                    double      *sum =
                      &sums[std::size_t(n_stress + 2) * cell.nodes[a]];
                    for (unsigned int c = 0; c < n_stress; ++c)
                      sum[c] += factor * stress.access_raw_entry(c);
                    sum[n_stress] += factor * out_of_plane;
                    sum[n_stress + 1] += factor;
                  }
              }
          }
        return sums;
      }
    } // namespace

    template <int dim>
    NodalStress<dim>
    nodal_stress(const mesh::BodyMesh<dim>                 &mesh,
                 const std::vector<elasticity::Material>   &materials,
                 const typename mesh::BodyMesh<dim>::Field &positions,
                 const typename mesh::BodyMesh<dim>::Field &displacement)
    {
      constexpr unsigned int n_stress =
        dealii::SymmetricTensor<2, dim>::n_independent_components;
      AssertDimension(materials.size(), mesh.n_bodies());
      auto sums = stress_sums(mesh, materials, positions, displacement);
      sum_at_shared_nodes(mesh, n_stress + 2, sums);

      NodalStress<dim> result;
      result.stress.resize(mesh.n_local_nodes());
      result.out_of_plane.resize(mesh.n_local_nodes());
      for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
        {
          const double *sum    = &sums[std::size_t(n_stress + 2) * node];
          const double  weight = sum[n_stress + 1];
          Assert(weight > 0., dealii::ExcInternalError());
          for (unsigned int c = 0; c < n_stress; ++c)
            result.stress[node].access_raw_entry(c) = sum[c] / weight;
          result.out_of_plane[node] = sum[n_stress] / weight;
        }
      for (const auto &hanging : mesh.hanging())
        {
          dealii::SymmetricTensor<2, dim> stress;
          double                          out_of_plane = 0.;
          for (const auto &master : hanging.masters)
            {
              stress += master.second * result.stress[master.first];
              out_of_plane += master.second * result.out_of_plane[master.first];
            }
          result.stress[hanging.node]       = stress;
          result.out_of_plane[hanging.node] = out_of_plane;
        }
      return result;
    }

    template NodalStress<2>
    nodal_stress(const mesh::BodyMesh<2> &,
                 const std::vector<elasticity::Material> &,
                 const mesh::BodyMesh<2>::Field &,
                 const mesh::BodyMesh<2>::Field &);
    template NodalStress<3>
    nodal_stress(const mesh::BodyMesh<3> &,
                 const std::vector<elasticity::Material> &,
                 const mesh::BodyMesh<3>::Field &,
                 const mesh::BodyMesh<3>::Field &);
  } // namespace io
} // namespace snug
