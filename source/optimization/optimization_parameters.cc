#include <snug/base/section_check.h>
#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>

namespace snug::optimization {
void OptimizationParameters::declare(Entries &entries)
{
  entries.add("Algorithm", algorithm, "The optimizer.");
  entries.add(
    "Objective", objective,
    "The response to be minimized: a name in 'Responses' or a quantity of subsection Response.");
  entries.add("Combine", combine,
              with_meanings(allowed("sum, mean, worst, range, deviation, K deviation or mean + K "
                                    "deviation"),
                            {{"sum", "weighted sum"},
                             {"mean", "mean; the weights are probabilities"},
                             {"worst", "exact maximum of the weighted values"},
                             {"range", "largest minus smallest of the weighted values"},
                             {"mean + 2 deviation",
                              "mean plus twice the standard deviation; without 'mean +' the "
                              "deviation alone"}}),
              "The combination of the objective of several load cases.");
  entries.add(
    "Constraints", constraints,
    with_meanings(allowed("a list 'response: limit, response: limit, ...'"),
                  {{"volume: = initial", "equality constraint with the value of the first "
                                         "design; '=' is optional"},
                   {"peak: <= 120", "upper limit in the units of the response"},
                   {"tip: >= 0.9 initial", "lower limit relative to the first design"},
                   {"closing.tip: <= 5", "limit in the load case closing"},
                   {"worst of peak: <= 120",
                    "limit of a combination over the load cases, see 'Combine'. With several load "
                    "cases, a response of the state needs a load case or a combination."}}),
    "The constraints of the optimization.");
  entries.add("Maximum evaluations", maximum_evaluations, at_least(1),
              "The maximum number of evaluated designs.");
  entries.add("Starts", starts, between(1., 1000.),
              "The number of searches, of which the best result is taken. The first one begins at "
              "'Initial', the others at random designs within the bounds, the same in each run.");
  entries.add(
    "Draw every", draw_every,
    "The number of iterations between designs whose fields are written. A value of 0 means "
    "the first and the last design only.");
  entries.add("Gradient tolerance", gradient_tolerance, between(1e-15, 0.1),
              "The norm of the projected gradient, relative to the first gradient, below which the "
              "search has converged.");
  entries.add("Objective tolerance", objective_tolerance, between(1e-15, 0.1),
              "The relative change of the objective below which the search has converged.");
  entries.add("Design tolerance", design_tolerance, between(1e-15, 0.1),
              "The change of all variables, relative to the width of their bounds, below which the "
              "search has converged.");
  entries.add("Constraint tolerance", constraint_tolerance, between(1e-15, 0.1),
              "The maximum violation of the constraints, relative to their limits.");
}

void OptimizationParameters::check(const SectionCheck &section) const
{
  const auto require = [&](const bool good, const std::string &allowed) {
    section.require(good, "Constraints", to_text(constraints), allowed);
  };
  for (const auto &[name, text] : constraints)
    {
      require(name != objective, "'" + name + "' is the objective already");
      Limit limit;
      try
        {
          limit = read_limit(text);
        }
      catch (const std::exception &)
        {
          require(false, "the limit of '" + name +
                           "' must be like '= initial', '<= 120' or '>= 0.9 initial'");
        }
      require(limit.side != Limit::Side::equal || takes_equalities(algorithm),
              "'" + name + "' must have a limit with <= or >=: " + to_text(algorithm) +
                " takes no equalities, SQP does");
    }
}
} // namespace snug::optimization
