#ifndef snug_io_output_directory_h
#define snug_io_output_directory_h

#include <snug/base/run_context.h>
#include <snug/scene/scene.h>

#include <string>
#include <vector>

namespace snug::io {
/// Return the output directory of a scene and, if there are several load cases, their directories.
std::vector<std::string> output_directories(const scene::Scene &scene);

/// Return the path of the STEP file of a body, or nothing for bodies that are not from a CAD file,
/// or if the file of a body has this path.
std::string solid_file(const scene::Scene &scene, const scene::Body &body);

/// Make the output directories of a scene, and write all entries into `parameters.prm` there.
/// Collective. @throws InputError.
void prepare_output(const RunContext &context, const scene::Scene &scene);

/// Remove the results of earlier runs from the output directories of a scene. Collective.
void remove_earlier_results(const RunContext &context, const scene::Scene &scene);

/// Return, on rank 0, the files in and below the output directory of a scene that are not older
/// than its parameters.prm, as paths from there. Collective.
std::vector<std::string> written_files(const RunContext &context, const scene::Scene &scene);
} // namespace snug::io

#endif
