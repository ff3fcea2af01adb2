#ifndef snug_tests_unit_io_scratch_h
#define snug_tests_unit_io_scratch_h

#include <mpi.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace snug::test {
/// A directory shared by all ranks, removed with this object. Collective.
class ScratchDirectory
{
public:
  ScratchDirectory()
  {
    char name[] = "/tmp/snug-io-XXXXXX";
    if (is_first())
      if (mkdtemp(name) == nullptr)
        MPI_Abort(MPI_COMM_WORLD, 1);
    MPI_Bcast(name, sizeof(name), MPI_CHAR, 0, MPI_COMM_WORLD);
    path = name;
  }

  ~ScratchDirectory()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (is_first())
      std::filesystem::remove_all(path);
  }

  std::string file(const std::string &name) const { return path + "/" + name; }

  std::string path;

  static bool is_first()
  {
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == 0;
  }
};

inline std::string read_file(const std::string &path)
{
  std::ifstream in(path);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// Fields of a CSV text, line by line, header included.
inline std::vector<std::vector<std::string>> read_csv(const std::string &text)
{
  std::vector<std::vector<std::string>> table;
  std::istringstream                    lines(text);
  for (std::string line; std::getline(lines, line);)
    {
      table.emplace_back();
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');)
        table.back().push_back(field);
    }
  return table;
}

/// How often @p part occurs in @p text.
inline unsigned int count(const std::string &text, const std::string &part)
{
  unsigned int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++n;
  return n;
}
} // namespace snug::test

#endif
