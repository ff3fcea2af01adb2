// Counts what the ranks send each other, stage by stage: preloaded, it stands between a program
// and MPI (the profiling interface of the MPI standard) and takes its stages from
// MPI_Pcontrol(1, name) and MPI_Pcontrol(-1, name). MPI_Finalize writes JSON to the file that
// SNUG_MESSAGES names: of each stage the most of any rank of messages between two ranks, of their
// bytes, of collective calls of several ranks and of the bytes a rank puts into them. Messages that
// collective calls are made of inside of MPI are not counted.

#include <mpi.h>

#include <cstdarg>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {
struct Sent
{
  long long messages = 0, message_bytes = 0, collectives = 0, collective_bytes = 0;
};

/// All that is known, made when first used: MPI may be called before main().
struct Counts
{
  std::map<std::string, Sent>      of_stage;
  std::vector<std::string>         nested = {"other"};
  std::map<MPI_Request, long long> persistent; ///< bytes of sends that can be started

  Sent &now() { return of_stage[nested.back()]; }
};

Counts &counts()
{
  static Counts the_counts;
  return the_counts;
}

long long bytes_of(int count, MPI_Datatype type)
{
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<long long>(count) * size;
}

void count_message(long long bytes)
{
  counts().now().messages += 1;
  counts().now().message_bytes += bytes;
}

/// A rank alone sends nothing.
void count_collective(int count, MPI_Datatype type, MPI_Comm comm)
{
  int n_ranks = 0;
  PMPI_Comm_size(comm, &n_ranks);
  if (n_ranks == 1)
    return;
  counts().now().collectives += 1;
  counts().now().collective_bytes += bytes_of(count, type);
}

void count_start(MPI_Request request)
{
  const auto found = counts().persistent.find(request);
  if (found != counts().persistent.end())
    count_message(found->second);
}

/// The names of rank 0, as all must reduce the same stages.
std::vector<std::string> stages_of_first_rank(int rank)
{
  std::string text;
  for (const auto &stage : counts().of_stage)
    text += stage.first + '\n';
  int length = static_cast<int>(text.size());
  PMPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (rank != 0)
    text.assign(static_cast<std::size_t>(length), ' ');
  PMPI_Bcast(text.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
  std::vector<std::string> stages;
  for (std::size_t first = 0; first < text.size();)
    {
      const std::size_t end = text.find('\n', first);
      stages.push_back(text.substr(first, end - first));
      first = end + 1;
    }
  return stages;
}
} // namespace

extern "C" {
int MPI_Pcontrol(const int level, ...)
{
  va_list arguments;
  va_start(arguments, level);
  const char *name = va_arg(arguments, const char *);
  va_end(arguments);
  if (level == 1)
    counts().nested.emplace_back(name);
  else if (level == -1 && counts().nested.size() > 1)
    counts().nested.pop_back();
  return MPI_SUCCESS;
}

int MPI_Send(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c)
{
  count_message(bytes_of(n, t));
  return PMPI_Send(b, n, t, to, tag, c);
}

int MPI_Isend(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r)
{
  count_message(bytes_of(n, t));
  return PMPI_Isend(b, n, t, to, tag, c, r);
}

int MPI_Send_init(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r)
{
  const int status        = PMPI_Send_init(b, n, t, to, tag, c, r);
  counts().persistent[*r] = bytes_of(n, t);
  return status;
}

// The handle may be one that a send had before.
int MPI_Recv_init(void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Request *r)
{
  const int status = PMPI_Recv_init(b, n, t, from, tag, c, r);
  counts().persistent.erase(*r);
  return status;
}

int MPI_Start(MPI_Request *request)
{
  count_start(*request);
  return PMPI_Start(request);
}

int MPI_Startall(int n, MPI_Request requests[])
{
  for (int i = 0; i < n; ++i)
    count_start(requests[i]);
  return PMPI_Startall(n, requests);
}

int MPI_Allreduce(const void *from, void *to, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c)
{
  count_collective(n, t, c);
  return PMPI_Allreduce(from, to, n, t, op, c);
}

int MPI_Reduce(const void *from, void *to, int n, MPI_Datatype t, MPI_Op op, int root, MPI_Comm c)
{
  count_collective(n, t, c);
  return PMPI_Reduce(from, to, n, t, op, root, c);
}

int MPI_Bcast(void *b, int n, MPI_Datatype t, int root, MPI_Comm c)
{
  count_collective(n, t, c);
  return PMPI_Bcast(b, n, t, root, c);
}

int MPI_Allgather(const void  *from,
                  int          n,
                  MPI_Datatype t,
                  void        *to,
                  int          m,
                  MPI_Datatype u,
                  MPI_Comm     c)
{
  count_collective(n, t, c);
  return PMPI_Allgather(from, n, t, to, m, u, c);
}

int MPI_Finalize()
{
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const char   *path = std::getenv("SNUG_MESSAGES");
  std::ofstream file;
  if (rank == 0 && path != nullptr)
    file.open(path);
  const char *separator = "{";
  for (const std::string &stage : stages_of_first_rank(rank))
    {
      const Sent      mine   = counts().of_stage[stage];
      const long long sent[] = {mine.messages, mine.message_bytes, mine.collectives,
                                mine.collective_bytes};
      long long       most[4];
      PMPI_Reduce(sent, most, 4, MPI_LONG_LONG, MPI_MAX, 0, MPI_COMM_WORLD);
      file << separator << "\n\"" << stage << "\": {\"messages\": " << most[0]
           << ", \"message_bytes\": " << most[1] << ", \"collectives\": " << most[2]
           << ", \"collective_bytes\": " << most[3] << "}";
      separator = ",";
    }
  file << "}\n";
  file.close();
  return PMPI_Finalize();
}
} // extern "C"
