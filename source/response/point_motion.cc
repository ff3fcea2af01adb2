#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/point_results.h>

#include <algorithm>

namespace snug::response {
namespace {
/// Return the index of the reference point or bolt of a response.
template <int dim>
unsigned int find_reference_point(const state::StateSolver<dim> &solver,
                                  const ResponseParameters      &parameters)
{
  const auto &points = solver.model().points;
  const auto  found  = std::find_if(points.begin(), points.end(), [&](const auto &point) {
    return point.name == (parameters.bolt.empty() ? parameters.reference_point : parameters.bolt);
  });
  if (found == points.end())
    throw bad_entry(parameters.path("Reference point"), parameters.reference_point,
                    "there is no such reference point");
  return static_cast<unsigned int>(found - points.begin());
}

/// Return the place of the component in the motion q of a reference point (state::ReferencePoints).
template <int dim>
unsigned int unknown_of(const state::StateSolver<dim> &solver,
                        const ResponseParameters      &parameters,
                        const bool                     is_rotation)
{
  if (!parameters.bolt.empty())
    return 0;
  const unsigned int n = solver.mesh().idealization().n_rigid_motions();
  const auto         c =
    static_cast<unsigned int>(parameters.component) - static_cast<unsigned int>(Component::x);
  const bool exists = parameters.component != Component::normal && (n == 1 ? !is_rotation && c == 1
                                                                    : dim == 3    ? true
                                                                    : is_rotation ? c == 2
                                                                                  : c < 2);
  if (!exists)
    throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                    std::string("is not a ") + (is_rotation ? "rotation" : "translation") +
                      " of a reference point of this model");
  return n == 1 ? 0 : !is_rotation ? c : dim == 2 ? 2 : dim + c;
}

std::vector<std::string> entries_of(const ResponseParameters &parameters)
{
  if (parameters.quantity.rfind("bolt", 0) == 0)
    return {"Bolt"};
  return {"Reference point", "Component"};
}

/// A component of the motion q of a reference point, or the shortening of a bolt.
template <int dim>
class PointMotion : public Response<dim>
{
public:
  PointMotion(const ResponseParameters &parameters, const bool is_rotation)
    : parameters(parameters), is_rotation(is_rotation)
  {}

  std::vector<std::string> entries() const override { return entries_of(parameters); }

  void check(const state::StateSolver<dim> &solver) const override
  {
    find_reference_point(solver, parameters);
    unknown_of(solver, parameters, is_rotation);
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto p = find_reference_point(solver, parameters);
    return state::point_motions(solver, state.u,
                                0)[p][unknown_of(solver, parameters, is_rotation)] /
           length(solver, p);
  }

  Partials<dim> partials(const state::StateSolver<dim> &solver,
                         const state::ContactState<dim> & /*state*/) const override
  {
    const auto    p = find_reference_point(solver, parameters);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
      {
        result.u.emplace_back(solver.assemblers()[s]->n_dofs());
        if (solver.tearing().subdomains[s].body == solver.mesh().n_bodies() + p)
          result.u[s](unknown_of(solver, parameters, is_rotation)) = 1. / length(solver, p);
      }
    return result;
  }

  /// Return nothing, because J does not depend on u in the bodies.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> &,
                                        const state::ContactState<dim> &) const override
  {
    return {};
  }

private:
  const ResponseParameters parameters;
  const bool               is_rotation;

  /// Return the length by which rotations are multiplied in q.
  double length(const state::StateSolver<dim> &solver, const unsigned int p) const
  {
    return is_rotation ? solver.model().points[p].length : 1.;
  }
};

/**
 * Force or moment of the supports of a reference point, or tension of a bolt. With the load w of
 * the point and the entries b_i of the rows on the unknown of the motion, equilibrium of the point
 * gives J = sum_i p_i b_i - w, for moments times the length by which rotations are multiplied.
 */
template <int dim>
class PointReaction : public Response<dim>
{
public:
  PointReaction(const ResponseParameters &parameters, const bool is_moment)
    : parameters(parameters), is_moment(is_moment)
  {}

  std::vector<std::string> entries() const override { return entries_of(parameters); }

  void check(const state::StateSolver<dim> &solver) const override
  {
    const auto p       = find_reference_point(solver, parameters);
    const auto k       = unknown_of(solver, parameters, is_moment);
    const auto is_held = [&](const auto &load_case) { return load_case.points[p].held[k]; };
    if (std::none_of(solver.model().load_cases.begin(), solver.model().load_cases.end(), is_held))
      throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                      "is a component of '" + parameters.reference_point +
                        "' that no support holds");
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto forces = row_forces(solver, state);
    const auto p      = find_reference_point(solver, parameters);
    const auto k      = unknown_of(solver, parameters, is_moment);
    double     sum    = 0.;
    if (parameters.bolt.empty())
      sum -= solver.model().load_cases[state.load_case].points[p].wrench[k];
    for (const auto &[row, factor] : factors(solver, state))
      sum += factor * forces[row];
    return sum;
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto    rows = solver.rows(state.positions, state.load_case);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    result.forces.resize(rows.n_rows(), 0.);
    for (const auto &[row, factor] : factors(solver, state))
      result.forces[row] = factor;
    std::vector<std::vector<double>> unit(
      solver.model().points.size(),
      std::vector<double>(solver.mesh().idealization().n_rigid_motions(), 0.));
    const auto p                                       = find_reference_point(solver, parameters);
    unit[p][unknown_of(solver, parameters, is_moment)] = length(solver, p);
    solver.surface().add_owned(solver.points().energy_gradient(state.surface_positions, unit,
                                                               row_forces(solver, state), rows,
                                                               solver.contact(state.load_case)),
                               result.positions);
    return result;
  }

  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> &,
                                        const state::ContactState<dim> &) const override
  {
    return {};
  }

private:
  const ResponseParameters parameters;
  const bool               is_moment;

  double length(const state::StateSolver<dim> &solver, const unsigned int p) const
  {
    return is_moment ? solver.model().points[p].length : 1.;
  }

  static std::vector<double> row_forces(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state)
  {
    return solver.gluing(state.load_case).row_forces(state.dual.lambda).front().all;
  }

  /// Return the entries b_i times the length, by row.
  std::vector<std::pair<unsigned int, double>> factors(const state::StateSolver<dim>  &solver,
                                                       const state::ContactState<dim> &state) const
  {
    const auto                                   p = find_reference_point(solver, parameters);
    const auto                                   k = unknown_of(solver, parameters, is_moment);
    std::vector<std::pair<unsigned int, double>> result;
    for (const auto &entries : solver.rows(state.positions, state.load_case).points)
      if (entries.point == p)
        result.emplace_back(entries.row, length(solver, p) * entries.values[k]);
    return result;
  }
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> point_motion(const ResponseParameters &parameters,
                                            const bool                is_rotation)
{
  return std::make_unique<PointMotion<dim>>(parameters, is_rotation);
}

template <int dim>
std::unique_ptr<Response<dim>> point_reaction(const ResponseParameters &parameters,
                                              const bool                is_moment)
{
  return std::make_unique<PointReaction<dim>>(parameters, is_moment);
}

#define SNUG_INSTANTIATE(dim)                                                             \
  template std::unique_ptr<Response<dim>> point_motion(const ResponseParameters &, bool); \
  template std::unique_ptr<Response<dim>> point_reaction(const ResponseParameters &, bool);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::response
