#ifndef snug_tests_unit_io_vtu_reader_h
#define snug_tests_unit_io_vtu_reader_h

#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scratch.h"

namespace snug::test {
/// The points and float arrays of a VTU text as VTK's format defines them.
struct Vtu
{
  unsigned long                             n_points = 0, n_cells = 0;
  std::map<std::string, std::vector<float>> arrays; ///< "": the points
  std::map<std::string, unsigned int>       components;
};

inline std::string xml_attribute(const std::string &tag, const std::string &name)
{
  const auto at = tag.find(" " + name + "=\"");
  if (at == std::string::npos)
    return "";
  const auto begin = at + name.size() + 3;
  return tag.substr(begin, tag.find('"', begin) - begin);
}

/// Base64 of the header (4 integers for one block), then of zlib's block.
inline std::vector<float> decode_vtu_array(std::string text)
{
  const auto blank = [](char c) { return std::isspace(c) != 0; };
  text.erase(std::remove_if(text.begin(), text.end(), blank), text.end());
  if (text.empty())
    return {};
  const auto head = dealii::Utilities::decode_base64(text.substr(0, 24));
  if (head.size() < 16)
    return {}; // no block
  std::uint32_t header[4];
  std::memcpy(header, head.data(), sizeof(header));
  const auto         block  = dealii::Utilities::decode_base64(text.substr(24));
  const auto         length = header[2] > 0 ? header[2] : header[1]; // of the only block
  std::vector<float> values(length / sizeof(float));
  uLongf             size = length;
  if (header[0] != 1 ||
      uncompress(reinterpret_cast<Bytef *>(values.data()), &size, block.data(), header[3]) !=
        Z_OK ||
      size != length)
    throw std::runtime_error("damaged VTU array");
  return values;
}

/// Return the points and arrays of all pieces, one after the other.
inline Vtu read_vtu(const std::string &text)
{
  Vtu  vtu;
  auto piece = text.find("<Piece");
  if (piece == std::string::npos)
    throw std::runtime_error("no <Piece> in VTU text");
  for (; piece != std::string::npos; piece = text.find("<Piece", piece + 1))
    {
      const auto tag = text.substr(piece, text.find('>', piece) - piece);
      vtu.n_points += std::stoul(xml_attribute(tag, "NumberOfPoints"));
      vtu.n_cells += std::stoul(xml_attribute(tag, "NumberOfCells"));
    }
  for (auto at = text.find("<DataArray"); at != std::string::npos;
       at      = text.find("<DataArray", at + 1))
    {
      const auto end       = text.find('>', at);
      const auto array_tag = text.substr(at, end - at);
      if (xml_attribute(array_tag, "type") != "Float32")
        continue;
      const auto name       = xml_attribute(array_tag, "Name");
      const auto components = xml_attribute(array_tag, "NumberOfComponents");
      vtu.components[name]  = components.empty() ? 1 : std::stoul(components);
      const auto values =
        decode_vtu_array(text.substr(end + 1, text.find("</DataArray>", end) - end - 1));
      vtu.arrays[name].insert(vtu.arrays[name].end(), values.begin(), values.end());
    }
  return vtu;
}

/// Return the grid of all files of blocks in the folder @p path whose names end with @p ending.
/// @param[in] number The range of the numbers of the blocks.
inline Vtu read_blocks(const std::string                    &path,
                       const std::string                    &ending,
                       std::pair<unsigned int, unsigned int> numbers = {0, 99})
{
  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(path))
    if (const auto name = entry.path().filename().string();
        name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0 &&
        std::stoul(name) >= numbers.first && std::stoul(name) < numbers.second)
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  Vtu result;
  for (const auto &file : files)
    {
      const auto block = read_vtu(read_file(file));
      result.n_points += block.n_points;
      result.n_cells += block.n_cells;
      result.components = block.components;
      for (const auto &[name, values] : block.arrays)
        result.arrays[name].insert(result.arrays[name].end(), values.begin(), values.end());
    }
  return result;
}
} // namespace snug::test

#endif
