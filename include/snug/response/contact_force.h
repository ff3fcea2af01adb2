#ifndef snug_response_contact_force_h
#define snug_response_contact_force_h

#include <snug/response/response.h>

namespace snug::response {
/**
 * J = -sum_i p_i n_i . e [force]: component e of the force of a pair, or
 * of all pairs, on the slave side, with the normals n_i into the master.
 * For the component normal J = sum_i p_i.
 */
template <int dim>
class ContactForce : public Response<dim>
{
public:
  explicit ContactForce(const ResponseParameters &parameters);

  std::vector<std::string> entries() const override { return {"Pair", "Component"}; }

  void check(const state::StateSolver<dim> &solver) const override;

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override;

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override;

private:
  const ResponseParameters parameters;
};
} // namespace snug::response

#endif
