#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/shared_work.h>
#include <snug/contact/mortar_rows.h>
#include <snug/contact/row_derivatives.h>
#include <snug/mortar/moment_correction.h>

#include <cmath>
#include <sstream>

namespace snug::contact {
template <int dim>
template <typename Number>
std::vector<mortar::MortarFace<dim, Number>> MortarRows<dim>::masters(const SlaveFace      &face,
                                                                      const Points<Number> &x) const
{
  std::vector<mortar::MortarFace<dim, Number>> result;
  for (const unsigned int master : face.masters)
    result.push_back(mortar::mortar_face(surface, shape, master, x));
  return result;
}

template <int dim>
template <typename Number>
mortar::FaceIntegrals<Number> MortarRows<dim>::integrals(const SlaveFace      &face,
                                                         const Points<Number> &x,
                                                         const Points<Number> &n) const
{
  return mortar::integrate<dim>(quadrature, normals.slave_face(face.face, x, n), masters(face, x));
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
void MortarRows<dim>::for_each_integrals(const Points<Number>       &x,
                                         const Points<Number>       &n,
                                         const UseIntegrals<Number> &use) const
{
  auto numbers = shared_work(surface.communicator(), costs(), [&](const unsigned int f) {
    return mortar::to_numbers(integrals(faces[f], x, n));
  });
  for (unsigned int f = 0; f < faces.size(); ++f)
    {
      use(f, mortar::from_numbers<dim, Number>(
               narrow<unsigned int>(surface.faces()[faces[f].face].nodes.size()),
               narrow<unsigned int>(faces[f].masters.size()), numbers[f].begin()));
      std::vector<double>().swap(numbers[f]);
    }
}

template <int dim>
template <typename Number, typename Sums, typename Add>
void MortarRows<dim>::for_each_part(const FacePart<Number> &part, Sums &sums, const Add &add) const
{
  const SlaveFace &face     = part.face;
  const auto       coupling = mortar::couple(part.integrals, face.functions);
  const auto      &nodes    = surface.faces()[face.face].nodes;
  // Add int psi_j N at one node of a face to the coefficient and to the gap.
  const auto add_node = [&](unsigned int j, unsigned int node, const Number &integral) {
    const dealii::Tensor<1, dim, Number> place = part.x[node] - part.origin;
    for (const auto &[row, share] : face.shares[j])
      {
        auto        &sum    = sums[row];
        const Number shared = share * integral;
        for_each_place(row, node, [&](unsigned int place_in_row, double weight) {
          add(weight * shared, sum.coefficients[place_in_row]);
        });
        for (int d = 0; d < dim; ++d)
          // Hanging nodes enter the gap at their own position, because the gap is that between the
          // actual faces. The coefficients of hanging nodes went to their masters.
          add(-(shared * place[d]), sum.offset[d]);
      }
  };
  for (unsigned int j = 0; j < nodes.size(); ++j)
    {
      for (const auto &[row, share] : face.shares[j])
        {
          add(share * coupling.multiplier[j], sums[row].area);
          for (int d = 0; d < dim; ++d)
            add(share * coupling.multiplier_offset(j, d), sums[row].offset[d]);
        }
      for (unsigned int l = 0; l < nodes.size(); ++l)
        // The other integrals are zero up to round-off, and the row may not contain their nodes.
        if (!face.functions.are_nodal() || l == j)
          add_node(j, nodes[l], coupling.multiplier_slave(j, l));
      for (unsigned int f = 0; f < face.masters.size(); ++f)
        {
          const auto &master = surface.faces()[face.masters[f]].nodes;
          for (unsigned int k = 0; k < master.size(); ++k)
            {
              add_node(j, master[k], -coupling.multiplier_master[f](j, k));
              for (const auto &share : face.shares[j])
                for_each_place(share.first, master[k], [&](unsigned int place, double weight) {
                  // Absolute values are needed, because weights and shares of hanging nodes of
                  // degree 2 may be negative.
                  add(std::abs(weight * share.second) * part.integrals.weights[f](j, k),
                      sums[share.first].weights[place]);
                });
            }
        }
    }
}

template <int dim>
template <typename Number>
std::vector<typename MortarRows<dim>::template RowSum<Number>>
MortarRows<dim>::row_sums(const Points<Number> &x, const Points<Number> &n) const
{
  std::vector<RowSum<Number>> sums;
  for (const auto &nodes : row_nodes)
    sums.emplace_back(nodes.size());
  for_each_integrals<Number>(x, n, [&](const unsigned int f, const auto &part) {
    for_each_part(FacePart<Number>{faces[f], part, x}, sums,
                  [](const Number &number, Number &entry) { entry += number; });
  });
  for (unsigned int i = 0; i < sums.size(); ++i)
    // The area must be positive, because the row is divided by it.
    if (!(faces::value_of(sums[i].area) > 0.))
      {
        std::ostringstream place;
        place << x.values()[multipliers.nodes[i]];
        throw TangledMesh("the master side has moved away from the contact node at (" +
                          place.str() + ") that it was opposite to");
      }
  return sums;
}

template <int dim>
template <typename Number>
Row<dim, Number> MortarRows<dim>::row(const unsigned int    i,
                                      const RowSum<Number> &sum,
                                      const Points<Number> &x,
                                      const Points<Number> &n) const
{
  const unsigned int                          slave = multipliers.nodes[i];
  std::vector<dealii::Tensor<1, dim, Number>> relative;
  for (const unsigned int node : row_nodes[i])
    relative.push_back(x[node] - x[slave]);
  Row<dim, Number> result;
  result.normal = n[slave];
  for (int d = 0; d < dim; ++d)
    result.gap += result.normal[d] * sum.offset[d] / sum.area;
  const auto masses =
    mortar::moment_correction(relative, sum.coefficients, sum.weights, result.normal);
  for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
    result.coefficients.emplace_back(row_nodes[i][k],
                                     (sum.coefficients[k] - masses[k]) / sum.area * result.normal);
  return result;
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
  const auto            at_positions = normals.at(positions);
  const Points<double>  x(positions), n(at_positions.normals());
  const auto            sums = row_sums(x, n);
  std::vector<Row<dim>> result;
  for (unsigned int i = 0; i < sums.size(); ++i)
    result.push_back(row(i, sums[i], x, n));
  return result;
}

/// One pass over the segments gives values and derivatives, which are exact through cuts and
/// projections.
template <int dim>
std::vector<Row<dim>> MortarRows<dim>::row_derivatives(const Field &positions,
                                                       const Field &velocity) const
{
  const auto                           at_positions = normals.at(positions);
  const Field                          slopes       = at_positions.derivative(velocity);
  const Points<faces::Differential<1>> x(positions, velocity), n(at_positions.normals(), slopes);
  const auto                           sums = row_sums(x, n);
  std::vector<Row<dim>>                result;
  for (unsigned int i = 0; i < sums.size(); ++i)
    result.push_back(derivative_of(row(i, sums[i], x, n)));
  return result;
}

template <int dim>
std::vector<double> MortarRows<dim>::areas(const Field &positions) const
{
  const auto           at_positions = normals.at(positions);
  const Points<double> x(positions), n(at_positions.normals());
  std::vector<double>  result;
  for (const auto &sum : row_sums(x, n))
    result.push_back(sum.area);
  return result;
}

template <int dim>
std::vector<double> MortarRows<dim>::area_derivatives(const Field &positions,
                                                      const Field &velocity) const
{
  const auto                           at_positions = normals.at(positions);
  const Field                          slopes       = at_positions.derivative(velocity);
  const Points<faces::Differential<1>> x(positions, velocity), n(at_positions.normals(), slopes);
  std::vector<faces::Differential<1>>  result;
  for (const auto &sum : row_sums(x, n))
    result.push_back(sum.area);
  return slopes_of(result);
}

/// Record one row at a time, as a function of its sum, positions and normals.
template <int dim>
std::vector<typename MortarRows<dim>::template RowSum<double>>
MortarRows<dim>::add_sum_derivatives(const Field                       &positions,
                                     const Field                       &of_nodes,
                                     const std::vector<RowSlopes<dim>> &of_rows,
                                     Field                             &gradient,
                                     Field                             &normal_gradient) const
{
  SNUG_ASSERT_EQUAL(of_rows.size(), multipliers.nodes.size());
  auto             sums = row_sums(Points<double>(positions), Points<double>(of_nodes));
  faces::Recording recording;
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      if (of_rows[i].coefficients.empty())
        {
          sums[i] = RowSum<double>(row_nodes[i].size());
          continue;
        }
      recording.clear();
      const Points<faces::Recorded> x(positions, recording), n(of_nodes, recording);
      RowSum<faces::Recorded>       sum(row_nodes[i].size());
      const auto                    for_each_number = [&](const auto &visit) {
        for (unsigned int k = 0; k < row_nodes[i].size(); ++k)
          {
            visit(sum.coefficients[k], sums[i].coefficients[k]);
            visit(sum.weights[k], sums[i].weights[k]);
          }
        for (int d = 0; d < dim; ++d)
          visit(sum.offset[d], sums[i].offset[d]);
        visit(sum.area, sums[i].area);
      };
      for_each_number(
        [&](auto &variable, const double value) { variable = recording.variable(value); });
      add_slopes(row(i, sum, x, n), of_rows[i], recording);
      recording.sweep();
      x.add_derivatives(gradient);
      n.add_derivatives(normal_gradient);
      for_each_number(
        [&](const auto &variable, double &slope) { slope = recording.derivative(variable); });
    }
  return sums;
}

template <int dim>
void MortarRows<dim>::add_gradient(const Field                       &positions,
                                   const std::vector<RowSlopes<dim>> &slopes,
                                   Field                             &gradient) const
{
  const auto at_positions = normals.at(positions);
  Field      normal_gradient(surface.n_nodes());
  const auto of_sums =
    add_sum_derivatives(positions, at_positions.normals(), slopes, gradient, normal_gradient);
  at_positions.add_transpose(normal_gradient, gradient);
  add_sums_gradient(of_sums, positions, at_positions, gradient);
}

template <int dim>
void MortarRows<dim>::add_area_gradient(const Field               &positions,
                                        const std::vector<double> &factors,
                                        Field                     &gradient) const
{
  SNUG_ASSERT_EQUAL(factors.size(), multipliers.nodes.size());
  std::vector<RowSum<double>> slopes;
  for (unsigned int i = 0; i < factors.size(); ++i)
    {
      slopes.emplace_back(row_nodes[i].size());
      slopes.back().area = factors[i];
    }
  add_sums_gradient(slopes, positions, normals.at(positions), gradient);
}

template <int dim>
void MortarRows<dim>::add_sums_gradient(const std::vector<RowSum<double>>         &slopes,
                                        const Field                               &positions,
                                        const typename MortarNormals<dim>::Values &at_positions,
                                        Field                                     &gradient) const
{
  Field of_directions(surface.n_nodes());
  for (const SlaveFace &face : faces)
    add_face_gradient(face, slopes, positions, at_positions.normals(), gradient, of_directions);
  at_positions.add_transpose(of_directions, gradient);
}

/// Add the derivatives with respect to the positions of one slave face and its masters, and with
/// respect to the normals of its nodes, from which its direction follows. First the sums are
/// recorded as functions of the integrals and positions, then the integrals.
template <int dim>
void MortarRows<dim>::add_face_gradient(const SlaveFace                   &face,
                                        const std::vector<RowSum<double>> &slopes,
                                        const Field                       &positions,
                                        const Field                       &of_nodes,
                                        Field                             &gradient,
                                        Field                             &normal_gradient) const
{
  const auto &nodes = surface.faces()[face.face].nodes;
  // Skip open faces, which are most of the slave side, because cutting segments is expensive.
  const bool counts = std::any_of(face.shares.begin(), face.shares.end(), [&](const auto &shares) {
    return std::any_of(shares.begin(), shares.end(), [&](const auto &share) {
      const auto &slope = slopes[share.first];
      return slope.area != 0. || slope.offset.norm_square() > 0.;
    });
  });
  if (!counts)
    return;

  auto       of_shapes = integrals(face, Points<double>(positions), Points<double>(of_nodes));
  const auto n         = narrow<unsigned int>(nodes.size());
  const auto n_masters = narrow<unsigned int>(face.masters.size());
  {
    faces::Recording              recording;
    const Points<faces::Recorded> x(positions, recording);
    auto variables = mortar::zero_integrals<dim, faces::Recorded>(n, n_masters);
    auto values    = mortar::to_numbers(of_shapes);
    auto next      = values.begin();
    mortar::for_each_number(variables, [&](auto &number) { number = recording.variable(*next++); });
    // The integrals of psi_j (1 - 1) vanish, so positions may be measured from any origin.
    for_each_part(FacePart<faces::Recorded>{face, variables, x, positions[nodes[0]]}, slopes,
                  [&](const faces::Recorded &number, const double slope) {
                    recording.add(number, slope);
                  });
    recording.sweep();
    x.add_derivatives(gradient);
    next = values.begin();
    mortar::for_each_number(variables,
                            [&](auto &number) { *next++ = recording.derivative(number); });
    of_shapes = mortar::from_numbers<dim, double>(n, n_masters, values.begin());
  }
  faces::Recording              recording;
  const Points<faces::Recorded> x(positions, recording), m(of_nodes, recording);
  mortar::add_integral_derivatives(quadrature, normals.slave_face(face.face, x, m),
                                   masters(face, x), of_shapes, recording);
  recording.sweep();
  x.add_derivatives(gradient);
  m.add_derivatives(normal_gradient);
}

template class MortarRows<2>;
template class MortarRows<3>;
#define SNUG_INSTANTIATE(dim)                                               \
  template void MortarRows<dim>::for_each_integrals(const Points<double> &, \
                                                    const Points<double> &, \
                                                    const UseIntegrals<double> &) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
