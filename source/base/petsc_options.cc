#include <snug/base/gather.h>
#include <snug/base/petsc_handle.h>
#include <snug/base/petsc_options.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace snug::petsc {
std::string option(const std::string &prefix, const std::string &name, const std::string &fallback)
{
  std::array<char, 256> text;
  PetscBool             set = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, prefix.c_str(), ("-" + name).c_str(), text.data(),
                              text.size(), &set));
  return set == PETSC_TRUE ? text.data() : fallback;
}

DefaultOption::DefaultOption(const std::string &prefix,
                             const std::string &name,
                             const std::string &value)
{
  PetscBool set = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, prefix.c_str(), ("-" + name).c_str(), &set));
  if (set == PETSC_TRUE)
    return;
  key = "-" + prefix + name;
  check(PetscOptionsSetValue(nullptr, key.c_str(), value.c_str()));
}

DefaultOption::~DefaultOption()
{
  if (!key.empty())
    PetscOptionsClearValue(nullptr, key.c_str());
}

std::vector<std::string> unused_options(MPI_Comm communicator)
{
  PetscBool reported_by_petsc;
  check(PetscOptionsHasName(nullptr, nullptr, "-options_left", &reported_by_petsc));
  if (reported_by_petsc == PETSC_TRUE)
    return {};
  std::vector<std::string> mine;
  PetscInt                 n;
  char                   **names, **values;
  check(PetscOptionsLeftGet(nullptr, &n, &names, &values));
  for (PetscInt i = 0; i < n; ++i)
    mine.push_back("-" + std::string(names[i]) + (values[i] ? " " + std::string(values[i]) : ""));
  check(PetscOptionsLeftRestore(nullptr, &n, &names, &values));
  // A rank without subdomains has queried fewer options.
  const auto of_ranks = gather(communicator, mine);
  if (of_ranks.empty())
    return {};
  std::vector<std::string> result;
  for (const auto &text : of_ranks[0])
    if (std::all_of(of_ranks.begin(), of_ranks.end(), [&](const auto &others) {
          return std::find(others.begin(), others.end(), text) != others.end();
        }))
      result.push_back(text);
  return result;
}
} // namespace snug::petsc
