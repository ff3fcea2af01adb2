#include <snug/base/version.h>
#include <snug/io/summary.h>

#include <deal.II/base/config.h>

#include <dlfcn.h>
#include <petscsys.h>


namespace snug::io {
namespace {
const std::string reference_blas = "reference"; // netlib's

/// Return the file from which dgemm was loaded, with links resolved; empty if unknown. The file
/// is determined at run time, because libblas.so.3 is a link that the administrator may turn to
/// another BLAS (Debian's alternatives). The name at link time therefore does not identify the
/// BLAS.
std::string blas_file()
{
  Dl_info     where;
  void *const dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  if (dgemm == nullptr || dladdr(dgemm, &where) == 0)
    return "";
  char *const resolved = realpath(where.dli_fname, nullptr);
  std::string file     = resolved ? resolved : where.dli_fname;
  std::free(resolved);
  return file;
}

/// Return version, options and kernel of OpenBLAS; empty if the BLAS is another one.
std::string openblas_config()
{
  using Function      = char *();
  const auto function = reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, "openblas_get_config"));
  return function ? function() : "";
}

/// Return the compiler. The __VERSION__ of clang contains its name, that of g++ only the number.
std::string compiler_name()
{
#if defined(__clang__)
  return __VERSION__;
#else
  return std::string("g++ ") + __VERSION__;
#endif
}
} // namespace

std::string blas_name(const std::string &file, const std::string &openblas_config)
{
  // Debian names the BLAS in the directory of the path: .../openblas-serial/libblas.so.3.
  if (file.find("openblas") != std::string::npos)
    return openblas_config.empty() ? "OpenBLAS" : openblas_config;
  for (const char *name : {"mkl", "blis", "atlas"})
    if (file.find(name) != std::string::npos)
      return name;
  // The reference BLAS is netlib's library, which Debian calls libblas.
  if (file.find("/libblas.so") != std::string::npos)
    return reference_blas;
  return file.empty() ? "unknown" : file;
}

std::string blas_warning(const Summary::Program &program)
{
  // Only the reference BLAS is known to be slow, so an unknown BLAS gets no advice.
  if (program.blas != reference_blas)
    return "";
  return "the reference BLAS is in use; factorizations are 3 to "
         "10 times faster with OpenBLAS (sudo apt install "
         "libopenblas0-serial)";
}

Summary::Program program_info(const RunContext &context)
{
  Summary::Program program;
  program.version = SNUG_VERSION;
  program.dealii  = DEAL_II_PACKAGE_VERSION;
  program.petsc = std::to_string(PETSC_VERSION_MAJOR) + '.' + std::to_string(PETSC_VERSION_MINOR) +
                  '.' + std::to_string(PETSC_VERSION_SUBMINOR);
  program.blas     = blas_name(blas_file(), openblas_config());
  program.compiler = compiler_name();
  program.ranks    = context.n_ranks();
  return program;
}
} // namespace snug::io
