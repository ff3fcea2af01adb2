#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/cad/gmsh.h>
#include <snug/mesh_file/mesh_text.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

extern char **environ;

namespace snug::cad {
namespace {
/// Write a text file. @throws InputError, because the directory is that of the user.
void write(const std::string &path, const std::string &text)
{
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw InputError("cannot write '" + path + "': " + std::strerror(errno));
}

/// Return the script of Gmsh. Sizes follow from the background field alone.
std::string script(const std::string &name, const unsigned int dim)
{
  const std::string  face = dim == 2 ? "Curve" : "Surface", body = dim == 2 ? "Surface" : "Volume";
  std::ostringstream text;
  text << "SetFactory(\"OpenCASCADE\");\n"
       << "Merge \"" << name << ".brep\";\n"
       << "Merge \"" << name << ".pos\";\n"
       << "Background Mesh View[0];\n"
       << "Mesh.MeshSizeExtendFromBoundary = 0;\n"
       << "Mesh.MeshSizeFromPoints = 0;\n"
       << "Mesh.MeshSizeFromCurvature = 0;\n"
       << "General.NumThreads = 1;\n";
  for (unsigned int d = 1; d <= 3; ++d)
    text << "Mesh.MaxNumThreads" << d << "D = 1;\n";
  text << "Mesh.RandomSeed = 1;\n"
       << "Mesh.ElementOrder = 2;\n"
       << "Mesh.MshFileVersion = 4.1;\n"
       << "f() = " << face << "{:};\n"
       << "For k In {0 : #f() - 1}\n"
       << "  Physical " << face << "(f(k)) = {f(k)};\n"
       << "EndFor\n"
       << "b() = " << body << "{:};\n"
       << "Physical " << body << "(1) = {b()};\n";
  return text.str();
}

/// Return the environment without the variables of MPI launchers, because a gmsh that was built
/// with MPI would take itself for a process of this run.
std::vector<char *> environment()
{
  std::vector<char *> result;
  for (char **variable = environ; *variable != nullptr; ++variable)
    {
      bool is_of_launcher = false;
      for (const std::string prefix : {"OMPI_", "PMIX_", "PMI_", "PRTE_", "HYDI_"})
        is_of_launcher = is_of_launcher || std::string(*variable).rfind(prefix, 0) == 0;
      if (!is_of_launcher)
        result.push_back(*variable);
    }
  result.push_back(nullptr);
  return result;
}

/// Run a command without input, with its output in the file @p log. Return its exit status, or 128
/// plus the number of the signal that ended it. @throws InputError if it cannot be started.
int run(std::vector<std::string> command, const std::string &log)
{
  std::vector<char *> arguments;
  for (auto &word : command)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t     process;
  auto      own = environment();
  const int error =
    posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), own.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw InputError("the program gmsh, which makes the mesh of a CAD file, cannot be started: " +
                     std::string(std::strerror(error)) + "; on Debian: apt install gmsh");
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR)
    {
    }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// Return the first error in the log of gmsh, without its line head "Error   : "; "" if there is
/// none.
std::string first_error(const std::string &log)
{
  std::ifstream in(log);
  std::string   line;
  while (std::getline(in, line))
    {
      const auto place = line.find("Error   : ");
      if (place != std::string::npos)
        return mesh_file::printable(trim(line.substr(place + 10)));
    }
  return "";
}
} // namespace

void run_gmsh(const std::string &stem,
              const std::string &brep,
              const std::string &size_field,
              const unsigned int dim)
{
  const std::string mesh = stem + ".msh", log = stem + ".log";
  std::error_code   unused;
  std::filesystem::remove(mesh, unused); // an earlier mesh must not stand for this one
  write(stem + ".brep", brep);
  write(stem + ".pos", size_field);
  write(stem + ".geo", script(std::filesystem::path(stem).filename().string(), dim));
  const int status =
    run({"gmsh", "-" + std::to_string(dim), "-nt", "1", "-nopopup", stem + ".geo", "-o", mesh},
        log);
  const std::string error = first_error(log);
  if (status != 0 || !error.empty() || !std::filesystem::exists(mesh))
    throw InputError("gmsh ended with status " + std::to_string(status) +
                     (error.empty() ? "" : ": " + error) + "; see " + log);
}
} // namespace snug::cad
