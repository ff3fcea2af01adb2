#ifndef snug_app_study_h
#define snug_app_study_h

#include <snug/app/command_line.h>
#include <snug/base/run_context.h>
#include <snug/io/answer.h>
#include <snug/scene/scene.h>

namespace snug::app {
/**
 * Do the task of a scene and leave its results in the output directory.
 * Collective.
 * @throws InputError, SolveError.
 */
void run_study(RunContext &context, const scene::Scene &scene, const Options &options);

/// Print what the meshes of a scene look like and make all that its task needs, but solve nothing.
/// @param[in] writes Whether the entries and the meshes are written to the directory 'model' of
/// the output directory; else there are no files. Collective.
/// @return {valid, file, bodies, pairs, warnings}. @throws InputError.
io::Json validate(RunContext &context, const scene::Scene &scene, bool writes);

/// Read the file of @p options and do what they ask, on all ranks of MPI_COMM_WORLD. The log goes
/// to standard output. Collective. @return 0.
/// @throws InputError, SolveError.
int run(const Options &options);
} // namespace snug::app

#endif
