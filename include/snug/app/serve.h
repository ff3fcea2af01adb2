#ifndef snug_app_serve_h
#define snug_app_serve_h

#include <snug/base/run_context.h>
#include <snug/scene/read_scene.h>

namespace snug::app {
/// Let standard output be standard error from now on. Return a descriptor of the former standard
/// output, which then only the owner of the descriptor writes to.
int divert_standard_output();

/**
 * Answer requests about a scene: one JSON object per line of standard input, with one line per
 * answer, in order, to the descriptor @p answers; doc/serve.md describes the protocol. Rank 0 reads
 * and writes. Return after the request "quit", at the end of the input, when nobody reads the
 * answers, or after SIGTERM or SIGINT. @p source and @p scene are those of the first model.
 * Collective. @throws InputError, SolveError if there is no first model.
 */
void serve(RunContext               &context,
           const scene::SceneSource &source,
           const scene::Scene       &scene,
           int                       answers);
} // namespace snug::app

#endif
