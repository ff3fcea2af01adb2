#include <snug/response/measured_place.h>
#include <snug/response/quantities.h>
#include <snug/state/point_results.h>

#include <algorithm>

namespace snug::response {
namespace {
/// An unknown of the motion of a reference point or of a bolt (state::ReferencePoints).
struct Unknown
{
  unsigned int point, place;
  double       length; ///< by which the unknown is multiplied in q
};

/// Return the unknown that a response measures. @throws InputError if there is none.
template <int dim>
Unknown unknown_of(const state::StateSolver<dim> &solver,
                   const ResponseParameters      &parameters,
                   const bool                     turns)
{
  const auto &points  = solver.model().points;
  const bool  is_bolt = !parameters.bolt.empty();
  const auto &name    = is_bolt ? parameters.bolt : parameters.reference_point;
  const auto  found   = std::find_if(points.begin(), points.end(), [&](const auto &point) {
    return point.name == name && point.is_bolt() == is_bolt;
  });
  if (found == points.end())
    throw bad_entry(parameters.path(is_bolt ? "Bolt" : "Reference point"), name,
                    "must be the name of one of the scene");
  const auto p = static_cast<unsigned int>(found - points.begin());
  if (is_bolt)
    return {p, 0, 1.};
  // 0, 1, 2 for x, y, z, and a large number for the normal
  const auto c =
    static_cast<unsigned int>(parameters.component) - static_cast<unsigned int>(Component::x);
  const bool is_axisymmetric = solver.mesh().idealization().is_axisymmetric();
  const bool exists = is_axisymmetric ? !turns && c == 1 : dim == 2 && turns ? c == 2 : c < dim;
  if (!exists)
    throw bad_entry(parameters.path("Component"), to_text(parameters.component),
                    std::string("is not a ") + (turns ? "rotation" : "translation") +
                      " of a reference point of this model; must be " +
                      (is_axisymmetric ? "y"
                       : dim == 3      ? "x, y or z"
                       : turns         ? "z"
                                       : "x or y"));
  if (turns)
    return {p, dim == 2 ? 2 : dim + c, found->length};
  return {p, is_axisymmetric ? 0 : c, 1.};
}

/// The parts that both responses have in common.
template <int dim>
class PointResponse : public Response<dim>
{
public:
  PointResponse(const ResponseParameters &parameters, const bool turns)
    : parameters(parameters), turns(turns)
  {}

  std::vector<std::string> entries() const override
  {
    if (parameters.quantity.rfind("bolt", 0) == 0)
      return {"Bolt"};
    return {"Reference point", "Component"};
  }

  /// Return nothing, because J does not depend on u in the bodies.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> &,
                                        const state::ContactState<dim> &) const override
  {
    return {};
  }

protected:
  Unknown unknown(const state::StateSolver<dim> &solver) const
  {
    return unknown_of(solver, parameters, turns);
  }

  const ResponseParameters parameters;
  const bool               turns;
};

/// A translation or rotation of a reference point, or the shortening of a bolt.
template <int dim>
class PointMotion : public PointResponse<dim>
{
public:
  using PointResponse<dim>::PointResponse;

  void check(const state::StateSolver<dim> &solver) const override { this->unknown(solver); }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto of = this->unknown(solver);
    return state::point_motions(solver, state.u, 0)[of.point][of.place] / of.length;
  }

  Partials<dim> partials(const state::StateSolver<dim> &solver,
                         const state::ContactState<dim> & /*state*/) const override
  {
    const auto    of = this->unknown(solver);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
      {
        result.u.emplace_back(solver.assemblers()[s]->n_dofs());
        if (solver.tearing().subdomains[s].body == solver.mesh().n_bodies() + of.point)
          result.u[s](of.place) = 1. / of.length;
      }
    return result;
  }
};

/**
 * Force or moment of the supports of a reference point, or tension of a bolt. With the load w of
 * the point and the entries b_i of the rows on the unknown of the motion, equilibrium of the point
 * gives J = sum_i p_i b_i - w, for moments times the length by which rotations are multiplied. The
 * tension of a bolt is the sum alone.
 */
template <int dim>
class PointReaction : public PointResponse<dim>
{
public:
  using PointResponse<dim>::PointResponse;

  void check(const state::StateSolver<dim> &solver) const override
  {
    const auto  of    = this->unknown(solver);
    const auto &cases = solver.model().load_cases;
    if (this->parameters.bolt.empty() &&
        std::none_of(cases.begin(), cases.end(),
                     [&](const auto &c) { return c.points[of.point].held[of.place].has_value(); }))
      throw bad_entry(this->parameters.path("Component"), to_text(this->parameters.component),
                      "is a component of '" + this->parameters.reference_point +
                        "' that no support holds");
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto forces = row_forces(solver, state);
    const auto of     = this->unknown(solver);
    double     sum    = 0.;
    if (this->parameters.bolt.empty())
      sum -= solver.model().load_cases[state.load_case].points[of.point].wrench[of.place];
    for (const auto &[row, factor] : factors(solver, state))
      sum += factor * forces[row];
    return sum;
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto    of   = this->unknown(solver);
    const auto    rows = solver.rows(state.positions, state.load_case);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    result.forces.resize(rows.n_rows(), 0.);
    for (const auto &[row, factor] : factors(solver, state))
      result.forces[row] = factor;
    std::vector<std::vector<double>> unit(
      solver.model().points.size(),
      std::vector<double>(solver.mesh().idealization().n_rigid_motions(), 0.));
    unit[of.point][of.place] = of.length;
    solver.surface().add_owned(solver.points().energy_gradient(state.surface_positions, unit,
                                                               row_forces(solver, state), rows,
                                                               solver.contact(state.load_case)),
                               result.positions);
    return result;
  }

private:
  static std::vector<double> row_forces(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state)
  {
    return solver.gluing(state.load_case).row_forces(state.dual.lambda).front().all;
  }

  /// Return the entries b_i times the length, by row.
  std::vector<std::pair<unsigned int, double>> factors(const state::StateSolver<dim>  &solver,
                                                       const state::ContactState<dim> &state) const
  {
    const auto                                   of = this->unknown(solver);
    std::vector<std::pair<unsigned int, double>> result;
    for (const auto &entries : solver.rows(state.positions, state.load_case).points)
      if (entries.point == of.point)
        result.emplace_back(entries.row, of.length * entries.values[of.place]);
    return result;
  }
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> point_motion(const ResponseParameters &parameters, const bool turns)
{
  return std::make_unique<PointMotion<dim>>(parameters, turns);
}

template <int dim>
std::unique_ptr<Response<dim>> point_reaction(const ResponseParameters &parameters,
                                              const bool                turns)
{
  return std::make_unique<PointReaction<dim>>(parameters, turns);
}

#define SNUG_INSTANTIATE(dim)                                                             \
  template std::unique_ptr<Response<dim>> point_motion(const ResponseParameters &, bool); \
  template std::unique_ptr<Response<dim>> point_reaction(const ResponseParameters &, bool);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::response
