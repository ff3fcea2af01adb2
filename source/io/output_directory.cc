#include <snug/geometry/imported_mesh.h>
#include <snug/io/output_directory.h>
#include <snug/io/text_file.h>
#include <snug/scene/read_scene.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace snug::io {
std::vector<std::string> output_directories(const scene::Scene &scene)
{
  std::vector<std::string> directories = {scene.output_directory};
  if (scene.load_cases.size() > 1)
    for (const auto &load_case : scene.load_cases)
      directories.push_back(scene.output_directory + "/" + load_case.name);
  return directories;
}

std::string solid_file(const scene::Scene &scene, const scene::Body &body)
{
  const std::string path = scene.output_directory + '/' + body.name + ".step";
  std::error_code   unused;
  const bool        is_input =
    std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const scene::Body &other) {
      return std::filesystem::equivalent(path, other.mesh.file, unused);
    });
  return is_input || !body.mesh.imported || body.mesh.imported->brep.empty() ? "" : path;
}

void remove_earlier_results(const RunContext &context, const scene::Scene &scene)
{
  remove_results(context, output_directories(scene));
  std::error_code ignored;
  for (const auto &body : scene.bodies)
    if (context.rank() == 0)
      std::filesystem::remove(solid_file(scene, body), ignored);
}

void prepare_output(const RunContext &context, const scene::Scene &scene)
{
  for (const auto &directory : output_directories(scene))
    make_output_directory(context, directory);
  throw_collectively(context.communicator(), [&]() {
    std::ostringstream text;
    scene::print(scene, text);
    if (context.rank() == 0)
      write_text_file(scene.output_directory + "/parameters.prm", text.str());
  });
}

std::vector<std::string> written_files(const RunContext &context, const scene::Scene &scene)
{
  namespace fs                       = std::filesystem;
  const auto              &directory = scene.output_directory;
  std::vector<std::string> files;
  throw_collectively(context.communicator(), [&]() {
    if (context.rank() != 0)
      return;
    const auto begin = fs::last_write_time(directory + "/parameters.prm");
    for (const auto &file : fs::recursive_directory_iterator(directory))
      if (file.is_regular_file() && file.last_write_time() >= begin)
        files.push_back(file.path().lexically_relative(directory).string());
  });
  std::sort(files.begin(), files.end());
  return files;
}
} // namespace snug::io
