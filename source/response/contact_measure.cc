#include <snug/response/quantities.h>

#include <algorithm>

namespace snug::response {
namespace {
/// Tributary areas below this share of the maximum area are rounding errors. They occur on
/// the axis of bodies of revolution with degree 2.
const double smallest_area = 1e-10;

/// Powers above this value are not integrable at a right-angled edge that presses on a body
/// of the same material, where the pressure is p ~ r^-0.226.
const double integrable_power = 4.4;

/// Indices of contact rows and their shares.
using Counted = std::vector<std::pair<unsigned int, double>>;

template <int dim>
class ContactMeasure : public Response<dim>
{
public:
  ContactMeasure(const ResponseParameters       &parameters,
                 const Measure                  &measure,
                 const std::vector<std::string> &entries,
                 const double                    power,
                 const AmountOf                 &amount)
    : pair(parameters.pair), measure(measure), read(entries), power(power), amount(amount)
  {
    const auto *const function =
      amount.target<Amount (*)(const state::ContactPoint &, const contact::RowFriction &)>();
    of_pressure = function != nullptr && *function == normal_force;
    of_reserve  = function != nullptr && *function == shear_reserve;
  }

  std::vector<std::string> entries() const override
  {
    auto result = read;
    // All measures read the entry Pair, besides their own entries.
    result.push_back("Pair");
    return result;
  }

  bool reads_pressure() const override { return true; }

  bool unbounded_at_edges() const override { return power > integrable_power; }

  /// The reserve jumps to zero between a node that sticks and one that slips.
  bool has_estimate() const override { return !of_reserve; }

  /// Throw if there is no such pair.
  void check(const state::StateSolver<dim> &solver) const override { row_shares(solver, pair, 0); }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    return measured_of(solver, state.load_case, all_rows(solver, state)).value;
  }

  std::optional<double> measured(const state::StateSolver<dim>   &solver,
                                 const unsigned int               load_case,
                                 const std::vector<PressureRows> &of_pairs) const override
  {
    if (!of_pressure)
      return {};
    const auto   chosen = chosen_pairs(solver, pair, load_case);
    PressureRows rows;
    for (unsigned int p = 0; p < chosen.size(); ++p)
      if (chosen[p])
        {
          // Quadratic functions between nodes may be negative where contact ends.
          for (const double force : of_pairs[p].force)
            rows.force.push_back(std::max(0., force));
          rows.area.insert(rows.area.end(), of_pairs[p].area.begin(), of_pairs[p].area.end());
        }
    return measure(rows).value;
  }

  std::optional<Measured> of_contact(const state::StateSolver<dim> &solver,
                                     const unsigned int             load_case,
                                     const PressureRows            &rows) const override
  {
    if (!of_pressure)
      return {};
    return measured_of(solver, load_case, rows);
  }

  /// J depends on u through the contact forces alone.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> & /*solver*/,
                                        const state::ContactState<dim> & /*state*/) const override
  {
    return {};
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    // In J(p, A(X)) the areas are functions of the positions at fixed forces.
    auto          measured = measured_of(solver, state.load_case, all_rows(solver, state));
    const auto   &contact  = solver.contact(state.load_case);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    std::vector<Amount> amounts;
    for (unsigned int i = 0; i < state.contact.size(); ++i)
      {
        amounts.push_back(amount(state.contact[i], contact.friction(i)));
        result.forces.push_back(measured.by_force[i] * amounts[i].by_normal);
        measured.by_area[i] += measured.by_force[i] * amounts[i].by_area;
      }
    if (!of_pressure)
      {
        const auto directions = contact.tangent_directions(contact.rows(state.surface_positions));
        for (unsigned int j = 0; j < directions.size(); ++j)
          {
            const unsigned int i        = contact.tangents()[j].row;
            double             by_shear = 0., by_slip = 0.;
            for (int d = 0; d < dim; ++d)
              {
                by_shear += measured.by_force[i] * amounts[i].by_shear[d] * directions[j][d];
                by_slip += measured.by_force[i] * amounts[i].by_slip[d] * directions[j][d];
              }
            result.forces.push_back(by_shear);
            result.slips.push_back(by_slip);
          }
      }
    // The gradient at the surface nodes is replicated: each rank adds the gradient at its own
    // nodes.
    solver.surface().add_owned(contact.area_gradient(state.surface_positions, measured.by_area),
                               result.positions);
    return result;
  }

private:
  PressureRows all_rows(const state::StateSolver<dim>  &solver,
                        const state::ContactState<dim> &state) const
  {
    PressureRows result;
    for (unsigned int i = 0; i < state.contact.size(); ++i)
      {
        const auto &law = solver.contact(state.load_case).friction(i);
        result.force.push_back(amount(state.contact[i], law).value);
        result.area.push_back(state.contact[i].area);
      }
    return result;
  }

