#ifndef snug_response_work_h
#define snug_response_work_h

#include <snug/response/response.h>

namespace snug::response {
/**
 * J = s 1/2 u'Ku + l f'u [force length]. For the potential energy, s = 1
 * and l = -1, the derivative needs no solve, because u minimises J on the
 * contact constraints: J' = 1/2 u'K'u - f''u + lambda'(B'u - g').
 */
template <int dim>
class Work : public Response<dim>
{
public:
  using State = state::ContactState<dim>;

  /// @p value: where a state holds J; s and l.
  Work(double State::*value, double stiffness, double load);

  bool stationary() const override { return stiffness == 1. && load == -1.; }

  double value(const state::StateSolver<dim> &solver, const State &state) const override;

  Partials<dim> partials(const state::StateSolver<dim> &solver, const State &state) const override;

private:
  double State::*member;
  double         stiffness, load;
};
} // namespace snug::response

#endif
