#include <snug/optimization/combination.h>
#include <snug/optimization/minimize.h>
#include <snug/response/response.h>
#include <snug/scene/entries.h>

namespace snug::scene {
namespace {
void declare_response(Entries &entries, response::ResponseParameters &response)
{
  entries.begin_section("Response " + response.name,
                        "One response: a number that a state or a design "
                        "has. Entries that its quantity does not read "
                        "stay as they are.");
  add_choice(entries, "Quantity", response.quantity, response::response_table<3>(),
             "What it measures.");
  entries.add("Body", response.body, anything("the name of a body"),
              "The body that counts; empty: all, or the only one that "
              "holds the point.");
  entries.add("Face", response.face, anything("body.boundary"),
              "The face a displacement is averaged over, "
              "'body.boundary'.");
  entries.add("Point", response.point,
              "The point whose displacement counts [length], in the "
              "reference geometry; designs carry it along.");
  entries.add("Component", response.component, choice("normal|x|y|z"),
              "Of a displacement or a contact force. normal: along the "
              "outward normal of the face; contact forces: all sizes "
              "added up.");
  entries.add("Pair", response.pair, anything("slave: master"),
              "The contact pair that counts, 'slave: master'; empty: "
              "all.");
  entries.add("Exponent", response.exponent,
              "The p of p-norms, at least 1; the larger, the nearer to "
              "the largest value, and the less smooth.");
  entries.add("Smoothing", response.smoothing,
              "Part of the mean contact pressure below which area does "
              "not count; above 0, at most 1.");
}
} // namespace

void declare_responses(Entries &entries, Scene &scene)
{
  for (auto &response : scene.responses)
    declare_response(entries, response);
}

void declare_optimization(Entries &entries, Scene &scene)
{
  auto &optimization = scene.optimization;
  entries.begin_section("Optimization", "Finding the best shape.");
  add_choice(entries, "Algorithm", optimization.algorithm, optimization::algorithm_table(),
             "The optimizer.");
  entries.add("Objective", optimization.objective,
              "The response to be made least: a name in 'Responses' or a "
              "quantity of subsection Response.");
  add_choice(entries, "Combine", optimization.combine, optimization::combination_table(),
             "What several load cases make of the objective.");
  entries.add("Constraints",
              {[&optimization]() { return to_text(optimization.constraints); },
               [&optimization](const std::string &text) {
                 from_text(text, optimization.constraints);
               }},
              pairs("a list 'response: limit, response: limit, ...'"),
              "Limits of responses, any number of them: 'volume: = "
              "initial, peak: <= 120, tip: >= 0.9 initial'; initial is "
              "the value of the first design, and = may be left out. "
              "With several load cases, a response of the state names "
              "its own: 'closing.tip: <= 5'.");
  entries.add("Maximum evaluations", optimization.maximum_evaluations,
              "Largest number of designs that are evaluated.");
  entries.add("Gradient tolerance", optimization.gradient_tolerance,
              "Stop when the projected gradient is smaller, relative to "
              "the first gradient.");
  entries.add("Objective tolerance", optimization.objective_tolerance,
              "Stop when the objective changes by less, relative.");
  entries.add("Design tolerance", optimization.design_tolerance,
              "Stop when all variables change by less, relative to the "
              "width of their bounds.");
  entries.add("Constraint tolerance", optimization.constraint_tolerance,
              "Allowed error of the constraints, relative to their "
              "values.");
}
} // namespace snug::scene
