#ifndef snug_app_optimize_h
#define snug_app_optimize_h

#include <snug/scene/scene.h>

#include <snug/base/run_context.h>

#include <string>

namespace snug::app {
/**
 * Find the best design of a scene: continue the journal of the output directory if @p restart, and
 * write log, history, pictures and summary.
 *
 * Without targets there is one search, on the mesh of the scene. With targets there are several:
 * a search on a mesh made for its initial design with errors of 8 times the targets, one from its
 * result with errors of 3 times the targets, and searches with errors of the targets, until the
 * mesh is also good enough for the design found. The values of the first and of the last design are
 * those of meshes made for these designs.
 *
 * Collective. @return what is wrong with the result; empty: nothing.
 * @throws InputError, SolveError if the first design has no state.
 */
template <int dim>
std::string optimize(RunContext &context, const scene::Scene &scene, bool restart);
} // namespace snug::app

#endif
