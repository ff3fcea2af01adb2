#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/base/run_context.h>
#include <snug/io/state_files.h>
#include <snug/io/text_file.h>
#include <snug/io/vtu_grid.h>

#include <deal.II/base/mpi.h>

#include <cctype>
#include <filesystem>
#include <sstream>

namespace snug::io {
namespace {
using Texts = std::vector<std::string>;

/// Return the texts of @p n ranks on the first of them, nothing on the other ranks. Collective.
std::vector<Texts> of_ranks(MPI_Comm all, const unsigned int n, const Texts &texts)
{
  const int rank = narrow<int>(dealii::Utilities::MPI::this_mpi_process(all));
  MPI_Comm  some;
  MPI_Comm_split(all, rank / narrow<int>(n), rank, &some);
  auto gathered = gather(some, texts);
  MPI_Comm_free(&some);
  return gathered;
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

void write_state(MPI_Comm                  comm,
                 const std::string        &directory,
                 const std::string        &stem,
                 const std::vector<Block> &blocks,
                 const std::string        &arrays,
                 const unsigned int        ranks_per_file)
{
  Texts own;
  for (const auto &block : blocks)
    own.push_back(block.piece);
  const auto         pieces = of_ranks(comm, ranks_per_file, own);
  const auto         files  = files_of_blocks(comm, stem, blocks, ranks_per_file);
  const unsigned int rank   = dealii::Utilities::MPI::this_mpi_process(comm);
  throw_collectively(comm, [&] {
    for (unsigned int b = 0; b < blocks.size() && !pieces.empty(); ++b)
      {
        Texts of_block;
        for (const auto &of_rank : pieces)
          if (!of_rank[b].empty())
            of_block.push_back(of_rank[b]);
        if (of_block.empty())
          continue;
        std::error_code ignored; // the file reports the failure
        std::filesystem::create_directory(directory + '/' + stem, ignored);
        write_text_file(directory + '/' +
                          block_path(stem, b, blocks[b].name, rank / ranks_per_file),
                        vtu(of_block));
      }
    if (rank != 0)
      return;
    Texts joined;
    for (unsigned int b = 0; b < blocks.size() && blocks[b].group == blocks[0].group; ++b)
      joined.insert(joined.end(), files[b].begin(), files[b].end());
    write_text_file(directory + '/' + stem + ".pvtu", pvtu(arrays, joined));
    write_text_file(directory + '/' + stem + ".vtm", vtm(blocks, files));
  });
}
} // namespace snug::io
