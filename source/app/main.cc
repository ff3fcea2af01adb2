#include <snug/app/command_line.h>
#include <snug/app/failure.h>
#include <snug/app/study.h>
#include <snug/base/blocked_signals.h>
#include <snug/base/errors.h>
#include <snug/base/petsc_handle.h>
#include <snug/base/version.h>
#include <snug/scene/json_scene.h>
#include <snug/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <malloc.h>

#include <cstdlib>
#include <iostream>
#include <memory>

namespace {
using namespace snug;

/// Return the rank that the launcher (Open MPI, MPICH, Slurm) assigns to this process, or a null
/// pointer if there is no launcher.
const char *launcher_rank()
{
  for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char *rank = std::getenv(name))
      return rank;
  return nullptr;
}

/// Return whether this process has rank 0 or no launcher. Output that needs no MPI is then printed
/// only once under mpirun.
bool is_first_process()
{
  const char *rank = launcher_rank();
  return rank == nullptr || std::string(rank) == "0";
}

/// Keep freed memory in the process, because the arrays of one geometry are freed and allocated
/// again for the next geometry. Otherwise their pages would be cleared and mapped anew, which takes
/// a tenth of the time of a large state. Blocks of more than 32 MiB are still returned to the
/// system.
void keep_freed_memory()
{
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

/// Pass options to PETSc by its environment variable, because PETSc reads some options when it is
/// initialized. If several options have the same name, the last one holds.
void pass_to_petsc(const std::string &options)
{
  if (options.empty())
    return;
  const char       *set = std::getenv("PETSC_OPTIONS");
  const std::string all = (set != nullptr ? set + std::string(" ") : "") + options;
  setenv("PETSC_OPTIONS", all.c_str(), 1);
}

/// Print what --help, --version and --print-parameters ask for. Return whether one of them was
/// given.
bool answer(const app::Options &options, std::ostream &out)
{
  if (options.help)
    out << app::usage();
  else if (options.version)
    out << "snug " SNUG_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ", PETSc "
        << PETSC_VERSION_MAJOR << '.' << PETSC_VERSION_MINOR << '.' << PETSC_VERSION_SUBMINOR
        << ")\n";
  else if (options.print_parameters)
    options.json ? scene::print_schema(out) : scene::print_reference(out);
  else
    return false;
  out << std::flush;
  return true;
}
} // namespace

int main(int argc, char *argv[])
{
  keep_freed_memory();
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
  app::Options options;
  try
    {
      options = app::parse(argc, argv);
      std::ostream nowhere(nullptr);
      if (answer(options, is_first_process() ? std::cout : nowhere))
        return 0;
    }
  catch (const std::exception &error)
    {
      if (is_first_process())
        std::cerr << "snug: " << one_line(error) << std::endl;
      return app::exit_status(error);
    }
  pass_to_petsc(options.petsc);
  // Otherwise Open MPI 4 starts a daemon for a process without a launcher, which takes 0.1 s, and
  // makes directories in /tmp that another job may remove at the same time.
  if (launcher_rank() == nullptr)
    {
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
      setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    }
  // PETSc would take our options for its own and print its own help.
  int  no_options = 1;
  auto blocked    = std::make_unique<BlockedSignals>(); // for the threads of MPI
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);
  blocked.reset();
  petsc::return_errors();
  PetscPopSignalHandler();
  return app::guarded(MPI_COMM_WORLD, [&options]() { return app::run(options); });
}
