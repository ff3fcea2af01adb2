#ifndef snug_response_body_integral_h
#define snug_response_body_integral_h

#include <snug/response/response.h>

namespace snug::response {
/// J = int w dV over one body or all: their volume [length^3], w = 1, or
/// their mass, w the density. Depends on the geometry alone.
template <int dim>
class BodyIntegral : public Response<dim>
{
public:
  /// What is integrated.
  enum class Weight
  {
    one,
    density
  };

  BodyIntegral(const ResponseParameters &parameters, Weight weight);

  std::vector<std::string> entries() const override { return {"Body"}; }

  /// A volume constraint can be evaluated where no state was solved.
  bool needs_solution() const override { return false; }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override;

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override;

private:
  double weight_of(const elasticity::Material &material) const;

  const std::string body; ///< empty: all
  const Weight      weight;
};
} // namespace snug::response

#endif