  /// Return the measure of the counted rows. All other rows have zero derivatives. Contact
  /// points are replicated, so the function needs no communication.
  Measured measured_of(const state::StateSolver<dim> &solver,
                       const unsigned int             load_case,
                       const PressureRows            &all) const
  {
    const auto   rows = counted_rows(solver, load_case, all.area);
    PressureRows counted;
    for (const auto &[i, share] : rows)
      {
        counted.force.push_back(share * all.force[i]);
        counted.area.push_back(share * all.area[i]);
      }
    const auto of_counted = measure(counted);
    Measured   result{of_counted.value, std::vector<double>(all.force.size(), 0.),
                    std::vector<double>(all.force.size(), 0.)};
    for (unsigned int k = 0; k < rows.size(); ++k)
      {
        const auto &[i, share] = rows[k];
        result.by_force[i]     = share * of_counted.by_force[k];
        result.by_area[i]      = share * of_counted.by_area[k];
      }
    return result;
  }

  Counted counted_rows(const state::StateSolver<dim> &solver,
                       const unsigned int             load_case,
                       const std::vector<double>     &areas) const
  {
    const auto shares  = row_shares(solver, pair, load_case);
    double     largest = 0.;
    for (unsigned int i = 0; i < shares.size(); ++i)
      if (shares[i] != 0.)
        largest = std::max(largest, areas[i]);
    Counted result;
    for (unsigned int i = 0; i < shares.size(); ++i)
      // Scale 0: supports hold the row entirely, so the row has no multiplier.
      if (shares[i] != 0. && solver.gluing(load_case).contact_scales()[i] != 0. &&
          areas[i] > smallest_area * largest)
        result.emplace_back(i, shares[i]);
    return result;
  }

  const std::string              pair;
  const Measure                  measure;
  const std::vector<std::string> read;
  const double                   power; ///< maximum power of the pressure under an integral
  const AmountOf                 amount;
  bool                           of_pressure; ///< the amount is the normal force
  bool                           of_reserve;  ///< the amount is the reserve of the friction force
};

/// Return the sum of factor(pair) times the shares over the pairs with the @p name, or all pairs.
template <int dim, typename Factor>
std::vector<double> summed_shares(const state::StateSolver<dim> &solver,
                                  const std::string             &name,
                                  const unsigned int             load_case,
                                  const Factor                  &factor)
{
  const auto         &contact = solver.contact(load_case);
  const auto          chosen  = chosen_pairs(solver, name, load_case);
  std::vector<double> result(contact.n_rows(), 0.);
  for (unsigned int p = 0; p < chosen.size(); ++p)
    if (chosen[p])
      for (const auto &[row, share] : contact.named_pairs()[p].rows)
        result[row] += factor(contact.named_pairs()[p]) * share;
  return result;
}
} // namespace

Amount normal_force(const state::ContactPoint &point, const contact::RowFriction &)
{
  return {point.force, 1., 0., {}, {}};
}

Amount shear_force(const state::ContactPoint &point, const contact::RowFriction &)
{
  const double length = point.shear.norm();
  Amount       result{length, 0., 0., {}, {}};
  if (length > 0.)
    result.by_shear = point.shear / length;
  return result;
}

Amount shear_reserve(const state::ContactPoint &point, const contact::RowFriction &law)
{
  Amount result = shear_force(point, law);
  // Slip has no reserve; its rounding error is no area.
  if (point.friction != state::FrictionStatus::stick || !(point.limit > result.value))
    return {};
  return {point.limit - result.value, law.coefficient, law.bound, -result.by_shear, {}};
}

Amount slip_over_area(const state::ContactPoint &point, const contact::RowFriction &)
{
  const double length = point.slip.norm();
  Amount       result;
  // The slip of contacts that stick is the error of the solution, and that of open ones no motion
  // along a surface.
  if (point.friction != state::FrictionStatus::slip || length == 0.)
    return result;
  return {length * point.area, 0., length, {}, point.slip * (point.area / length)};
}

