#include <snug/response/quantities.h>

#include <algorithm>

namespace snug::response {
namespace {
/// Smaller parts of the largest area are round-off, as on the axis of
/// bodies of revolution with degree 2.
const double smallest_area = 1e-10;

/// The given rows of a state, in the order of @p rows.
template <int dim>
PressureRows pressure_rows(const std::vector<unsigned int> &rows,
                           const state::ContactState<dim>  &state)
{
  PressureRows result;
  for (const unsigned int i : rows)
    {
      result.force.push_back(state.contact[i].force);
      result.area.push_back(state.contact[i].area);
    }
  return result;
}

template <int dim>
class ContactMeasure : public Response<dim>
{
public:
  ContactMeasure(const ResponseParameters       &parameters,
                 const Measure                  &measure,
                 const std::vector<std::string> &entries)
    : pair(parameters.pair), measure(measure), read(entries)
  {}

  std::vector<std::string> entries() const override
  {
    auto result = read;
    // All measures read it, besides their own entries.
    result.push_back("Pair");
    return result;
  }

  bool reads_pressure() const override { return true; }

  /// Throws where there is no such pair.
  void check(const state::StateSolver<dim> &solver) const override { rows_of_pair(solver, pair); }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    return measure(pressure_rows(counted_rows(solver, state), state)).value;
  }

  std::optional<double> measured(const state::StateSolver<dim>   &solver,
                                 const std::vector<PressureRows> &of_pairs) const override
  {
    const auto   chosen = chosen_pairs(solver, pair);
    PressureRows rows;
    for (unsigned int p = 0; p < chosen.size(); ++p)
      if (chosen[p])
        {
          // quadratic functions between nodes may be negative where contact ends
          for (const double force : of_pairs[p].force)
            rows.force.push_back(std::max(0., force));
          rows.area.insert(rows.area.end(), of_pairs[p].area.begin(), of_pairs[p].area.end());
        }
    return measure(rows).value;
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto rows     = counted_rows(solver, state);
    const auto measured = measure(pressure_rows(rows, state));
    // J(p, A(X)): the areas are functions of the positions at fixed forces.
    std::vector<double> by_area(state.contact.size(), 0.);
    Partials<dim>       result;
    // Rows that do not count have no influence.
    result.forces.assign(state.contact.size(), 0.);
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        result.forces[rows[i]] = measured.by_force[i];
        by_area[rows[i]]       = measured.by_area[i];
      }
    result.positions.resize(solver.mesh().n_points());
    // The gradient at the surface nodes is replicated: each rank adds those of its own nodes.
    solver.surface().add_owned(
      solver.contact().area_gradient(solver.surface().gather(state.positions), by_area),
      result.positions);
    return result;
  }

private:
  std::vector<unsigned int> counted_rows(const state::StateSolver<dim>  &solver,
                                         const state::ContactState<dim> &state) const
  {
    // Contact points are replicated: no communication, and the same rows on all ranks.
    const auto chosen  = rows_of_pair(solver, pair);
    double     largest = 0.;
    for (unsigned int i = 0; i < chosen.size(); ++i)
      if (chosen[i])
        largest = std::max(largest, state.contact[i].area);
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < chosen.size(); ++i)
      // Scale 0: supports hold the row entirely, it has no multiplier.
      if (chosen[i] && solver.gluing().contact_scales()[i] != 0. &&
          state.contact[i].area > smallest_area * largest)
        result.push_back(i);
    return result;
  }

  const std::string              pair;
  const Measure                  measure;
  const std::vector<std::string> read;
};
} // namespace

template <int dim>
std::vector<bool> chosen_pairs(const state::StateSolver<dim> &solver, const std::string &name)
{
  const auto       &pairs = solver.contact().pairs();
  std::vector<bool> chosen;
  for (const auto &pair : pairs)
    // Which side is the slave may have been chosen by the program: users need not know.
    chosen.push_back(name.empty() || name == pair.name() ||
                     name == pair.master_name + ": " + pair.slave_name);
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end())
    throw InputError("there is no contact pair '" + name + "'");
  return chosen;
}

template <int dim>
std::vector<bool> rows_of_pair(const state::StateSolver<dim> &solver, const std::string &name)
{
  const auto        chosen = chosen_pairs(solver, name);
  std::vector<bool> result;
  for (const auto &place : solver.contact().places())
    result.push_back(chosen[place.pair]);
  return result;
}

template <int dim>
std::unique_ptr<Response<dim>> contact_measure(const ResponseParameters       &parameters,
                                               const Measure                  &measure,
                                               const std::vector<std::string> &entries)
{
  return std::make_unique<ContactMeasure<dim>>(parameters, measure, entries);
}

template std::vector<bool> chosen_pairs(const state::StateSolver<2> &, const std::string &);
template std::vector<bool> chosen_pairs(const state::StateSolver<3> &, const std::string &);
template std::vector<bool> rows_of_pair(const state::StateSolver<2> &, const std::string &);
template std::unique_ptr<Response<2>>
contact_measure(const ResponseParameters &, const Measure &, const std::vector<std::string> &);
template std::vector<bool> rows_of_pair(const state::StateSolver<3> &, const std::string &);
template std::unique_ptr<Response<3>>
contact_measure(const ResponseParameters &, const Measure &, const std::vector<std::string> &);
} // namespace snug::response
