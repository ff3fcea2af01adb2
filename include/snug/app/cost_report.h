#ifndef snug_app_cost_report_h
#define snug_app_cost_report_h

#include <snug/base/run_context.h>
#include <snug/mesh/body_mesh.h>
#include <snug/scene/scene.h>

namespace snug::app {
/// Print the estimated cost of a run with @p mesh on @p n_ranks ranks: two lines, or a table of the
/// @p stages. Collective. @throws InputError naming the file.
template <int dim>
void print_cost_estimate(RunContext                &context,
                         const scene::Scene        &scene,
                         const mesh::BodyMesh<dim> &mesh,
                         unsigned int               n_ranks,
                         bool                       stages);
} // namespace snug::app

#endif
