#include <snug/advice/cost.h>
#include <snug/app/build_model.h>
#include <snug/app/cost_report.h>

namespace snug::app {
template <int dim>
void print_cost_estimate(RunContext                &context,
                         const scene::Scene        &scene,
                         const mesh::BodyMesh<dim> &mesh,
                         const unsigned int         n_ranks,
                         const bool                 stages)
{
  const auto counts = advice::count(scene, mesh);
  throw_collectively(context.communicator(), [&]() {
    if (context.rank() == 0)
      with_file_context(scene, [&]() {
        print(advice::estimate_cost(scene, counts, n_ranks, advice::machine_speed()), stages,
              context.out(stages ? Verbosity::quiet : Verbosity::normal));
      });
  });
}

template void print_cost_estimate(RunContext &,
                                  const scene::Scene &,
                                  const mesh::BodyMesh<2> &,
                                  unsigned int,
                                  bool);
template void print_cost_estimate(RunContext &,
                                  const scene::Scene &,
                                  const mesh::BodyMesh<3> &,
                                  unsigned int,
                                  bool);
} // namespace snug::app
