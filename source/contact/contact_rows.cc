#include <snug/base/errors.h>
#include <snug/contact/contact_rows.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <map>

namespace snug
{
  namespace contact
  {
    namespace
    {
      /// n = v/|v|, v = -sum_k w_k n_k
      template <int dim>
      struct RowNormal
      {
        dealii::Tensor<1, dim> n;
        double                 length; ///< |v|
      };

      template <int dim>
      using SurfaceField = typename mesh::Surface<dim>::Field;

      /// sum_k w_k field_k over the masters of @p projection.
      template <int dim>
      dealii::Tensor<1, dim>
      at_master(const Projection &projection, const SurfaceField<dim> &field)
      {
        dealii::Tensor<1, dim> sum;
        for (const auto &master : projection.masters)
          sum += master.second * field[master.first];
        return sum;
      }

      template <int dim>
      RowNormal<dim>
      row_normal(const Projection        &projection,
                 const SurfaceField<dim> &nodal_normals)
      {
        const dealii::Tensor<1, dim> v =
          -1. * at_master<dim>(projection, nodal_normals);
        const double length = v.norm();
        if (!(length > 0.))
          throw TangledMesh(
            "the normals of a contact face cancel: it is folded");
        return {v / length, length};
      }

      /// The row whose coefficients are @p factors times @p n.
      template <int dim>
      Row<dim>
      make_row(const std::vector<std::pair<unsigned int, double>> &factors,
               const dealii::Tensor<1, dim>                       &n,
               double                                              gap)
      {
        Row<dim> row;
        for (const auto &factor : factors)
          row.coefficients.emplace_back(factor.first, factor.second * n);
        row.gap    = gap;
        row.normal = n;
        return row;
      }

      std::string
      name(const std::pair<unsigned int, unsigned int> &side)
      {
        return "body " + std::to_string(side.first) + " face " +
               std::to_string(side.second);
      }
    } // namespace

    template <int dim>
    NodalContact<dim>::NodalContact(const mesh::Surface<dim> &surface,
                                    const std::vector<Pair>  &pairs,
                                    unsigned int              degree,
                                    const Field              &positions)
      : surface(surface), shape(degree)
    {
      for (unsigned int p = 0; p < pairs.size(); ++p)
        {
          sides.push_back({p, {}, {}});
          for (unsigned int f = 0; f < surface.faces().size(); ++f)
            {
              const auto &face = surface.faces()[f];
              const auto  side = std::make_pair(face.body, face.boundary);
              if (side == pairs[p].slave)
                sides[p].slave.push_back(f);
              if (side == pairs[p].master)
                sides[p].master.push_back(f);
            }
          const auto projections = project(surface, sides[p], shape, positions);
          if (projections.empty())
            throw InputError(
              "contact pair " + std::to_string(p) + " (slave " +
              name(pairs[p].slave) + ", master " + name(pairs[p].master) +
              "): no slave node lies opposite to the master face");
          found.insert(found.end(), projections.begin(), projections.end());
        }
      resolve_hanging();
    }

    template <int dim>
    void
    NodalContact<dim>::resolve_hanging()
    {
      for (const Projection &projection : found)
        {
          std::map<unsigned int, double> factor;
          factor[projection.slave] = 1.;
          for (const auto &node : projection.masters)
            {
              const auto &masters = surface.masters(node.first);
              if (masters.empty())
                factor[node.first] -= node.second;
              for (const auto &master : masters)
                factor[master.first] -= node.second * master.second;
            }
          factors.emplace_back(factor.begin(), factor.end());
        }
    }

    template <int dim>
    unsigned int
    NodalContact<dim>::n_rows() const
    {
      return found.size();
    }

    template <int dim>
    const std::vector<Projection> &
    NodalContact<dim>::projections() const
    {
      return found;
    }

    template <int dim>
    std::vector<NodalNormals<dim>>
    NodalContact<dim>::master_normals(const Field &positions) const
    {
      AssertDimension(positions.size(), surface.n_nodes());
      std::vector<NodalNormals<dim>> normals;
      for (const PairFaces &side : sides)
        normals.emplace_back(surface, side.master, shape, positions);
      return normals;
    }

    template <int dim>
    std::vector<Row<dim>>
    NodalContact<dim>::rows(const Field &positions) const
    {
      const auto            normals = master_normals(positions);
      std::vector<Row<dim>> result;
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          const auto n =
            row_normal<dim>(found[i], normals[found[i].pair].normals()).n;
          const double gap = n * (at_master<dim>(found[i], positions) -
                                  positions[found[i].slave]);
          result.push_back(make_row(factors[i], n, gap));
        }
      return result;
    }

