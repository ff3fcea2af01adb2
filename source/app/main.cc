#include <snug/app/command_line.h>
#include <snug/app/failure.h>
#include <snug/app/study.h>
#include <snug/base/errors.h>
#include <snug/base/petsc_handle.h>
#include <snug/base/version.h>
#include <snug/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <petscblaslapack.h>

#include <cstdlib>
#include <iostream>
#include <new>

namespace {
using namespace snug;

/// Rank of this process as its launcher (Open MPI, MPICH, Slurm) says, to
/// print what needs no MPI only once under mpirun.
bool is_first_process()
{
  for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char *rank = std::getenv(name))
      return std::string(rank) == "0";
  return true;
}

/// Print what --help, --version and --print-parameters ask for.
bool answer(const app::Options &options, std::ostream &out)
{
  if (options.help)
    out << app::usage();
  else if (options.version)
    out << "snug " SNUG_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ", PETSc "
        << PETSC_VERSION_MAJOR << '.' << PETSC_VERSION_MINOR << '.' << PETSC_VERSION_SUBMINOR
        << ")\n";
  else if (options.print_parameters)
    scene::print_reference(out);
  else
    return false;
  out << std::flush;
  return true;
}

/// OpenBLAS takes its buffer at the first call that needs one, and tries for ever where there
/// is no memory: have it at once, if there is some.
void reserve_blas_buffer()
{
  const std::size_t more_than_it_takes = std::size_t(256) << 20;
  ::                operator delete(::operator new(more_than_it_takes));
  PetscBLASInt      n   = 1, info;
  double            one = 1.;
  LAPACKpotrf_("L", &n, &one, &n, &info);
}

int run(const app::Options &options)
{
  reserve_blas_buffer();
  RunContext         context(MPI_COMM_WORLD, std::cout);
  const scene::Scene scene = scene::read_scene(
    {options.file, scene::read_text(options.file, MPI_COMM_WORLD), options.sets, options.output,
     [](const std::string &file) { return scene::read_text(file, MPI_COMM_WORLD); }});
  if (options.validate)
    {
      app::validate(context, scene);
      context.out() << options.file << " is valid" << std::endl;
    }
  else
    app::run_study(context, scene, options);
  return 0;
}
} // namespace

int main(int argc, char *argv[])
{
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
  // PETSc would take our options for its own and print its own help.
  int                                      no_options = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);
  petsc::return_errors();
  PetscPopSignalHandler();
  return app::guarded(MPI_COMM_WORLD, [&options]() { return run(options); });
}
