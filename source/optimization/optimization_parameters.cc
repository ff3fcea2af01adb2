#include <snug/base/section_check.h>
#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>

namespace snug::optimization {
void OptimizationParameters::declare(Entries &entries)
{
  entries.add("Algorithm", algorithm, "The optimizer.");
  entries.add(
    "Objective", objective,
    "The response to be made least: a name in 'Responses' or a quantity of subsection Response.");
  entries.add("Combine", combine, "What several load cases make of the objective.");
  entries.add("Constraints", constraints, allowed("a list 'response: limit, response: limit, ...'"),
              "Limits of responses, any number of them: 'volume: = initial, peak: <= 120, tip: >= "
              "0.9 initial'; initial is the value of the first design, and = may be left out. With "
              "several load cases, a response of the state names its own: 'closing.tip: <= 5'.");
  entries.add("Maximum evaluations", maximum_evaluations, at_least(1),
              "Largest number of designs that are evaluated.");
  entries.add("Draw every", draw_every,
              "Also draw the design of every so many iterations; 0: the first and the last one "
              "alone.");
  entries.add("Gradient tolerance", gradient_tolerance, between(1e-15, 0.1),
              "Stop when the projected gradient is smaller, relative to the first gradient.");
  entries.add("Objective tolerance", objective_tolerance, between(1e-15, 0.1),
              "Stop when the objective changes by less, relative.");
  entries.add("Design tolerance", design_tolerance, between(1e-15, 0.1),
              "Stop when all variables change by less, relative to the width of their bounds.");
  entries.add("Constraint tolerance", constraint_tolerance, between(1e-15, 0.1),
              "Allowed error of the constraints, relative to their values.");
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
                " takes no equalities, SLSQP does");
    }
}
} // namespace snug::optimization
