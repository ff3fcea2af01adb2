#ifndef snug_response_von_mises_norm_h
#define snug_response_von_mises_norm_h

#include <snug/elasticity/von_mises_power.h>
#include <snug/response/response.h>

namespace snug::response {
/**
 * J = (int sigma_vM^p dV / int dV)^(1/p) [force / length^2], p >= 1, over
 * one body or all: the p-norm of the von Mises stress, divided by that
 * of 1. It grows with p to the largest stress at the Gauss points.
 */
template <int dim>
class VonMisesNorm : public Response<dim>
{
public:
  explicit VonMisesNorm(const ResponseParameters &parameters);

  std::vector<std::string> entries() const override { return {"Body", "Exponent"}; }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override;

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override;

private:
  /// S = int (sigma_vM / scale)^p dV with the largest stress as the scale,
  /// and the volume; scale 0: no stress.
  struct Integrals
  {
    double scale = 0., power = 0., volume = 0.;
  };

  Integrals integrals(const state::StateSolver<dim>  &solver,
                      const state::ContactState<dim> &state) const;

  const std::string body; ///< empty: all
  const double      p;
};
} // namespace snug::response

#endif
