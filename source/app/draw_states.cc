#include <snug/app/results.h>
#include <snug/io/state_files.h>

namespace snug::app {
template <int dim>
void Results<dim>::draw(const double                  time,
                        const States                 &states,
                        const std::optional<Field>   &gradient,
                        const std::vector<MeshError> &errors)
{
  const RunContext::Timer timer(problem->context, "output");
  // the last design may be one that was asked for already
  if (time > 0. && time == drawn)
    return;
  drawn                                  = time;
  const auto                     &solver = *problem->solver;
  std::vector<std::string>        fields, faces; // files of the load cases in the output directory
  const std::vector<unsigned int> none;
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      const auto       *of_case = find_errors(errors, c);
      const std::string folder =
        states.size() > 1 ? problem->scene.load_cases[c].name + "/" : std::string();
      fields.push_back(
        folder + pictures[c].fields.write({*problem->mesh, problem->tearing, solver.model().bodies,
                                           solver.model().load_cases[c]},
                                          time, states[c], gradient ? &*gradient : nullptr,
                                          of_case ? &of_case->energy.cells : nullptr));
      const auto &contact = solver.contact(c);
      faces.push_back(
        folder +
        pictures[c].contact.write({*problem->mesh, solver.surface(), contact.joined_pairs(),
                                   contact.places(), contact.dependent_multipliers(),
                                   contact.placed_surface(),
                                   solver.surface().n_nodes() == 0 ? none : numbers_of_nodes(),
                                   solver.ties().paired()},
                                  time, states[c]));
    }
  if (states.size() > 1)
    io::write_load_cases(problem->context.communicator(), problem->scene.output_directory, fields,
                         faces);
}

#define SNUG_INSTANTIATE(dim)                                                            \
  template void Results<dim>::draw(double, const States &, const std::optional<Field> &, \
                                   const std::vector<MeshError> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