Amount friction_work(const state::ContactPoint &point, const contact::RowFriction &)
{
  return {point.shear * point.slip, 0., 0., point.slip, point.shear};
}

template <int dim>
std::vector<bool> chosen_pairs(const state::StateSolver<dim> &solver,
                               const std::string             &name,
                               const unsigned int             load_case)
{
  std::vector<bool> chosen;
  for (const auto &pair : solver.contact(load_case).named_pairs())
    // Accept both orders, because the program may have chosen the slave side and users need
    // not know its choice.
    chosen.push_back(name.empty() || name == pair.name() ||
                     name == pair.master_name + ": " + pair.slave_name);
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end())
    throw InputError("there is no contact pair '" + name + "'");
  return chosen;
}

template <int dim>
std::vector<double> row_shares(const state::StateSolver<dim> &solver,
                               const std::string             &name,
                               const unsigned int             load_case)
{
  if (name.empty()) // exactly 1, not a sum of shares
    return std::vector<double>(solver.contact(load_case).n_rows(), 1.);
  return summed_shares(solver, name, load_case, [](const auto &) { return 1.; });
}

template <int dim>
std::vector<double> row_shares_of_first_side(const state::StateSolver<dim> &solver,
                                             const std::string             &name,
                                             const unsigned int             load_case)
{
  return summed_shares(solver, name, load_case,
                       [](const auto &pair) { return pair.master_is_first ? -1. : 1.; });
}

template <int dim>
std::unique_ptr<Response<dim>> contact_measure(const ResponseParameters       &parameters,
                                               const Measure                  &measure,
                                               const std::vector<std::string> &entries,
                                               const double                    power,
                                               const AmountOf                 &amount)
{
  return std::make_unique<ContactMeasure<dim>>(parameters, measure, entries, power, amount);
}

template <int dim>
typename mesh::Surface<dim>::Field
motion_of_slave(const state::StateSolver<dim>            &solver,
                const unsigned int                        load_case,
                const contact::Pair                      &pair,
                const typename mesh::Surface<dim>::Field &positions,
                const std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &)> &motion)
{
  const auto                        &surface = solver.surface();
  typename mesh::Surface<dim>::Field moved(surface.n_nodes());
  for (const auto &face : surface.faces())
    if (contact::is_on(face, pair.slave))
      for (const unsigned int node : face.nodes)
        {
          const auto to_space = solver.motion(load_case, face.body);
          moved[node]         = to_space.vector_back(motion(to_space.point(positions[node])));
        }
  return moved;
}

template mesh::Surface<2>::Field
motion_of_slave(const state::StateSolver<2> &,
                unsigned int,
                const contact::Pair &,
                const mesh::Surface<2>::Field &,
                const std::function<dealii::Tensor<1, 2>(const dealii::Tensor<1, 2> &)> &);
template mesh::Surface<3>::Field
motion_of_slave(const state::StateSolver<3> &,
                unsigned int,
                const contact::Pair &,
                const mesh::Surface<3>::Field &,
                const std::function<dealii::Tensor<1, 3>(const dealii::Tensor<1, 3> &)> &);
template std::vector<bool>
chosen_pairs(const state::StateSolver<2> &, const std::string &, unsigned int);
template std::vector<bool>
chosen_pairs(const state::StateSolver<3> &, const std::string &, unsigned int);
template std::vector<double>
row_shares(const state::StateSolver<2> &, const std::string &, unsigned int);
template std::vector<double>
row_shares_of_first_side(const state::StateSolver<2> &, const std::string &, unsigned int);
template std::unique_ptr<Response<2>> contact_measure(const ResponseParameters &,
                                                      const Measure &,
                                                      const std::vector<std::string> &,
                                                      double,
                                                      const AmountOf &);
template std::vector<double>
row_shares(const state::StateSolver<3> &, const std::string &, unsigned int);
template std::vector<double>
row_shares_of_first_side(const state::StateSolver<3> &, const std::string &, unsigned int);
template std::unique_ptr<Response<3>> contact_measure(const ResponseParameters &,
                                                      const Measure &,
                                                      const std::vector<std::string> &,
                                                      double,
                                                      const AmountOf &);
} // namespace snug::response
