#include <snug/qp/friction_sets.h>
#include <snug/qp/row_set.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
namespace {
/// Maximum D / F_TT, reached where a contact closes and has no friction force yet.
const double largest_compliance = 1e6;

/// A force of a warm start within this part of its limit slips.
const double at_limit = 1e-6;
} // namespace

FreeRows FrictionSets::at(const MultiVector &lambda) const
{
  RowSet            rows = loaded_rows(problem.bounded(), lambda);
  std::vector<Slip> slips;
  for (const FrictionCone &cone : problem.cones())
    {
      const double          limit = cone.limit(lambda);
      std::array<double, 2> force = {};
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        force[t] = lambda(cone.tangents[t]);
      const double length = std::hypot(force[0], force[1]);
      const bool   slides = rows[cone.normal] && length > 0. && length >= (1. - at_limit) * limit;
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        rows[cone.tangents[t]] = rows[cone.normal] && !slides;
      if (slides)
        slips.push_back({cone, {{force[0] / length, force[1] / length}}, 0.});
    }
  return {rows, slips};
}

/// Return @p cone with the limit for the next step.
FrictionCone FrictionSets::limited(FrictionCone cone, const MultiVector &lambda) const
{
  if (is_lagging)
    {
      cone.bound       = cone.limit(lambda);
      cone.coefficient = 0.;
    }
  return cone;
}

/// Return the slip of a contact whose node another obstacle holds, too, or whether it sticks. Along
/// both obstacles, their friction adds up: the contact with the larger limit takes the force up to
/// this limit.
std::optional<Slip> FrictionSets::slip_in_corner(const FrictionCone        &cone,
                                                 const MultiVector         &lambda,
                                                 const MultiVector         &w,
                                                 const std::vector<double> &negligible,
                                                 bool                      &sticks) const
{
  sticks = false;
  if (cone.n_along_both == 0)
    return {};
  const unsigned int row   = cone.tangents[0];
  const double       own   = cone.limit(lambda);
  double             x     = lambda(row) + w(row) / cone.compliance(problem.diagonal());
  double             other = 0.; // limit of the other contact
  if (cone.other_tangent)
    {
      x += lambda(*cone.other_tangent);
      other = problem.cones().find(*cone.other_normal)->limit(lambda);
    }
  const bool is_larger =
    own > other || (own == other && !(cone.other_tangent && *cone.other_tangent < row));
  const bool slides = std::abs(x) > other + (is_larger ? own : 0.) + negligible[row];
  sticks            = is_larger && !slides;
  if (!slides)
    return {};
  Slip result{limited(cone, lambda), {{x > 0. ? 1. : -1., 0.}}, 0.};
  result.cone.n_tangents = 1;
  return result;
}

/// Return the slip of a closed contact, nothing if it sticks.
std::optional<Slip> FrictionSets::slip_of(const FrictionCone        &cone,
                                          const FreeRows            &now,
                                          const MultiVector         &lambda,
                                          const MultiVector         &w,
                                          const std::vector<double> &negligible) const
{
  const double      F      = cone.compliance(problem.diagonal());
  const double      limit  = cone.limit(lambda);
  const auto        x      = cone.trial_force(F, lambda, w);
  const double      length = std::hypot(x[0], x[1]);
  const Slip *const before = now.slip(cone.normal);
  const bool turns_round = before && before->direction[0] * x[0] + before->direction[1] * x[1] < 0.;
  if (turns_round || length <= limit + negligible[cone.tangents[0]])
    return {};
  const double stretch = limit > 0. ? (length - limit) / limit : largest_compliance;
  return Slip{limited(cone, lambda),
              {{x[0] / length, x[1] / length}},
              F * std::min(stretch, largest_compliance)};
}

FreeRows FrictionSets::next(const FreeRows            &now,
                            RowSet                     closed,
                            const MultiVector         &lambda,
                            const MultiVector         &w,
                            const std::vector<double> &negligible) const
{
  std::vector<Slip> slips;
  for (const FrictionCone &cone : problem.cones())
    {
      bool                sticks = closed[cone.normal];
      std::optional<Slip> slip;
      const bool          is_cornered = sticks && cone.is_cornered(closed);
      if (is_cornered)
        slip = slip_in_corner(cone, lambda, w, negligible, sticks);
      else if (sticks)
        {
          slip   = slip_of(cone, now, lambda, w, negligible);
          sticks = !slip;
        }
      // In a corner friction acts along both obstacles only.
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        closed[cone.tangents[t]] = sticks && (t == 0 || !is_cornered);
      if (slip)
        slips.push_back(*slip);
    }
  return {closed, slips};
}
} // namespace snug::qp
