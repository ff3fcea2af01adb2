#include <snug/contact/mortar_rows.h>
#include <snug/mortar/integral_gradient.h>

namespace snug::contact {
/// Return x + u, where hanging nodes are displaced with their masters.
template <int dim>
typename MortarRows<dim>::Field MortarRows<dim>::deformed(const Field &positions,
                                                          const Field &displacement) const
{
  Field result = positions;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    {
      // Hanging nodes have positions of their own, but no displacements.
      if (surface.masters(node).empty())
        result[node] += displacement[node];
      for (const auto &master : surface.masters(node))
        result[node] += master.second * displacement[master.first];
    }
  return result;
}

template <int dim>
void MortarRows<dim>::add_energy_gradient(const Field               &positions,
                                          const Field               &displacement,
                                          const std::vector<double> &forces,
                                          Field                     &gradient) const
{
  const SupportedNormals<dim> normals(surface, sides.slave, shape, positions, held);
  const auto                  x    = mortar::node_arrays<dim>(positions);
  const auto                  of_n = mortar::node_arrays<dim>(normals.normals());
  const auto                  sums = row_sums<double>(x);
  Energy                      energy{positions, deformed(positions, displacement), {}, {}, {}, {}};
  Field                       normal_gradient(surface.n_nodes());
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      const unsigned int     node      = multipliers.nodes[i];
      const auto            &n         = normals.normals()[node];
      const double           p         = forces[i] / sums[i].area;
      const auto             corrected = correction(i, sums[i], x, of_n[node]);
      dealii::Tensor<1, dim> r;
      for (int d = 0; d < dim; ++d)
        // r_i = int psi_i (y_slave - y_master) dA for y = x + u. The minus sign converts the offset
        // of x, which is master minus slave.
        r[d] = -sums[i].offset[d];
      std::vector<double> along_n;
      for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
        {
          const auto &u = displacement[row_nodes[i][k]];
          r += (sums[i].coefficients[k] - corrected.masses()[k]) * u;
          along_n.push_back(n * u);
        }
      normal_gradient[node] += p * r;
      energy.directions.push_back(p * n);
      // The derivatives of force / a_i n . r_i are p r_i with respect to n, p n with respect to
      // r_i, and the whole over -a_i with respect to a_i.
      energy.area_slopes.push_back(-p / sums[i].area * (n * r));

      // Differentiate the part of the correction, -p sum_k dM_k n . u_k, with respect to the data
      // that dM depends on.
      auto by = corrected.gradient(along_n);
      for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
        {
          by.coefficients[k] *= -p;
          by.weights[k] *= -p;
          for (int d = 0; d < dim; ++d)
            {
              gradient[row_nodes[i][k]][d] -= p * by.x[k][d];
              // Positions in the correction are relative to the slave node.
              gradient[node][d] += p * by.x[k][d];
            }
        }
      for (int d = 0; d < dim; ++d)
        normal_gradient[node][d] -= p * by.n[d];
      energy.coefficient_slopes.push_back(by.coefficients);
      energy.weight_slopes.push_back(by.weights);
    }
  normals.add_transpose(normal_gradient, gradient);
  for (const SlaveFace &face : faces)
    add_face_gradient(face, energy, gradient);
}

/// Set the directions of the energy to zero, so that only areas count.
template <int dim>
void MortarRows<dim>::add_area_gradient(const Field               &positions,
                                        const std::vector<double> &factors,
                                        Field                     &gradient) const
{
  AssertDimension(factors.size(), multipliers.nodes.size());
  const Energy energy{positions, positions, Field(factors.size()), factors, {}, {}};
  for (const SlaveFace &face : faces)
    add_face_gradient(face, energy, gradient);
}

/// Return the derivative of the corrections of all rows with respect to the integral of psi_j N,
/// where psi_j belongs to @p slave_node and N to @p node.
template <int dim>
double MortarRows<dim>::correction_slope(const std::vector<std::vector<double>> &slopes,
                                         unsigned int                            slave_node,
                                         unsigned int                            node,
                                         bool                                    absolute) const
{
  double sum = 0.;
  if (!slopes.empty())
    for (const auto &share : multipliers.shares[slave_node])
      for_each_place(share.first, node, [&](unsigned int place, double weight) {
        const double factor = weight * share.second;
        sum += (absolute ? std::abs(factor) : factor) * slopes[share.first][place];
      });
  return sum;
}

template <int dim>
void MortarRows<dim>::add_to_points(unsigned int                           face,
                                    const mortar::MortarFace<dim, double> &values,
                                    Field                                 &gradient) const
{
  const auto &of = surface.faces()[face];
  for (unsigned int k = 0; k < of.nodes.size(); ++k)
    for (int d = 0; d < dim; ++d)
      gradient[of.nodes[k]][d] += values.nodes[k][d];
  mortar::add_offset_gradient<dim>(of, shape, values.offsets, gradient);
}