    template <int dim>
    std::vector<Row<dim>>
    NodalContact<dim>::row_derivatives(const Field &positions,
                                       const Field &velocity) const
    {
      AssertDimension(velocity.size(), surface.n_nodes());
      const auto         normals = master_normals(positions);
      std::vector<Field> normal_derivatives;
      for (const auto &side : normals)
        normal_derivatives.push_back(side.derivative(velocity));
      std::vector<Row<dim>> result;
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          const auto &projection = found[i];
          const auto  normal =
            row_normal<dim>(projection, normals[projection.pair].normals());
          const dealii::Tensor<1, dim> dv =
            -1. *
            at_master<dim>(projection, normal_derivatives[projection.pair]);
          const auto   dn = unit_vector_derivative(normal.n, normal.length, dv);
          const double dgap = dn * (at_master<dim>(projection, positions) -
                                    positions[projection.slave]) +
                              normal.n * (at_master<dim>(projection, velocity) -
                                          velocity[projection.slave]);
          result.push_back(make_row(factors[i], dn, dgap));
        }
      return result;
    }

    template <int dim>
    typename NodalContact<dim>::Field
    NodalContact<dim>::energy_gradient(const Field               &positions,
                                       const Field               &displacement,
                                       const std::vector<double> &forces) const
    {
      AssertDimension(displacement.size(), surface.n_nodes());
      AssertDimension(forces.size(), n_rows());
      const auto         normals = master_normals(positions);
      std::vector<Field> normal_gradients(sides.size(),
                                          Field(surface.n_nodes()));
      Field              gradient(surface.n_nodes());
      for (unsigned int i = 0; i < n_rows(); ++i)
        {
          const auto &projection = found[i];
          const auto  normal =
            row_normal<dim>(projection, normals[projection.pair].normals());
          // d/dn of n . (sum_b factor_b u_b - sum_k w_k x_k + x_s)
          dealii::Tensor<1, dim> n_gradient =
            positions[projection.slave] - at_master<dim>(projection, positions);
          for (const auto &factor : factors[i])
            n_gradient += factor.second * displacement[factor.first];
          const auto v_gradient =
            forces[i] *
            unit_vector_derivative(normal.n, normal.length, n_gradient);
          gradient[projection.slave] += forces[i] * normal.n;
          for (const auto &master : projection.masters)
            {
              gradient[master.first] -= forces[i] * master.second * normal.n;
              normal_gradients[projection.pair][master.first] -=
                master.second * v_gradient;
            }
        }
      for (unsigned int p = 0; p < sides.size(); ++p)
        normals[p].add_transpose(normal_gradients[p], gradient);
      return gradient;
    }

    template <int dim>
    std::vector<double>
    NodalContact<dim>::areas(const Field &positions) const
    {
      AssertDimension(positions.size(), surface.n_nodes());
      const dealii::QGauss<dim - 1>    quadrature(shape.degree() + 2);
      typename FaceShape<dim>::Values  values;
      std::vector<std::vector<double>> node_areas;
      for (const PairFaces &side : sides)
        {
          std::vector<double> share(surface.n_nodes(), 0.);
          for (const unsigned int f : side.slave)
            {
              const auto &nodes = surface.faces()[f].nodes;
              for (unsigned int q = 0; q < quadrature.size(); ++q)
                {
                  shape.evaluate(quadrature.point(q), values);
                  dealii::Tensor<1, dim> x;
                  for (unsigned int k = 0; k < nodes.size(); ++k)
                    x += values.value[k] * positions[nodes[k]];
                  const double area =
                    quadrature.weight(q) * surface.idealization().weight(x) *
                    area_vector(tangents<dim>(values, nodes, positions)).norm();
                  for (unsigned int k = 0; k < nodes.size(); ++k)
                    share[nodes[k]] += values.value[k] * area;
                }
            }
          for (unsigned int node = 0; node < share.size(); ++node)
            for (const auto &master : surface.masters(node))
              share[master.first] += master.second * share[node];
          node_areas.push_back(share);
        }
      std::vector<double> result;
      for (const Projection &projection : found)
        result.push_back(node_areas[projection.pair][projection.slave]);
      return result;
    }

    template class NodalContact<2>;
    template class NodalContact<3>;
  } // namespace contact
} // namespace snug
