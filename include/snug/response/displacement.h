#ifndef snug_response_displacement_h
#define snug_response_displacement_h

#include <snug/response/response.h>

namespace snug::response {
/**
 * A displacement [length]: a component of that of a point,
 * J = sum_a N_a(xi) u_a . e, where the design carries the point along,
 * xi being its place in its cell in the reference geometry; or one
 * averaged over a face, J = int u . e dA / int dA, with e = n for the
 * component along the outward normal.
 */
template <int dim>
class Displacement : public Response<dim>
{
public:
  explicit Displacement(const ResponseParameters &parameters);

  std::vector<std::string> entries() const override
  {
    return {"Body", "Face", "Point", "Component"};
  }

  void check(const state::StateSolver<dim> &solver) const override;

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override;

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override;

private:
  Partials<dim> partials_at_point(const state::StateSolver<dim> &solver) const;
  Partials<dim> partials_on_face(const state::StateSolver<dim>  &solver,
                                 const state::ContactState<dim> &state) const;

  const ResponseParameters parameters;
};
} // namespace snug::response

#endif
