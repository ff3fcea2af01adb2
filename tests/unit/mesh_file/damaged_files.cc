#include <snug/geometry/imported_mesh.h>

#include <deal.II/base/tensor.h>

#include <sys/resource.h>

#include <gtest/gtest.h>
#include <unistd.h>
#include <unit/mesh_file/files.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>

using namespace snug;
using namespace snug::test;

namespace {
/// Damages of a file at one to three places, the same for the same seed.
class Damage
{
public:
  explicit Damage(const unsigned int seed) : random(seed) {}

  std::string done_to(std::string text)
  {
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n)
      damage(text);
    return text;
  }

private:
  std::mt19937 random;

  std::size_t below(const std::size_t n) { return random() % n; }

  void damage(std::string &text)
  {
    const auto place  = below(text.size());
    const auto length = 1 + below(std::min<std::size_t>(text.size() - place, 40));
    switch (below(8))
      {
        case 0:
          text[place] ^= static_cast<char>(1 << below(8));
          break;
        case 1:
          text[place] = static_cast<char>(below(256));
          break;
        case 2:
          text.resize(place);
          break;
        case 3:
          text.erase(place, length);
          break;
        case 4:
          text.insert(below(text.size()), text.substr(place, length));
          break;
        case 5:
          replace_number(text, place);
          break;
        case 6: // numbers of binary files, with and without sign
          for (std::size_t i = place; i < std::min(place + 4, text.size()); ++i)
            text[i] = static_cast<char>(i % 4 == 3 && length % 2 == 0 ? 0x7f : 0xff);
          break;
        case 7:
          repeat_lines(text, place);
          break;
      }
  }

  void replace_number(std::string &text, const std::size_t place)
  {
    static const std::vector<std::string> numbers = {
      "0",          "-1",         "2",          "1.5",  "1e308", "-1e308",
      "1e-320",     "nan",        "inf",        "0x10", "",      "2147483647",
      "2147483648", "4294967295", "4294967296", "1e99", "x",     "999999999999999999",
      "1e9",        "3000000000", "1000000000"};
    const std::string digits = "0123456789.+-";
    const auto        begin  = std::min(text.find_first_of(digits, place), text.size());
    const auto        end    = std::min(text.find_first_not_of(digits, begin), text.size());
    text.replace(begin, end - begin, numbers[below(numbers.size())]);
  }

  /// Sections that occur twice, or stand at another place.
  void repeat_lines(std::string &text, const std::size_t place)
  {
    const auto begin = std::min(text.find('\n', place), text.size() - 1) + 1;
    auto       end   = begin;
    for (std::size_t n = 1 + below(12); n > 0 && end < text.size(); --n)
      end = std::min(text.find('\n', end), text.size() - 1) + 1;
    const std::string lines = text.substr(begin, end - begin);
    if (below(2) == 0)
      text.erase(begin, lines.size());
    const auto to = text.find('\n', text.empty() ? 0 : below(text.size()));
    text.insert(to == std::string::npos ? text.size() : to + 1, lines);
  }
};

/// Blocks of vertices that are there, right-handed at every corner.
template <int dim>
void expect_right(const geometry::BlockMesh<dim> &mesh)
{
  ASSERT_FALSE(mesh.blocks.empty());
  ASSERT_EQ(mesh.blocks.size(), mesh.regions.size());
  for (const unsigned int region : mesh.regions)
    EXPECT_LT(region, mesh.region_names.size());
  for (const auto &block : mesh.blocks)
    {
      ASSERT_EQ(block.size(), 1u << dim);
      ASSERT_LT(*std::max_element(block.begin(), block.end()), mesh.vertices.size());
      for (unsigned int v = 0; v < block.size(); ++v)
        {
          dealii::Tensor<2, dim> edges; // along the axes, by the bits of v
          for (unsigned int d = 0; d < dim; ++d)
            edges[d] = mesh.vertices[block[v | 1u << d]] - mesh.vertices[block[v & ~(1u << d)]];
          EXPECT_GT(determinant(edges), 0.);
        }
    }
  for (const auto &face : mesh.boundaries)
    EXPECT_LT(face.second, mesh.boundary_names.size());
}

