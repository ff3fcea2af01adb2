#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/base/rank_order.h>
#include <snug/base/run_context.h>
#include <snug/io/state_files.h>
#include <snug/io/text_file.h>
#include <snug/io/vtu_grid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <optional>
#include <sstream>

namespace snug::io {
namespace {
using Texts = std::vector<std::string>;

/// The communicator of @p n consecutive ranks, freed with the object. Collective.
class Group
{
public:
  Group(MPI_Comm all, const unsigned int n)
  {
    const int rank = narrow<int>(dealii::Utilities::MPI::this_mpi_process(all));
    MPI_Comm_split(all, narrow<int>(rank / n), rank, &some);
  }
  ~Group() { MPI_Comm_free(&some); }
  Group(const Group &)            = delete;
  Group &operator=(const Group &) = delete;
  operator MPI_Comm() const { return some; }

private:
  MPI_Comm some;
};

/// Write the pieces of a group to the file @p path on the first rank of the group, unless there are
/// none. Return the failure on this rank, or null. Collective in the group.
std::exception_ptr
write_pieces(MPI_Comm group, const std::string &path, const std::string &own_piece)
{
  std::optional<FileInParts> file;
  collect_in_order(group, own_piece, [&](const std::string &piece) {
    if (!file)
      {
        std::error_code ignored; // the file reports the failure
        std::filesystem::create_directory(std::filesystem::path(path).parent_path(), ignored);
        file.emplace(path);
        file->append(vtu_begin());
      }
    file->append(piece);
  });
  if (!file)
    return nullptr;
  try
    {
      file->append(vtu_end());
      file->finish();
    }
  catch (const std::exception &)
    {
      return std::current_exception();
    }
  return nullptr;
}

/// Return the path of the file of a block, relative to the directory of the series. Names of mesh
/// files may contain any character, so the number makes the path unique.
std::string
block_path(const std::string &stem, unsigned int number, std::string name, unsigned int group)
{
  for (char &c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.')
      c = '_';
  return stem + '/' + padded(number, 2) + '-' + name + '.' + padded(group, 4) + ".vtu";
}

/// Return the files of each block that contain a cell, on rank 0. Collective.
std::vector<Texts> files_of_blocks(MPI_Comm                  comm,
                                   const std::string        &stem,
                                   const std::vector<Block> &blocks,
                                   const unsigned int        ranks_per_file)
{
  std::vector<char> own;
  for (const auto &block : blocks)
    own.push_back(block.piece.empty() ? 0 : 1);
  const auto         has_cells = gather(comm, own);
  std::vector<Texts> files(blocks.size());
  for (unsigned int rank = 0; rank < has_cells.size(); ++rank)
    for (unsigned int b = 0; b < blocks.size(); ++b)
      if (const auto path = block_path(stem, b, blocks[b].name, rank / ranks_per_file);
          has_cells[rank][b] != 0 && (files[b].empty() || files[b].back() != path))
        files[b].push_back(path);
  return files;
}

std::string escaped(const std::string &name)
{
  std::string text;
  for (const char c : name)
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return text;
}

/// Return the VTM element of a block: a data set without pieces, because PyVista does not read
/// pieces, or a group of the data sets of several files.
std::string vtm_element(const unsigned int index, const Block &block, const Texts &files)
{
  const auto head = [](const unsigned int number, const std::string &name) {
    return " index=\"" + std::to_string(number) + "\" name=\"" + escaped(name) + '"';
  };
  if (files.size() < 2)
    return "<DataSet" + head(index, block.name) +
           (files.empty() ? "" : " file=\"" + files.front() + '"') + "/>\n";
  std::string text = "<Block" + head(index, block.name) + ">\n";
  for (unsigned int i = 0; i < files.size(); ++i)
    text += "<DataSet" + head(i, "part " + std::to_string(i)) + " file=\"" + files[i] + "\"/>\n";
  return text + "</Block>\n";
}

/// Return the VTM text, which has the blocks of a group next to each other.
std::string vtm(const std::vector<Block> &blocks, const std::vector<Texts> &files)
{
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
         "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
  unsigned int n_groups = 0;
  for (unsigned int first = 0, b = 0; first < blocks.size(); first = b)
    {
      out << "<Block index=\"" << n_groups++ << "\" name=\"" << escaped(blocks[first].group)
          << "\">\n";
      for (; b < blocks.size() && blocks[b].group == blocks[first].group; ++b)
        out << vtm_element(b - first, blocks[b], files[b]);
      out << "</Block>\n";
    }
  out << "</vtkMultiBlockDataSet>\n</VTKFile>\n";
  return out.str();
}
} // namespace

unsigned int ranks_of_a_file(const unsigned int ranks_per_file, const unsigned int n_ranks)
{
  const unsigned int at_least = 16, at_most_files = 16;
  return ranks_per_file > 0 ? ranks_per_file
                            : std::max(at_least, (n_ranks + at_most_files - 1) / at_most_files);
}

void write_state(MPI_Comm                  comm,
                 const std::string        &directory,
                 const std::string        &stem,
                 const std::vector<Block> &blocks,
                 const std::string        &arrays,
                 const unsigned int        ranks_per_file)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const unsigned int n =
    ranks_of_a_file(ranks_per_file, dealii::Utilities::MPI::n_mpi_processes(comm));
  const auto         files = files_of_blocks(comm, stem, blocks, n);
  std::exception_ptr failure;
  const Group        group(comm, n);
  for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      const auto path = directory + '/' + block_path(stem, b, blocks[b].name, rank / n);
      if (const auto failed = write_pieces(group, path, blocks[b].piece); !failure)
        failure = failed;
    }
  throw_collectively(comm, [&] {
    if (failure)
      std::rethrow_exception(failure);
    if (rank != 0)
      return;
    Texts joined;
    for (unsigned int b = 0; b < blocks.size() && blocks[b].group == blocks[0].group; ++b)
      joined.insert(joined.end(), files[b].begin(), files[b].end());
    write_text_file(directory + '/' + stem + ".pvtu", pvtu(arrays, joined));
    write_text_file(directory + '/' + stem + ".vtm", vtm(blocks, files));
  });
}

void write_load_cases(MPI_Comm                        comm,
                      const std::string              &directory,
                      const std::vector<std::string> &fields,
                      const std::vector<std::string> &faces)
{
  throw_collectively(comm, [&] {
    if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
      return;
    std::vector<std::pair<double, std::string>> of_fields, of_faces;
    for (unsigned int c = 0; c < fields.size(); ++c)
      {
        of_fields.emplace_back(c, fields[c]);
        of_faces.emplace_back(c, faces[c]);
      }
    write_text_file(directory + "/solution.pvd", pvd(of_fields));
    write_text_file(directory + "/contact.pvd", pvd(of_faces));
  });
}
} // namespace snug::io
