#ifndef snug_response_contact_measure_h
#define snug_response_contact_measure_h

#include <snug/response/pressure_measures.h>
#include <snug/response/response.h>

namespace snug::response {
/// Which contact rows belong to the pair called @p name, either side
/// first; empty: all. @throws InputError if there is no such pair.
template <int dim>
std::vector<bool> rows_of_pair(const state::StateSolver<dim> &solver, const std::string &name);

/**
 * A function of the contact forces and tributary areas of one pair, or
 * of all pairs; see pressure_measures.h for what there is. Rows that
 * cannot carry a force, or have no area, do not count.
 */
template <int dim>
class ContactMeasure : public Response<dim>
{
public:
  using Measure = std::function<Measured(const PressureRows &)>;

  /// @p entries: those that the measure reads, besides the pair.
  ContactMeasure(const ResponseParameters       &parameters,
                 const Measure                  &measure,
                 const std::vector<std::string> &entries = {});

  std::vector<std::string> entries() const override;

  void check(const state::StateSolver<dim> &solver) const override;

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override;

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override;

private:
  std::vector<unsigned int> counted_rows(const state::StateSolver<dim>  &solver,
                                         const state::ContactState<dim> &state) const;

  const std::string              pair;
  const Measure                  measure;
  const std::vector<std::string> read;
};
} // namespace snug::response

#endif