/// Return the derivatives with respect to the integrals, from the derivatives with respect to the
/// coupling and to the weights of the corrections.
template <int dim>
mortar::FaceIntegrals<double>
MortarRows<dim>::integral_slopes(const SlaveFace                     &face,
                                 const Energy                        &energy,
                                 const mortar::FaceIntegrals<double> &of_shapes,
                                 const mortar::FaceCoupling<double>  &to_coupling) const
{
  const auto        &nodes = surface.faces()[face.face].nodes;
  const unsigned int n     = nodes.size();
  auto to_integrals        = mortar::couple_transpose(of_shapes, face.functions, to_coupling);
  for (const unsigned int master : face.masters)
    {
      to_integrals.weights.emplace_back(n, n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          to_integrals.weights.back()(j, k) =
            correction_slope(energy.weight_slopes, nodes[j], surface.faces()[master].nodes[k],
                             true);
    }
  return to_integrals;
}

template <int dim>
void MortarRows<dim>::add_face_gradient(const SlaveFace &face,
                                        const Energy    &energy,
                                        Field           &gradient) const
{
  const auto        &nodes = surface.faces()[face.face].nodes;
  const unsigned int n     = nodes.size();
  // directions of the multiplier functions of the face's nodes
  Field direction(n);
  // A shared function acts in several rows, so the derivatives of these rows add up by the shares.
  std::vector<double> area_slope(n, 0.);
  for (unsigned int j = 0; j < n; ++j)
    for (const auto &share : multipliers.shares[nodes[j]])
      {
        direction[j] += share.second * energy.directions[share.first];
        area_slope[j] += share.second * energy.area_slopes[share.first];
      }
  bool counts = false;
  for (unsigned int j = 0; j < n; ++j)
    counts = counts || direction[j].norm_square() > 0. || area_slope[j] != 0.;
  // Skip open faces, which are most of the slave side, because cutting segments is expensive.
  if (!counts)
    return;

  // Compute the derivatives with respect to the positions in x + u and to the integrals. The
  // integrals of psi_j (1 - 1) vanish, so y may be measured from any origin.
  const auto origin      = energy.deformed[nodes[0]];
  const auto x           = mortar::node_arrays<dim>(energy.positions);
  const auto of_shapes   = integrals(face, x);
  const auto coupling    = mortar::couple(of_shapes, face.functions);
  auto       to_coupling = coupling;
  to_coupling.multiplier = area_slope;
  // Differentiate sum_j direction_j . int psi_j N_k y_k with respect to y_k and to the integral.
  const auto add = [&](double sign, const dealii::Table<2, double> &integral,
                       const std::vector<unsigned int> &others, dealii::Table<2, double> &slope) {
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < n; ++k)
        {
          gradient[others[k]] += sign * integral(j, k) * direction[j];
          slope(j, k) = sign * (direction[j] * (energy.deformed[others[k]] - origin));
          // Rows of biorthogonal functions contain only the node itself of the slave side.
          if (sign < 0. || !face.functions.are_nodal() || j == k)
            slope(j, k) +=
              sign * correction_slope(energy.coefficient_slopes, nodes[j], others[k], false);
        }
  };
  add(1., coupling.multiplier_slave, nodes, to_coupling.multiplier_slave);
  for (unsigned int j = 0; j < n; ++j)
    for (int d = 0; d < dim; ++d)
      to_coupling.multiplier_offset(j, d) = -direction[j][d];
  std::vector<mortar::MortarFace<dim, double>> masters;
  for (unsigned int f = 0; f < face.masters.size(); ++f)
    {
      add(-1., coupling.multiplier_master[f], surface.faces()[face.masters[f]].nodes,
          to_coupling.multiplier_master[f]);
      masters.push_back(mortar::mortar_face<dim>(surface, shape, face.masters[f], x));
    }
  const auto to_integrals = integral_slopes(face, energy, of_shapes, to_coupling);
  const auto to_points =
    mortar::integrate_transpose<dim>(quadrature,
                                     mortar::mortar_face<dim>(surface, shape, face.face, x),
                                     masters, to_integrals);
  add_to_points(face.face, to_points.slave, gradient);
  for (unsigned int f = 0; f < face.masters.size(); ++f)
    add_to_points(face.masters[f], to_points.masters[f], gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template void MortarRows<dim>::add_energy_gradient(const Field &, const Field &,                \
                                                     const std::vector<double> &, Field &) const; \
  template void MortarRows<dim>::add_area_gradient(const Field &, const std::vector<double> &,    \
                                                   Field &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
