#include <snug/feti/initial_active_set.h>
#include <snug/feti/loaded_problem.h>

namespace snug::feti {
LoadedProblem::LoadedProblem(const Linearization &linearization,
                             const PrimalVectors &the_loads,
                             qp::MultiVector      g,
                             const ContactPairs  *pairs,
                             qp::FrictionCones    cones)
  : linear(linearization)
  , f(the_loads)
  , gap(std::move(g))
  , rigid_load(linear.rigid_part(f))
  , gross_load(linear.gross_rigid_part(f)[0])
  , friction(std::move(cones))
  , normal_rows(linear.contact_rows())
  , initial(n_owned(), 1)
{
  for (const qp::FrictionCone &cone : friction)
    for (unsigned int t = 0; t < cone.n_tangents; ++t)
      normal_rows[cone.tangents[t]] = 0;
  const RunContext::Timer timer(context(), "solve");
  check_equilibrium();
  dual_load = linear.multiply_B(linear.apply_inverse(f));
  dual_load.add(-1., gap);
  if (pairs != nullptr)
    initial = rigid_prediction(*this, *pairs);
}
} // namespace snug::feti
