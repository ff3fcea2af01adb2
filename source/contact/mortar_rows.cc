#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/shared_work.h>
#include <snug/contact/mortar_rows.h>

#include <cmath>

namespace snug::contact {
template <int dim>
template <typename Number>
mortar::FaceIntegrals<Number>
MortarRows<dim>::integrals(const SlaveFace &face, const mortar::FaceNodes<dim, Number> &x) const
{
  std::vector<mortar::MortarFace<dim, Number>> masters;
  for (const unsigned int master : face.masters)
    masters.push_back(mortar::mortar_face<dim>(surface, shape, master, x));
  return mortar::integrate<dim>(quadrature, mortar::mortar_face<dim>(surface, shape, face.face, x),
                                masters);
}

/// Return the costs of the slave faces, because cutting a pair of faces takes most of the time.
template <int dim>
std::vector<double> MortarRows<dim>::costs() const
{
  std::vector<double> result;
  for (const SlaveFace &face : faces)
    result.push_back(double(face.masters.size()));
  return result;
}

template <int dim>
template <typename Number>
std::vector<mortar::FaceIntegrals<Number>>
MortarRows<dim>::all_integrals(const mortar::FaceNodes<dim, Number> &x) const
{
  const auto numbers = shared_work(surface.communicator(), costs(), [&](const unsigned int f) {
    return mortar::to_numbers(integrals(faces[f], x));
  });
  std::vector<mortar::FaceIntegrals<Number>> result;
  for (unsigned int f = 0; f < faces.size(); ++f)
    result.push_back(mortar::from_numbers<dim, Number>(
      narrow<unsigned int>(surface.faces()[faces[f].face].nodes.size()),
      narrow<unsigned int>(faces[f].masters.size()), numbers[f].begin()));
  return result;
}

/// Add the parts of rows that are integrals over one slave face.
template <int dim>
template <typename Number>
void MortarRows<dim>::add_face(const SlaveFace                      &face,
                               const mortar::FaceIntegrals<Number>  &of_shapes,
                               const mortar::FaceNodes<dim, Number> &x,
                               std::vector<RowSum<Number>>          &sums) const
{
  const auto  coupling = mortar::couple(of_shapes, face.functions);
  const auto &nodes    = surface.faces()[face.face].nodes;
  // Add int psi_j N at one node of a face to the coefficient and to the gap.
  const auto add = [&](unsigned int j, unsigned int node, const Number &integral) {
    for (const auto &share : multipliers.shares[nodes[j]])
      {
        RowSum<Number> &sum    = sums[share.first];
        const Number    shared = share.second * integral;
        for_each_place(share.first, node, [&](unsigned int place, double weight) {
          sum.coefficients[place] += weight * shared;
        });
        for (int d = 0; d < dim; ++d)
          // Hanging nodes enter the gap at their own position, because the gap is that between the
          // actual faces. The coefficients of hanging nodes went to their masters.
          sum.offset[d] -= shared * x[node][d];
      }
  };
  for (unsigned int j = 0; j < nodes.size(); ++j)
    {
      for (const auto &share : multipliers.shares[nodes[j]])
        {
          sums[share.first].area += share.second * coupling.multiplier[j];
          for (int d = 0; d < dim; ++d)
            sums[share.first].offset[d] += share.second * coupling.multiplier_offset(j, d);
        }
      for (unsigned int l = 0; l < nodes.size(); ++l)
        // The other integrals are zero up to round-off, and the row may not contain their nodes.
        if (!face.functions.are_nodal() || l == j)
          add(j, nodes[l], coupling.multiplier_slave(j, l));
      for (unsigned int f = 0; f < face.masters.size(); ++f)
        {
          const auto &master = surface.faces()[face.masters[f]].nodes;
          for (unsigned int k = 0; k < master.size(); ++k)
            {
              add(j, master[k], -coupling.multiplier_master[f](j, k));
              for (const auto &share : multipliers.shares[nodes[j]])
                for_each_place(share.first, master[k], [&](unsigned int place, double weight) {
                  // Absolute values are needed, because weights and shares of hanging nodes of
                  // degree 2 may be negative.
                  sums[share.first].weights[place] +=
                    std::abs(weight * share.second) * of_shapes.weights[f](j, k);
                });
            }
        }
    }
}

template <int dim>
template <typename Number>
std::vector<typename MortarRows<dim>::template RowSum<Number>>
MortarRows<dim>::row_sums(const mortar::FaceNodes<dim, Number> &x) const
{
  std::vector<RowSum<Number>> sums(row_nodes.size());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      sums[i].coefficients.resize(row_nodes[i].size());
      sums[i].weights.resize(row_nodes[i].size());
    }
  const auto parts = all_integrals<Number>(x);
  for (unsigned int f = 0; f < faces.size(); ++f)
    add_face(faces[f], parts[f], x, sums);
  for (const auto &sum : sums)
    // The area must be positive, because the row is divided by it.
    if (!(faces::value_of(sum.area) > 0.))
      throw TangledMesh("the master side has moved away from contact "
                        "nodes that it was opposite to");
  return sums;
}

