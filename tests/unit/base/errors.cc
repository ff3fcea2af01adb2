#include <snug/base/errors.h>
#include <snug/base/petsc_handle.h>
#include <snug/base/run_context.h>

#include <deal.II/base/exceptions.h>

#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <typeinfo>
#include <vector>

using namespace snug;

namespace {
int rank_here()
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int n_ranks()
{
  int size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

/// Type and message of the error that throw_collectively() throws on this rank.
struct Thrown
{
  const std::type_info *type;
  std::string           message;
};

Thrown thrown_by(const std::function<void()> &work)
{
  try
    {
      throw_collectively(MPI_COMM_WORLD, work);
    }
  catch (const std::exception &error)
    {
      return {&typeid(error), one_line(error)};
    }
  return {&typeid(void), ""};
}

/// One rank after the other fails; all must see the same and go on together.
template <typename Expected>
void expect_everywhere(const std::function<void()> &fail, const std::string &message)
{
  for (int failing = 0; failing < n_ranks(); ++failing)
    {
      const Thrown thrown = thrown_by([&] {
        if (rank_here() == failing)
          fail();
      });
      EXPECT_EQ(*thrown.type, typeid(Expected)) << thrown.type->name();
      EXPECT_EQ(thrown.message, message);
      int ranks = 1;
      MPI_Allreduce(MPI_IN_PLACE, &ranks, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_EQ(ranks, n_ranks());
    }
}

const std::string no_memory =
  "out of memory: use a coarser mesh, or distribute the ranks over more machines";
} // namespace

TEST(Everywhere, KindAndMessageReachAllRanks)
{
  expect_everywhere<InputError>([] { throw InputError("entry 'A' = 'b': no"); },
                                "entry 'A' = 'b': no");
  expect_everywhere<SolveError>([] { throw SolveError("no equilibrium"); }, "no equilibrium");
  expect_everywhere<TangledMesh>([] { throw TangledMesh("cell 3 is tangled"); },
                                 "cell 3 is tangled");
  expect_everywhere<std::runtime_error>([] { throw std::out_of_range("key"); }, "key");
  expect_everywhere<std::runtime_error>([] { throw 7; }, "unknown error");
  expect_everywhere<std::runtime_error>([] { throw dealii::ExcMessage("deal.II says so"); },
                                        "deal.II says so");
  expect_everywhere<InputError>([] { throw InputError(""); }, "");
  const std::string long_text(100000, 'x');
  expect_everywhere<SolveError>([&] { throw SolveError(long_text); }, long_text);
}

TEST(Everywhere, MemoryThatRunsOutIsSaidSo)
{
  expect_everywhere<std::bad_alloc>([] { throw std::bad_alloc(); }, no_memory);
  // what vectors, deal.II and PETSc do, not only what they are said to do
  volatile std::size_t too_many = std::numeric_limits<std::size_t>::max() / 32;
#ifndef __SANITIZE_ADDRESS__ // whose operator new ends the program instead
  expect_everywhere<std::bad_alloc>([&] { std::vector<double> v(too_many); }, no_memory);
#endif
  expect_everywhere<std::bad_alloc>([&] { throw dealii::StandardExceptions::ExcOutOfMemory(8); },
                                    no_memory);
  petsc::return_errors();
  expect_everywhere<std::bad_alloc>(
    [&] {
      void *memory = nullptr;
      petsc::check(PetscMalloc(too_many, &memory));
    },
    no_memory);
  expect_everywhere<std::runtime_error>(
    [] {
      petsc::Vector vector, twin;
      petsc::check(VecCreate(PETSC_COMM_SELF, vector.put()));
      petsc::check(VecDuplicate(vector, twin.put()));
    },
    "PETSc error 56: No support for this operation for this "
    "object type");
  PetscPopErrorHandler();
}

TEST(Everywhere, TheLowestOfTheFailingRanksSpeaks)
{
  const Thrown all =
    thrown_by([] { throw SolveError("rank " + std::to_string(rank_here()) + " fails"); });
  EXPECT_EQ(all.message, "rank 0 fails");
  // kinds differ: that of the speaker counts
  const Thrown mixed = thrown_by([] {
    if (rank_here() == n_ranks() - 1)
      throw InputError("wrong");
    if (rank_here() == n_ranks() - 2)
      throw TangledMesh("tangled");
  });
  EXPECT_EQ(mixed.message, n_ranks() > 1 ? "tangled" : "wrong");
  EXPECT_EQ(*mixed.type, n_ranks() > 1 ? typeid(TangledMesh) : typeid(InputError));
}

TEST(Everywhere, NoFailureIsNoError)
{
  int done = 0;
  throw_collectively(MPI_COMM_WORLD, [&] { ++done; });
  EXPECT_EQ(done, 1);
}

TEST(Errors, MessagesAreOneLine)
{
  EXPECT_EQ(one_line(SolveError("two\nlines  ")), "two lines");
  EXPECT_EQ(one_line(dealii::ExcMessage("deal.II says so")), "deal.II says so");
  EXPECT_EQ(one_line(std::bad_alloc()), no_memory);
  EXPECT_EQ(one_line(std::bad_array_new_length()), no_memory);
  EXPECT_FALSE(is_out_of_memory(SolveError("out of memory")));
}