/// One short line, from the entry on.
void expect_clear(const std::string &message)
{
  EXPECT_EQ(message.rfind("entry '", 0), 0u) << message;
  EXPECT_LT(message.size(), 400u) << message;
  for (const char c : message)
    EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c))) << message;
}

void expect_error_or_mesh(const std::string &text, const Row &row)
{
  try
    {
      const auto mesh = mesh_file::import_mesh(text, row.parameters, row.dim);
      if (row.dim == 2)
        expect_right(*mesh->flat);
      else
        expect_right(*mesh->solid);
    }
  catch (const InputError &error)
    {
      expect_clear(error.what());
    }
  catch (const std::exception &error)
    {
      ADD_FAILURE() << error.what();
    }
}

/// No more than 256 MB of address space in addition to what is taken.
class MemoryLimit
{
public:
  MemoryLimit()
  {
    unsigned long pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before);
    rlimit limit   = before;
    limit.rlim_cur = pages * sysconf(_SC_PAGESIZE) + (256ul << 20);
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before); }
  MemoryLimit(const MemoryLimit &)            = delete;
  MemoryLimit &operator=(const MemoryLimit &) = delete;

private:
  rlimit before;
};

/// SNUG_DAMAGES asks for more or fewer than usual.
unsigned int n_damages()
{
  const char *wanted = std::getenv("SNUG_DAMAGES");
  return wanted == nullptr ? 1000 : std::atoi(wanted);
}
} // namespace

TEST(DamagedFiles, AreErrorsOrMeshes)
{
  const MemoryLimit limit;
  for (const auto &row : files())
    {
      const std::string good = contents(row.file);
      for (unsigned int seed = 1; seed <= n_damages(); ++seed)
        {
          SCOPED_TRACE(row.file + ", seed " + std::to_string(seed));
          const std::string text  = Damage(seed).done_to(good);
          const auto        start = std::clock();
          expect_error_or_mesh(text, row);
          EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC); // of processor time
        }
    }
}

TEST(DamagedFiles, SetsOfThemselvesDoNotGrow)
{
  const MemoryLimit limit;
  std::string       text = contents("block.inp") + "*ELSET, ELSET=again\n5, 6\n";
  for (unsigned int i = 0; i < 60; ++i)
    text += "again\n";
  const Row row{"", file_body(), 3, 2};
  expect_error_or_mesh(text, row);
  EXPECT_EQ(failure_reason(text, row.parameters, 3), "");
}

TEST(DamagedFiles, NodesThatOccurTwiceAreErrors)
{
  const auto text  = contents("block-2.msh");
  const auto nodes = text.substr(text.find("$Nodes"), text.find("$Elements") - text.find("$Nodes"));
  EXPECT_NE(failure_reason(text + nodes, file_body(), 3).find("node 1 occurs twice"),
            std::string::npos);
}

TEST(DamagedFiles, NumbersBeyondTheirTypeAreErrors)
{
  auto       text = contents("block-2.msh");
  const auto node = text.find("\n1 ", text.find("$Nodes")) + 1;
  EXPECT_NE(failure_reason(text.replace(node, 1, "4294967297"), file_body(), 3)
              .find("a node is too large: 4294967297"),
            std::string::npos);
  // a coordinate of a binary file that no number is
  auto         binary = contents("tets-2-binary.msh");
  const auto   place  = binary.find('\n', binary.find("$Nodes") + 8) + 1 + sizeof(int);
  const double wrong  = NAN;
  binary.replace(place, sizeof wrong, reinterpret_cast<const char *>(&wrong), sizeof wrong);
  EXPECT_NE(failure_reason(binary, file_body(), 3).find("a coordinate of node"), std::string::npos);
}