template <int dim>
template <typename Number>
mortar::MomentCorrection<dim, Number>
MortarRows<dim>::correction(unsigned int                          i,
                            const RowSum<Number>                 &sum,
                            const mortar::FaceNodes<dim, Number> &x,
                            const std::array<Number, dim>        &n) const
{
  mortar::FaceNodes<dim, Number> relative;
  for (const unsigned int node : row_nodes[i])
    {
      relative.push_back(x[node]);
      for (int d = 0; d < dim; ++d)
        relative.back()[d] -= x[multipliers.nodes[i]][d];
    }
  return {relative, sum.coefficients, sum.weights, n};
}

/// Leave out hanging nodes, because they have no unknowns on which a force could act.
template <int dim>
std::vector<DependentMultiplier> MortarRows<dim>::dependent_multipliers() const
{
  std::vector<bool> own(surface.n_nodes(), false);
  for (const unsigned int node : multipliers.nodes)
    own[node] = true;
  std::vector<DependentMultiplier> result;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (!own[node] && surface.masters(node).empty() && !multipliers.shares[node].empty())
      result.push_back({node, multipliers.shares[node]});
  return result;
}

template <int dim>
std::vector<Row<dim>> MortarRows<dim>::rows(const Field &positions) const
{
  const SupportedNormals<dim> normals(surface, sides.slave, shape, positions, held);
  const auto                  x    = mortar::node_arrays<dim>(positions);
  const auto                  n    = mortar::node_arrays<dim>(normals.normals());
  const auto                  sums = row_sums<double>(x);
  std::vector<Row<dim>>       result(sums.size());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      Row<dim> &row = result[i];
      row.normal    = normals.normals()[multipliers.nodes[i]];
      for (int d = 0; d < dim; ++d)
        row.gap += row.normal[d] * sums[i].offset[d] / sums[i].area;
      const auto corrected = correction(i, sums[i], x, n[multipliers.nodes[i]]);
      for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
        row.coefficients.emplace_back(row_nodes[i][k],
                                      (sums[i].coefficients[k] - corrected.masses()[k]) /
                                        sums[i].area * row.normal);
    }
  return result;
}

template <int dim>
std::vector<Row<dim>> MortarRows<dim>::row_derivatives(const Field &positions,
                                                       const Field &velocity) const
{
  const SupportedNormals<dim> normals(surface, sides.slave, shape, positions, held);
  const Field                 normal_slopes = normals.derivative(velocity);
  // One pass over the segments gives values and derivatives, which are exact through cuts and
  // projections.
  const auto            x          = mortar::node_arrays<dim>(positions, velocity);
  const auto            with_slope = mortar::node_arrays<dim>(normals.normals(), normal_slopes);
  const auto            sums       = row_sums<faces::Differential<1>>(x);
  std::vector<Row<dim>> result(sums.size());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      const auto &n   = normals.normals()[multipliers.nodes[i]];
      Row<dim>   &row = result[i];
      row.normal      = normal_slopes[multipliers.nodes[i]];
      for (int d = 0; d < dim; ++d)
        {
          const auto mean = sums[i].offset[d] / sums[i].area;
          row.gap += row.normal[d] * mean.value + n[d] * mean.slope[0];
        }
      const auto corrected = correction(i, sums[i], x, with_slope[multipliers.nodes[i]]);
      for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
        {
          const auto c = (sums[i].coefficients[k] - corrected.masses()[k]) / sums[i].area;
          row.coefficients.emplace_back(row_nodes[i][k], c.value * row.normal + c.slope[0] * n);
        }
    }
  return result;
}

template <int dim>
std::vector<double> MortarRows<dim>::areas(const Field &positions) const
{
  std::vector<double> result;
  for (const auto &sum : row_sums<double>(mortar::node_arrays<dim>(positions)))
    result.push_back(sum.area);
  return result;
}

template class MortarRows<2>;
template class MortarRows<3>;
#define SNUG_INSTANTIATE(dim)                                                         \
  template std::vector<mortar::FaceIntegrals<double>> MortarRows<dim>::all_integrals( \
    const mortar::FaceNodes<dim, double> &) const;                                    \
  template mortar::FaceIntegrals<double> MortarRows<dim>::integrals(                  \
    const SlaveFace &, const mortar::FaceNodes<dim, double> &) const;                 \
  template std::vector<MortarRows<dim>::RowSum<double>> MortarRows<dim>::row_sums(    \
    const mortar::FaceNodes<dim, double> &) const;                                    \
  template mortar::MomentCorrection<dim, double> MortarRows<dim>::correction(         \
    unsigned int, const RowSum<double> &, const mortar::FaceNodes<dim, double> &,     \
    const std::array<double, dim> &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
